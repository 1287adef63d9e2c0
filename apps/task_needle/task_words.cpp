#include "apps/task_needle/task_words.h"

#include <nlohmann/json.hpp>

namespace palpa::task_needle {
namespace {

template <typename Thing, std::size_t N>
void readNames(const station::JsonFile& task, const std::string& group,
               std::array<std::string, N>* words) {
  if (!task.has("words/" + group)) return;
  for (const auto& [key, value] : task.json().at("words").at(group).items()) {
    std::size_t i = 0;
    while (i < N && key != name(static_cast<Thing>(i))) ++i;
    if (i == N) task.refuse("words/" + group + "/" + key, "names what there is not");
    (*words)[i] = task.text("words/" + group + "/" + key);
  }
}

}  // namespace

std::string TaskWords::of(Tissue t) const {
  const std::string& own = tissue[static_cast<std::size_t>(t)];
  return own.empty() ? name(t) : own;
}

std::string TaskWords::of(Organ o) const {
  const std::string& own = organ[static_cast<std::size_t>(o)];
  return own.empty() ? name(o) : own;
}

TaskWords wordsIn(const station::JsonFile& task) {
  TaskWords words;
  readNames<Tissue>(task, "tissues", &words.tissue);
  readNames<Organ>(task, "organs", &words.organ);
  return words;
}

}  // namespace palpa::task_needle

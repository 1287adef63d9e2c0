#include "apps/cli/study_questions.h"

#include <algorithm>
#include <cstdio>
#include <iostream>
#include <optional>

#include "anatomy/geometry/error.h"
#include "apps/station/json_file.h"

namespace palpa::cli {
namespace {

const study::Item& itemOf(const study::Questionnaire& questionnaire, const std::string& id) {
  return *std::find_if(questionnaire.items.begin(), questionnaire.items.end(),
                       [&](const study::Item& item) { return item.id == id; });
}

void show(const study::Item& item, std::size_t number, std::size_t of) {
  std::printf("\n%zu of %zu. %s\n", number, of, item.question.c_str());
  if (item.kind == study::Item::Kind::likert)
    std::printf("   1 %s ... %d %s\n", item.low.c_str(), item.points, item.high.c_str());
  if (item.may_be_left) std::printf("   (Enter leaves it out)\n");
}

/// None at the input's end.
std::optional<std::string> heard(const study::Item& item) {
  for (std::string line;;) {
    std::printf("> ");
    std::fflush(stdout);
    if (!std::getline(std::cin, line)) return std::nullopt;
    const std::string why = study::whyNoAnswer(item, line);
    if (why.empty()) return line;
    std::printf("   %s\n", why.c_str());
  }
}

std::string textOf(const nlohmann::json& answer) {
  return answer.is_string() ? answer.get<std::string>() : answer.dump();
}

}  // namespace

bool askQuestions(const study::Questionnaire& questionnaire, const study::Next& next,
                  StudyParticipant& participant) {
  std::printf("\n%s\n", questionnaire.title.c_str());
  for (const std::string& id : next.open_items) {
    const study::Item& item = itemOf(questionnaire, id);
    show(item, static_cast<std::size_t>(&item - questionnaire.items.data()) + 1,
         questionnaire.items.size());
    const std::optional<std::string> answer = heard(item);
    if (!answer) return false;
    participant.answer(next.session, id, *answer);
  }
  return true;
}

bool takeAnswers(const std::string& path, const study::Questionnaire& questionnaire,
                 const study::Next& next, StudyParticipant& participant) {
  const station::JsonFile file(path);
  if (!file.json().is_object()) file.refuse("", "must be items and answers");
  for (const auto& [id, answer] : file.json().items()) {
    const auto item = std::find_if(questionnaire.items.begin(), questionnaire.items.end(),
                                   [&](const study::Item& i) { return i.id == id; });
    if (item == questionnaire.items.end())
      file.refuse(id, "is no item of the questionnaire \"" + questionnaire.id + "\"");
    if (const std::string why = study::whyNoAnswer(*item, textOf(answer)); !why.empty())
      file.refuse(id, "cannot be taken: " + why);
  }
  std::size_t taken = 0;
  for (const std::string& id : next.open_items)
    if (file.has(id)) {
      participant.answer(next.session, id, textOf(file.json().at(id)));
      ++taken;
    }
  return taken == next.open_items.size();
}

}  // namespace palpa::cli

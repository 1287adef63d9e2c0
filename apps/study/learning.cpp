#include "apps/study/learning.h"

#include <algorithm>
#include <cmath>

#include "anatomy/base/file_schema.h"
#include "anatomy/base/json_file.h"
#include "anatomy/base/random.h"
#include "apps/training/engine.h"

namespace palpa::study {
namespace {

constexpr int kMostSubjects = 1000;

GroupLearning groupIn(const JsonFile& file) {
  GroupLearning g;
  g.subjects = file.integer("subjects", 1, kMostSubjects);
  g.start = file.number("start", 0, 1);
  g.start_sd = file.number("start_sd", 0, 1);
  g.asymptote = file.number("asymptote", 0, 1);
  g.asymptote_sd = file.number("asymptote_sd", 0, 1);
  g.rate = file.number("rate_per_trial", 0, 10);
  g.rate_sd = file.number("rate_sd", 0, 2);
  return g;
}

void needGroups(const JsonFile& file, const Protocol& protocol, const Learners& learners) {
  for (const Group& group : protocol.groups)
    if (!learners.groups.count(group.name))
      file.refuse("groups", "lacks \"" + group.name + "\", a group of " + protocol.file.string());
  for (const auto& [name, ignored] : learners.groups)
    if (!protocol.group(name))
      file.refuse("groups",
                  "has \"" + name + "\", which is not a group of " + protocol.file.string());
  for (const StudyCondition& condition : protocol.conditions)
    if (!learners.rate_times.count(condition.name))
      file.refuse("conditions",
                  "lacks \"" + condition.name + "\", a condition of " + protocol.file.string());
  for (const auto& [name, ignored] : learners.rate_times)
    if (!protocol.condition(name))
      file.refuse("conditions",
                  "has \"" + name + "\", which is not a condition of " + protocol.file.string());
}

}  // namespace

Learners readLearners(const std::filesystem::path& path, const Protocol& protocol) {
  const JsonFile file(path);
  needKind(file, "learners", 1);
  Learners l;
  l.id = needName(file, "id");
  l.title = file.text("title");
  l.planted = file.text("planted");
  l.engine = training::engineIn(file);
  if (l.engine != training::Engine::needle && l.engine != training::Engine::search)
    file.refuse("engine", "is \"" + training::nameOf(l.engine) +
                              "\"; virtual trainees know needle and search");
  l.from = path.parent_path() / file.text("from");
  l.to = path.parent_path() / file.text("to");
  for (const JsonFile& entry : file.entries("groups"))
    l.groups[entry.text("name")] = groupIn(entry);
  for (const JsonFile& entry : file.entries("conditions"))
    l.rate_times[entry.text("name")] = entry.number("rate_times", 0, 20);
  needGroups(file, protocol, l);
  for (const Session& session : protocol.sessions)
    for (const Block& block : session.blocks)
      if (block.engine != l.engine)
        file.refuse("engine", "is \"" + training::nameOf(l.engine) + "\", but the block \"" +
                                  block.name + "\" of the protocol is of \"" +
                                  training::nameOf(block.engine) + "\"");
  return l;
}

VirtualTrainee::VirtualTrainee(const Learners& learners, const std::string& group,
                               std::uint64_t seed)
    : learners_(learners) {
  const GroupLearning& g = learners.groups.at(group);
  RandomStream random(seed, "study.learner");
  start_ = random.normal(g.start, g.start_sd);
  asymptote_ = random.normal(g.asymptote, g.asymptote_sd);
  rate_ = g.rate * std::exp(random.normal(0, g.rate_sd));
}

double VirtualTrainee::level() const {
  return std::clamp(asymptote_ - (asymptote_ - start_) * std::exp(-rate_ * practice_), 0.0, 1.0);
}

void VirtualTrainee::practised(const std::string& condition) {
  practice_ += learners_.rate_times.at(condition);
}

}  // namespace palpa::study

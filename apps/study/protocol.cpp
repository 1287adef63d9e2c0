#include "apps/study/protocol.h"

#include <algorithm>
#include <cmath>
#include <set>
#include <utility>

#include "anatomy/base/error.h"
#include "anatomy/base/file_schema.h"
#include "anatomy/base/json_file.h"
#include "anatomy/base/random.h"
#include "anatomy/base/sha256.h"
#include "apps/record/store/record_store.h"
#include "apps/station/assets.h"
#include "apps/training/engine.h"

namespace palpa::study {
namespace {

template <class Named>
const Named* named(const std::vector<Named>& all, const std::string& name) {
  for (const Named& one : all)
    if (one.name == name) return &one;
  return nullptr;
}

}  // namespace

const Group* Protocol::group(const std::string& name) const { return named(groups, name); }
const StudyCondition* Protocol::condition(const std::string& name) const {
  return named(conditions, name);
}

const Block& Protocol::block(std::int64_t step) const {
  for (const Session& session : sessions)
    for (const Block& block : session.blocks)
      if (block.step == step) return block;
  throw Error("has no step " + std::to_string(step), file.string(),
              "Was the protocol changed while the study runs?");
}

int Protocol::sessionOf(std::int64_t step) const {
  int number = 0;
  for (const Session& session : sessions) {
    ++number;
    if (!session.blocks.empty() && step <= session.blocks.back().step) return number;
  }
  return number;
}

namespace {

constexpr const char* kDrawn = "drawn";  // a block's condition: the one that the trainee drew
constexpr int kMostTrials = 1000, kMostDays = 3650, kMostPlaces = 64;
constexpr double kLongestRest_s = 24 * 3600, kLongestSession_s = 200 * 3600;
const std::set<std::string> kModes{"real", "degraded", "augmented"};
const std::set<std::string> kRoles{"scored", "familiarisation"};

void needOneOf(const JsonFile& file, const std::string& field, const std::string& value,
               const std::set<std::string>& known) {
  if (known.count(value)) return;
  std::string names;
  for (const std::string& name : known) names += (names.empty() ? "" : ", ") + name;
  file.refuse(field, "is \"" + value + "\"; it must be one of " + names);
}

/// What `file` says, over what `before` says. A misspelt field would be a condition that is none,
/// so unknown ones are refused.
Setting settingIn(const JsonFile& file, Setting before, const std::filesystem::path& beside) {
  if (!file.json().is_object()) file.refuse("", "must be fields of what is shown and felt");
  static const std::set<std::string> kKnown{"force_feedback",  "presentation", "augment",
                                            "skin_deflection", "guide",        "guidance",
                                            "navigation",      "mode"};
  for (const auto& [field, ignored] : file.json().items()) needOneOf(file, field, field, kKnown);
  Setting p = std::move(before);
  p.force_feedback = file.flag("force_feedback", p.force_feedback);
  if (file.has("presentation"))
    p.presentation = presentation::presentationNamed(file.text("presentation"),
                                                     station::assetFile("presentations"), beside,
                                                     file.name() + ", field \"presentation\"");
  p.augment = file.flag("augment", p.augment);
  p.skin_deflection = file.flag("skin_deflection", p.skin_deflection);
  p.guide = file.flag("guide", p.guide);
  p.guidance = file.flag("guidance", p.guidance);
  p.navigation = file.flag("navigation", p.navigation);
  if (file.has("mode")) p.mode = file.text("mode");
  needOneOf(file, "mode", p.mode, kModes);
  return p;
}

/// The fields of an object within `file`; none where it is missing.
JsonFile partOf(const JsonFile& file, const std::string& field) {
  return {file.has(field) ? file.json().at(field) : nlohmann::json::object(),
          file.name() + ", \"" + field + "\""};
}

template <class Named, class Read>
std::vector<Named> namedIn(const JsonFile& file, const std::string& list, Read read) {
  std::vector<Named> all;
  std::set<std::string> names;
  for (const JsonFile& entry : file.entries(list)) {
    all.push_back(read(entry));
    if (!names.insert(all.back().name).second)
      entry.refuse("name", "is \"" + all.back().name + "\", which another one has, too");
  }
  if (all.empty()) file.refuse(list, "must be a list of at least one");
  return all;
}

std::vector<std::string> textsIn(const JsonFile& file, const std::string& list) {
  std::vector<std::string> all;
  for (const JsonFile& entry : file.entries(list)) {
    if (!entry.json().is_string()) file.refuse(list, "must be a list of texts");
    all.push_back(entry.json().get<std::string>());
  }
  return all;
}

/// A field's name, or the one that it had before 2026-12, where a file still has that.
std::string known(const JsonFile& file, const char* name, const char* old_name) {
  return file.has(old_name) ? old_name : name;
}

std::filesystem::path besides(const Protocol& protocol, const std::string& relative) {
  return (protocol.file.parent_path() / relative).lexically_normal();
}

/// "3 h 20 min", "12 min".
std::string hoursAndMinutes(double seconds) {
  const auto minutes = static_cast<std::int64_t>(std::ceil(seconds / 60));
  return (minutes >= 60 ? std::to_string(minutes / 60) + " h " : "") +
         std::to_string(minutes % 60) + " min";
}

double longestSession_s(const Session& session) {
  double seconds = 0;
  for (const Block& block : session.blocks) seconds += longestTime_s(block);
  return seconds;
}

Block blockIn(const JsonFile& file, const Protocol& protocol) {
  Block block;
  block.name = needName(file, "name");
  block.task = besides(protocol, file.text("task"));
  const JsonFile task(block.task);
  block.engine = training::engineIn(task);
  if (task.has("end/time_limit_s")) block.time_limit_s = task.number("end/time_limit_s", 1, 3600);
  if (file.has("role")) {
    needOneOf(file, "role", file.text("role"), kRoles);
    block.role = training::roleNamed(file.text("role"));
  }
  block.trials = file.integer("trials", 1, kMostTrials);
  if (file.has("rest_s")) block.rest_s = file.number("rest_s", 0, kLongestRest_s);
  if (file.has("rest_after")) block.rest_after = file.integer("rest_after", 1, kMostTrials);
  if (block.rest_after && block.rest_s == 0) file.refuse("rest_after", "needs rest_s: how long");
  const std::string condition = file.text("condition");
  if (condition == kDrawn && !protocol.allocation)
    file.refuse("condition", "is \"drawn\", but the protocol has no \"allocation\"");
  if (condition != kDrawn && !protocol.condition(condition))
    file.refuse("condition",
                "is \"" + condition + "\", which is not one of the protocol's conditions");
  block.condition = condition == kDrawn ? "" : condition;
  return block;
}

Session sessionIn(const JsonFile& file, const Protocol& protocol) {
  Session session;
  session.name = needName(file, "name");
  if (file.has("days_after")) session.days_after = file.integer("days_after", 0, kMostDays);
  session.blocks = namedIn<Block>(file, "blocks",
                                  [&](const JsonFile& entry) { return blockIn(entry, protocol); });
  if (longestSession_s(session) > kLongestSession_s)
    file.refuse("blocks", "may take up to " + hoursAndMinutes(longestSession_s(session)) +
                              " (trials x their task's time limit, and rests); a session has at "
                              "most " +
                              hoursAndMinutes(kLongestSession_s));
  if (file.has("questionnaire"))
    session.questionnaire = readQuestionnaire(besides(protocol, file.text("questionnaire")));
  return session;
}

Allocation allocationIn(const JsonFile& file, const Protocol& protocol) {
  Allocation a{textsIn(file, "conditions"), 0};
  if (a.conditions.size() < 2)
    file.refuse("conditions", "must name at least two conditions, one of which is drawn");
  for (const std::string& name : a.conditions) {
    if (!protocol.condition(name))
      file.refuse("conditions",
                  "has \"" + name + "\", which is not one of the protocol's conditions");
    if (std::count(a.conditions.begin(), a.conditions.end(), name) > 1)
      file.refuse("conditions", "has \"" + name + "\" twice");
  }
  a.block = file.integer("block", 2, kMostPlaces);
  if (a.block % static_cast<int>(a.conditions.size()))
    file.refuse("block",
                "must be a multiple of the number of conditions, or it could not be balanced");
  return a;
}

/// Throws where the file says something that no trainee would ever meet.
void needAllUsed(const JsonFile& file, const Protocol& protocol) {
  std::set<std::string> used;
  bool drawn = false;
  for (const Session& session : protocol.sessions)
    for (const Block& block : session.blocks)
      block.condition.empty() ? static_cast<void>(drawn = true)
                              : static_cast<void>(used.insert(block.condition));
  if (protocol.allocation && !drawn)
    file.refuse("allocation", "is used by no block: none has the condition \"drawn\"");
  if (protocol.allocation)
    used.insert(protocol.allocation->conditions.begin(), protocol.allocation->conditions.end());
  for (const StudyCondition& condition : protocol.conditions)
    if (!used.count(condition.name))
      file.refuse("conditions",
                  "has \"" + condition.name + "\", which no block and no allocation uses");
}

void readBlindness(const JsonFile& file, Protocol* protocol) {
  for (const std::string& who : textsIn(file, "blind")) {
    needOneOf(file, "blind", who, {"trainee", "educator"});
    (who == "trainee" ? protocol->blind_trainee : protocol->blind_educator) = true;
  }
}

}  // namespace

double longestTime_s(const Block& block) {
  const int rests = 1 + (block.rest_after ? (block.trials - 1) / block.rest_after : 0);
  return block.trials * block.time_limit_s + rests * block.rest_s;
}

std::string longestTimeInWords(const Protocol& protocol) {
  double seconds = 0;
  for (const Session& session : protocol.sessions) seconds += longestSession_s(session);
  return "at most " + hoursAndMinutes(seconds);
}

std::string needName(const JsonFile& file, const std::string& field) {
  std::string name = file.text(field);
  if (!record::whyNoPseudonym(name).empty())
    file.refuse(field, "is \"" + name + "\"; a name here has 1 to 32 letters, digits, - or _");
  return name;
}

namespace {

/// Whoever does not feel the force must not read it off the screen; and whoever feels it must not
/// see more than the others.
void showAlike(std::vector<StudyCondition>* conditions) {
  const bool all_feel = std::all_of(conditions->begin(), conditions->end(),
                                    [](const StudyCondition& c) { return c.shows.force_feedback; });
  if (all_feel) return;
  for (StudyCondition& condition : *conditions)
    condition.shows.hide_forces =
        !condition.shows.presentation && !condition.shows.guide && !condition.shows.guidance;
}

}  // namespace

Protocol readProtocol(const std::filesystem::path& path) {
  const JsonFile file(path);
  needKind(file, "protocol", 1);
  Protocol p;
  p.file = path;
  p.sha256 = sha256OfFile(path);
  p.id = needName(file, "id");
  p.title = file.text("title");
  p.source = file.text("source");
  p.groups = namedIn<Group>(file, "groups", [](const JsonFile& f) {
    return Group{needName(f, "name"), f.text("means")};
  });
  const Setting always = settingIn(partOf(file, "always"), {}, path.parent_path());
  p.conditions = namedIn<StudyCondition>(file, "conditions", [&](const JsonFile& f) {
    if (f.text("name") == kDrawn)
      f.refuse("name", "is \"drawn\", which means the condition that a trainee draws");
    return StudyCondition{needName(f, "name"), f.text("means"),
                          settingIn(partOf(f, "sets"), always, path.parent_path())};
  });
  showAlike(&p.conditions);
  if (file.has("allocation")) p.allocation = allocationIn(partOf(file, "allocation"), p);
  p.sessions =
      namedIn<Session>(file, "sessions", [&](const JsonFile& f) { return sessionIn(f, p); });
  std::int64_t step = 0;
  for (Session& session : p.sessions)
    for (Block& block : session.blocks) block.step = ++step;
  needAllUsed(file, p);
  p.trial_seed = static_cast<std::uint64_t>(file.integer("trial_seed", 0, 1'000'000'000));
  readBlindness(file, &p);
  p.excludes_experts = file.flag(known(file, "excludes_experts", "bars_experts"), true);
  p.excluded = textsIn(file, known(file, "excluded", "barred"));
  return p;
}

std::string conditionOf(const Allocation& allocation, const std::string& group, std::uint64_t seed,
                        std::int64_t place) {
  const auto size = static_cast<std::size_t>(allocation.block);
  const std::size_t index = static_cast<std::size_t>(place - 1);
  std::vector<std::size_t> order(size);
  for (std::size_t i = 0; i < size; ++i) order[i] = i % allocation.conditions.size();
  RandomStream random(seed, "study.allocation." + group + "." + std::to_string(index / size));
  for (std::size_t i = size; i > 1; --i)
    std::swap(order[i - 1], order[static_cast<std::size_t>(
                                random.uniform() * static_cast<double>(i))]);  // Fisher and Yates
  return allocation.conditions[order[index % size]];
}

}  // namespace palpa::study

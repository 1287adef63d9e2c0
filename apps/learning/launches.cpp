#include "apps/learning/launches.h"

#include "anatomy/base/error.h"
#include "anatomy/base/json_text.h"
#include "anatomy/base/uuid.h"
#include "anatomy/base/whole_file.h"
#include "apps/link/lrs_client.h"
#include "apps/os/file_access.h"

namespace palpa::learning {
namespace {

using nlohmann::json;

struct KeptText {
  const char* name;
  std::string Launch::*field;
  bool is_secret = false;
};
constexpr KeptText kKept[] = {
    {"id", &Launch::id},
    {"platform", &Launch::platform},
    {"task", &Launch::task},
    {"title", &Launch::title},
    {"session", &Launch::session},
    {"trainee", &Launch::trainee},
    {"return_url", &Launch::return_url},
    {"endpoint", &Launch::endpoint},
    {"token", &Launch::token, true},
    {"line_item", &Launch::line_item},
    {"person", &Launch::person, true},
    {"result", &Launch::result},
    {"trouble", &Launch::trouble},
};

json toJson(const Launch& launch) {
  json kept{{"kind", launch.kind == PlatformKind::lti ? "lti" : "cmi5"},
            {"trials", launch.trials},
            {"began_ms", launch.began_ms},
            {"over", launch.over},
            {"due", launch.due},
            {"told_completed", launch.told.completed},
            {"told_passed", launch.told.passed}};
  for (const KeptText& text : kKept)
    if (!text.is_secret || !launch.isDone()) kept[text.name] = launch.*text.field;
  if (launch.kind == PlatformKind::cmi5) kept["cmi5"] = toJson(launch.cmi5);
  return kept;
}

Launch launchIn(const json& kept) {
  Launch launch;
  launch.kind = kept.at("kind") == "lti" ? PlatformKind::lti : PlatformKind::cmi5;
  launch.trials = kept.at("trials");
  launch.began_ms = kept.at("began_ms");
  launch.over = kept.at("over");
  launch.due = kept.at("due").get<std::vector<json>>();
  launch.told = {kept.at("told_completed"), kept.at("told_passed")};
  for (const KeptText& text : kKept) launch.*text.field = kept.value(text.name, "");
  if (launch.kind == PlatformKind::cmi5) launch.cmi5 = cmi5FactsIn(kept.at("cmi5"));
  return launch;
}

/// Damaged ones are none: nothing can be sent from them.
std::optional<Launch> readLaunch(const std::filesystem::path& file) {
  const auto text = readWhole(file);
  if (!text) return std::nullopt;
  try {
    return launchIn(json::parse(*text));
  } catch (const json::exception&) {
    return std::nullopt;
  }
}

std::string sessionIn(const Cmi5Facts& facts) {
  return facts.context.at("extensions").at(kSessionId);
}

}  // namespace

void Launches::keep(const Launch& launch) {
  const std::lock_guard lock(mutex_);
  if (const std::error_code problem = os::makeFolders(folder_))
    failFile("cannot be used", folder_, problem);
  writeWhole(folder_ / (launch.id + ".json"), toJson(launch).dump(1) + "\n", Lasts::yes,
             Readers::owner);
}

std::optional<Launch> Launches::find(const std::string& id) const {
  if (!isUuid(id)) return std::nullopt;
  const std::lock_guard lock(mutex_);
  return readLaunch(folder_ / (id + ".json"));
}

std::vector<std::filesystem::path> Launches::files() const {
  std::vector<std::filesystem::path> found;
  std::error_code none;
  for (const auto& entry : std::filesystem::directory_iterator(folder_, none))
    if (entry.path().extension() == ".json") found.push_back(entry.path());
  return found;
}

std::vector<Launch> Launches::all() const {
  const std::lock_guard lock(mutex_);
  std::vector<Launch> found;
  for (const auto& file : files())
    if (auto launch = readLaunch(file)) found.push_back(std::move(*launch));
  return found;
}

std::vector<Launch> Launches::notDone() {
  const std::lock_guard lock(mutex_);
  std::vector<Launch> open;
  for (const auto& file : files()) {
    if (done_.contains(file.filename())) continue;
    auto launch = readLaunch(file);
    if (!launch || launch->isDone() || (launch->over && !launch->trouble.empty()))
      done_.insert(file.filename());
    else
      open.push_back(std::move(*launch));
  }
  return open;
}

bool Launches::has(const Cmi5Facts& facts) const {
  for (const Launch& launch : all())
    if (launch.kind == PlatformKind::cmi5 && launch.cmi5.registration == facts.registration &&
        sessionIn(launch.cmi5) == sessionIn(facts))
      return true;
  return false;
}

ToldBefore Launches::toldOf(const Cmi5Facts& facts) const {
  ToldBefore told;
  for (const Launch& launch : all()) {
    if (launch.kind != PlatformKind::cmi5 || launch.cmi5.registration != facts.registration ||
        launch.cmi5.activity != facts.activity)
      continue;
    told.completed |= launch.told.completed;
    told.passed |= launch.told.passed;
  }
  return told;
}

int Launches::forget(const std::string& trainee) {
  int removed = 0;
  for (const Launch& launch : all()) {
    if (launch.trainee != trainee) continue;
    std::error_code none;
    removed += std::filesystem::remove(folder_ / (launch.id + ".json"), none) ? 1 : 0;
  }
  return removed;
}

namespace {

bool isTold(const std::vector<json>& statements, const std::string& verb) {
  for (const json& statement : statements)
    if (statement.at("verb").at("id") == kVerbRoot + verb) return true;
  return false;
}

std::string inWords(const Launch& launch, const LaunchResult& result) {
  if (!result.scaled)
    return result.completed ? "The session is recorded." : "The session ended before its trials.";
  constexpr double kPercent = 100;
  const int percent = static_cast<int>(kPercent * *result.scaled);
  std::string judged = std::to_string(percent) + " % of the trials reached the task's goal.";
  if (launch.kind != PlatformKind::cmi5 || !launch.cmi5.counts) return judged;
  return (*result.scaled >= masteryOf(launch.cmi5) ? "Passed. " : "Not passed yet. ") + judged;
}

}  // namespace

void conclude(Launch& launch, const LaunchResult& result, const ToldBefore& before,
              const std::string& time_utc) {
  launch.over = true;
  launch.result = inWords(launch, result);
  if (result.simulated) launch.result += " Simulated: this says nothing about a person.";
  if (launch.kind == PlatformKind::cmi5) {
    std::vector<json> statements = statementsAtEnd(launch.cmi5, result, before);
    launch.told = {isTold(statements, "completed"), isTold(statements, "passed")};
    for (json& one : statements) launch.due.push_back(std::move(one));
  } else if (result.scaled && !launch.line_item.empty()) {
    launch.due.push_back(scoreFrom({.person = launch.person,
                                    .scaled = *result.scaled,
                                    .completed = result.completed,
                                    .simulated = result.simulated,
                                    .time_utc = time_utc}));
  }
}

namespace {

using nlohmann::json;

Delivered sendStatement(const json& statement, const Launch& launch, const link::WebTimes& times) {
  link::LrsClient client(link::endpointOf(launch.endpoint, false), {.token = launch.token}, times);
  const link::LrsAnswer answer = client.put(statement.at("id"), statement.dump());
  return deliveredBy(answer.status, answer.trouble);
}

}  // namespace

Delivered deliver(Launch& launch, Launches& launches, const Settings& settings,
                  const SigningKey& key, std::chrono::sys_seconds now,
                  const link::WebTimes& times) {
  const Platform* const platform = settings.named(launch.platform);
  Delivered last;
  if (!platform) last = {Delivery::refused, "the platform was removed from this console"};
  while (platform && !launch.due.empty() && last.how == Delivery::done) {
    const json& next = launch.due.front();
    last = launch.kind == PlatformKind::cmi5
               ? sendStatement(next, launch, times)
               : sendScore(next, launch.line_item, *platform, key, now, times);
    if (last.how != Delivery::done) break;
    launch.due.erase(launch.due.begin());
    launches.keep(launch);
  }
  if (last.how == Delivery::refused) {
    launch.trouble = last.words;
    launches.keep(launch);
  }
  return last;
}

}  // namespace palpa::learning

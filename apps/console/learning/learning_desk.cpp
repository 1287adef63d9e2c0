#include "apps/console/learning/learning_desk.h"

#include <algorithm>
#include <cstdio>

#include "anatomy/base/error.h"
#include "anatomy/base/utc.h"
#include "anatomy/base/uuid.h"
#include "apps/console/session_results.h"
#include "apps/console/task_choices.h"
#include "apps/learning/cmi5_launch.h"
#include "apps/learning/launches.h"
#include "apps/os/real_time.h"
#include "apps/record/store/learner_store.h"

namespace palpa::console {
namespace {

using learning::Launch;
using nlohmann::json;

std::chrono::sys_seconds nowInSeconds() { return utcSecondsOf(utcNow()); }
std::int64_t nowInMilliseconds() { return runtime::dateNow() / runtime::kMillisecond; }
std::string inUtc(std::int64_t milliseconds) {
  return isoTimestamp("1970-01-01T00:00:00Z", milliseconds * runtime::kMillisecond);
}

/// Throws UsageError where there is no such task.
Launch launchOf(const learning::Platform& platform, const std::string& task) {
  Launch launch;
  launch.id = newUuid();
  launch.kind = platform.kind;
  launch.platform = platform.name;
  launch.task = task;
  launch.title = taskChoice(task).title;
  return launch;
}

/// What the session came to, of the trials that count.
learning::LaunchResult resultOf(const json& session, const Launch& launch) {
  const json outcome = outcomeOf(session.at("results"));
  const int counting = outcome.at("counting"), succeeded = outcome.at("succeeded");
  learning::LaunchResult result;
  result.completed = session.at("state") == "finished" && counting >= launch.trials;
  if (counting > 0 && outcome.at("done") == 0)
    result.scaled = static_cast<double>(succeeded) / counting;
  result.simulated = session.value("simulated", json()) == true;
  return result;
}

}  // namespace

std::shared_ptr<LearningDesk> openLearningDesk(Console& console) {
  return std::make_shared<LearningDesk>(console);
}

LearningDesk::LearningDesk(Console& console)
    : console_(console),
      folder_(console.place.home),
      launches_(folder_.launches()),
      thread_(os::startThread([this] {
        os::giveWay();
        while (!ending_) {
          look();
          runtime::rest(std::chrono::milliseconds(500));
        }
      })) {}

LearningDesk::~LearningDesk() {
  ending_ = true;
  thread_.join();
}

const learning::SigningKey& LearningDesk::key() {
  const std::lock_guard lock(key_mutex_);
  if (!key_) key_ = std::make_unique<learning::SigningKey>(folder_.key());
  return *key_;
}

json LearningDesk::publicKeys() { return key().publicKeys(); }

std::string LearningDesk::launchCmi5(const learning::Fields& fields, const std::string& task,
                                     const std::string& language) {
  const learning::Settings settings = this->settings();
  const learning::Cmi5Request request = learning::readCmi5Request(fields, settings);
  Launch launch = launchOf(*request.platform, task);
  const learning::Cmi5Session told = learning::askPlatform(request);
  launch.return_url = told.data.return_url;
  launch.endpoint = request.endpoint;
  launch.token = told.token;
  launch.cmi5 = {.launch = launch.id,
                 .actor = request.actor,
                 .context = told.data.context,
                 .activity = request.activity,
                 .registration = request.registration,
                 .counts = told.data.mode == learning::LaunchMode::normal,
                 .mastery = told.data.mastery,
                 .began_utc = inUtc(nowInMilliseconds())};
  if (launches_.has(launch.cmi5))
    throw UsageError("was used before", "this launch", "Start again from the course");
  launch.due = {learning::initialized(launch.cmi5)};
  begin(launch, request.person(), settings, language, told.data.audio);
  return launch.id;
}

std::string LearningDesk::launchLti(const std::string& token,
                                    const learning::Logins::Pending& login,
                                    const std::string& language) {
  const learning::Settings settings = this->settings();
  const learning::Platform* const platform = settings.named(login.platform);
  if (!platform)
    throw UsageError("was removed from this console", "the learning platform",
                     "The educator adds it at the station: palpa console learning --help");
  const auto now = nowInSeconds();
  const json claims = learning::verifiedClaims(token, keys_.keysFor(*platform, token, now));
  const learning::LtiLaunch wanted =
      learning::readLtiLaunch(claims, *platform, login.nonce, now, settings);
  Launch launch = launchOf(*platform, wanted.task);
  launch.return_url = wanted.return_url;
  launch.line_item = wanted.line_item;
  launch.person = wanted.person;
  begin(launch, wanted.person, settings, language, true);
  return launch.id;
}

void LearningDesk::begin(Launch launch, const std::string& person,
                         const learning::Settings& settings, const std::string& language,
                         bool audio) {
  const std::lock_guard lock(begin_mutex_);
  if (console_.sessions.oneRuns())
    throw UsageError("is running at this station", "a session", "Wait until it is over");
  record::RecordStore store(console_.place.records);
  launch.trainee = record::LearnerStore(store).traineeFor(launch.platform, person, utcNow());
  launch.trials = settings.trials;
  launch.began_ms = nowInMilliseconds();
  SessionWish wish;
  wish.task = launch.task;
  wish.trainee = launch.trainee;
  wish.performer = settings.performer;
  wish.trials = settings.trials;
  wish.language = language;
  wish.silent = !audio;
  launch.session = beginSession(console_, wish);
  launches_.keep(launch);
}

void LearningDesk::look() {
  for (Launch& launch : launches_.notDone()) {
    if (ending_) return;
    try {
      if (!launch.over) conclude(launch);
      if (!launch.due.empty() && launch.trouble.empty()) send(launch);
    } catch (const std::exception& e) {
      std::fprintf(stderr, "Of a launch by %s: %s\n", launch.platform.c_str(), e.what());
      waits_[launch.id] = {runtime::ServingClock::now() + std::chrono::minutes(1)};
    }
  }
}

void LearningDesk::conclude(Launch& launch) {
  learning::LaunchResult result;
  if (console_.sessions.has(launch.session)) {
    const json session = console_.sessions.one(launch.session);
    if (session["state"] == "running" || session["state"] == "starting") return;
    result = resultOf(session, launch);
  }
  const std::int64_t now = nowInMilliseconds();
  result.length_ms = std::max<std::int64_t>(0, now - launch.began_ms);
  learning::conclude(launch, result, launches_.toldOf(launch.cmi5), inUtc(now));
  launches_.keep(launch);
}

void LearningDesk::send(Launch& launch) {
  constexpr std::chrono::seconds kLongest{300};
  Wait& wait = waits_[launch.id];
  if (runtime::ServingClock::now() < wait.until) return;
  link::WebTimes times = learning::kPlatformTimes;
  times.given_up = &ending_;
  const learning::Delivered delivered =
      learning::deliver(launch, launches_, settings(), key(), nowInSeconds(), times);
  if (ending_ && delivered.how == learning::Delivery::later) return;
  if (delivered.how == learning::Delivery::done) {
    waits_.erase(launch.id);
    return;
  }
  std::fprintf(stderr, "%s: what came of a launch was not taken: %s%s\n", launch.platform.c_str(),
               delivered.words.c_str(),
               delivered.how == learning::Delivery::later ? "; it is sent again" : "");
  wait.until = runtime::ServingClock::now() + wait.next;
  wait.next = std::min(2 * wait.next, kLongest);
}

}  // namespace palpa::console

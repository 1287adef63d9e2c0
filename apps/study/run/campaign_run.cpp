#include "apps/study/run/campaign_run.h"

#include <algorithm>
#include <cstdio>
#include <deque>
#include <map>
#include <set>
#include <utility>

#include "anatomy/base/counted.h"
#include "anatomy/base/error.h"
#include "anatomy/base/uuid.h"
#include "anatomy/base/whole_file.h"
#include "apps/os/file_access.h"
#include "apps/os/signals.h"
#include "apps/os/worker_processes.h"
#include "apps/runtime/clock.h"
#include "apps/session/output_folder.h"
#include "apps/session/session_pictures.h"
#include "apps/session/terminal.h"
#include "apps/session/whole_session.h"
#include "apps/station/station_file.h"

namespace palpa::study {
namespace {

namespace fs = std::filesystem;

constexpr const char *kTable = "trials.csv", *kEvidence = "session.palpa", *kReport = "report.html",
                     *kPrinted = "output.txt";
constexpr std::int64_t kCampaignLook_ns = 500 * runtime::kMillisecond;
constexpr std::size_t kHopeless = 10,  ///< failures before the first success: the rest would, too
    kNamed = 10;                       ///< sessions that are named where many could be
/// What a process says whose session is not computed by it.
constexpr const char *kBusy = "another process computes it", *kThere = "another one has",
                     *kLeft = "it was interrupted";

fs::path lockOf(const fs::path& work) { return work.string() + ".lock"; }

/// What a session left that is not to be kept.
void removeRest(const fs::path& folder, CampaignKeeps keeps) {
  for (const fs::path& file : entriesOf(folder)) {
    const std::string name = file.filename().string();
    const bool kept = name == kTable || (name == kEvidence && keeps != CampaignKeeps::table) ||
                      (name != kPrinted && keeps == CampaignKeeps::reports);
    if (!kept) fs::remove_all(file);
  }
}

/// Puts a whole result in its place, where one with less may be.
void putInPlace(const fs::path& work, const fs::path& result) {
  const fs::path less = work.string() + ".less";
  fs::remove_all(less);
  if (fs::exists(result)) fs::rename(result, less);
  fs::rename(work, result);
  fs::remove_all(less);
}

/// Of a session that failed: what it had recorded would fill the disk with what nobody reads.
void keepOnlyWhatWasPrinted(const fs::path& folder) {
  for (const fs::path& file : entriesOf(folder))
    if (file.filename() != kPrinted) fs::remove_all(file);
}

/// In this folder; whether it went to its end.
bool holdSessionIn(const fs::path& work, const PlannedCampaign& plan, std::size_t n) try {
  session::SessionOptions options = sessionOptions(plan.campaign, n, plan.keys[n]);
  options.out = work.string();
  options.report = plan.options.keeps == CampaignKeeps::reports;
  return !session::holdSession(plan.campaign.engine, options).quit;
} catch (...) {
  keepOnlyWhatWasPrinted(work);
  throw;
}

/// In a process of its own: holds a session that nobody else holds.
void holdOne(const PlannedCampaign& plan, std::size_t n, const os::Report& report) {
  const fs::path work = plan.work(n), lock_file = lockOf(work);
  const auto lock = os::FileLock::exclusive(lock_file, os::FileLock::Missing::is_made);
  if (!lock) return report(kBusy);
  if (plan.isDone(n)) {
    fs::remove(lock_file);
    return report(kThere);
  }
  fs::remove_all(work);
  if (const std::error_code problem = os::makeFolders(work))
    failFile("cannot be made", work, problem);
  os::sendOutputTo(work / kPrinted);
  if (!holdSessionIn(work, plan, n)) return report(kLeft);
  removeRest(work, plan.options.keeps);
  putInPlace(work, plan.result(n));
  fs::remove(lock_file);
}

/// What runs left behind that were killed: nobody holds it any more.
void removeLeftovers(const fs::path& folder) {
  for (const fs::path& entry : entriesOf(folder)) {
    if (entry.extension() != ".lock") continue;
    const auto lock = os::FileLock::exclusive(entry, os::FileLock::Missing::fails);
    if (!lock) continue;
    fs::remove_all(fs::path(entry).replace_extension());
    fs::remove_all(fs::path(entry).replace_extension(".less"));
    fs::remove(entry);
  }
}

/// Before a thousand sessions fail for the same reason.
void checkBeforehand(const PlannedCampaign& plan) {
  const Campaign& c = plan.campaign;
  for (std::size_t n = 0; n < c.sessions(); n += static_cast<std::size_t>(c.seeds)) {
    const CampaignSession s = sessionOf(c, n);
    if (s.task != 0 || s.patient != 0) break;  // operators and settings are all there is to settle
    session::SessionOptions options = sessionOptions(c, n, "");
    session::settle(options);
    if (c.station.empty()) continue;
    const station::Station station = station::readStation(c.station);
    session::settleOperator(options, station);
    session::SessionPictures(options, station);  // refuses what cannot be tracked so
  }
}

/// Folders that can be written, on a disk that knows locks.
void makeFoldersOf(const PlannedCampaign& plan) {
  for (const fs::path& folder : {plan.out, plan.out / "results", plan.out / "work"})
    session::makeOutputFolder(folder.string(), "");
  const fs::path probe = plan.out / "work" / (newUuid() + ".probe");
  const auto lock = os::FileLock::exclusive(probe, os::FileLock::Missing::is_made);
  fs::remove(probe);
  if (!lock)
    throw Error("is on a disk that knows no locks: two runs could compute the same",
                plan.out.string(), "Choose a folder on another disk with --out");
}

/// A run of what is missing.
class Run {
 public:
  explicit Run(const PlannedCampaign& plan)
      : plan_(plan),
        pool_(static_cast<std::size_t>(plan.options.jobs > 0 ? plan.options.jobs
                                                             : os::processorsForUs())) {
    std::set<std::string> seen;
    for (std::size_t n = 0; n < plan.keys.size(); ++n) {
      if (!plan.isInPart(n) || !seen.insert(plan.keys[n]).second) continue;
      if (plan.isDone(n))
        ++done_;
      else
        waiting_.push_back(n);
    }
    of_ = done_ + waiting_.size();
  }

  void goThrough() {
    session::WorkProgress progress("sessions", static_cast<int>(of_), plan_.options.quiet);
    for (bool asked = false; !pool_.isIdle() || mayBegin() || mayLookAgain();) {
      progress.done(static_cast<int>(done_));
      begin();
      for (const os::WorkerNews& news : pool_.await(kCampaignLook_ns)) learn(news);
      if (interrupt_.noted() && !std::exchange(asked, true)) pool_.askToEnd();
    }
  }

  void sayHowItWent() const {
    std::printf("%s, %zu computed now\n", counted(of_, "session").c_str(), computed_);
    for (std::size_t i = 0; i < failures_.size() && i < kNamed; ++i)
      std::printf("Failed: %s: %s\n", plan_.nameOf(failures_[i].first).c_str(),
                  failures_[i].second.c_str());
    if (failures_.size() > kNamed)
      std::printf("and %s like these\n",
                  counted(failures_.size() - kNamed, "further session").c_str());
  }

  /// Throws Error where something is missing.
  void needAll() const {
    const std::string missing = std::to_string(of_ - done_) + " of " + counted(of_, "session");
    if (interrupt_.noted())
      throw Error("was interrupted: " + missing + " missing", plan_.options.file,
                  "The same command continues");
    if (!failures_.empty())
      throw Error(missing + " missing, " + std::to_string(failures_.size()) + " failed",
                  plan_.options.file,
                  "See to the reasons above; the same command tries them again");
  }

  bool wasInterrupted() const { return interrupt_.noted(); }

 private:
  bool mayGoOn() const {
    return !interrupt_.noted() && (computed_ > 0 || failures_.size() < kHopeless);
  }
  bool mayBegin() const { return !waiting_.empty() && mayGoOn(); }
  bool mayLookAgain() const { return !aside_.empty() && mayGoOn(); }

  /// Those that another runner computed a look ago may be free now.
  void lookAgain() {
    if (!aside_.empty() && pool_.isIdle() && waiting_.empty())  // others compute all of it
      runtime::rest(std::chrono::nanoseconds(kCampaignLook_ns));
    const auto now = runtime::ServingClock::now();
    for (; !aside_.empty() && aside_.front().second <= now; aside_.pop_front())
      waiting_.push_back(aside_.front().first);
  }

  void begin() {
    lookAgain();
    while (mayBegin() && !pool_.isFull()) {
      const std::size_t n = waiting_.front();
      waiting_.pop_front();
      if (plan_.isDone(n))
        ++done_;
      else
        pool_.start(n, [this, n](const os::Report& report) { holdOne(plan_, n, report); });
    }
  }

  void learn(const os::WorkerNews& news) {
    if (!news.lines.empty()) said_[news.item] = news.lines.back();
    if (!news.ended) return;
    const std::string said = said_[news.item];
    said_.erase(news.item);
    if (said == kBusy) {
      aside_.emplace_back(
          news.item, runtime::ServingClock::now() + std::chrono::nanoseconds(kCampaignLook_ns));
    } else if (!news.failure.empty() || said == kLeft) {
      if (!interrupt_.noted())
        failures_.emplace_back(news.item, news.failure.empty() ? kLeft : news.failure);
    } else {
      ++done_;
      computed_ += said != kThere;
    }
  }

  const PlannedCampaign& plan_;
  os::WorkerPool pool_;
  const os::InterruptNote interrupt_;
  std::deque<std::size_t> waiting_;
  /// another runner computes them; and when to ask again
  std::deque<std::pair<std::size_t, runtime::ServingClock::time_point>> aside_;
  std::map<std::size_t, std::string> said_;  ///< by those that run
  std::vector<std::pair<std::size_t, std::string>> failures_;
  std::size_t of_ = 0, done_ = 0, computed_ = 0;
};

}  // namespace

PlannedCampaign::PlannedCampaign(const CampaignOptions& given)
    : campaign(readCampaign(given.file)),
      options(given),
      out(given.out.empty() ? fs::path("out") / ("campaign-" + campaign.id) : fs::path(given.out)),
      keys(keysOf(campaign)) {}

bool PlannedCampaign::isDone(std::size_t n) const {
  std::error_code none;
  const auto has = [&](const char* name) { return fs::exists(result(n) / name, none); };
  return has(kTable) && (options.keeps == CampaignKeeps::table || has(kEvidence)) &&
         (options.keeps != CampaignKeeps::reports || has(kReport));
}

bool PlannedCampaign::isInPart(std::size_t n) const {
  const auto parts = static_cast<std::size_t>(options.parts);
  return n % parts == static_cast<std::size_t>(options.part) % parts;
}

std::string PlannedCampaign::nameOf(std::size_t n) const {
  const CampaignSession s = sessionOf(campaign, n);
  return campaign.tasks[s.task].stem().string() + ", patient " + campaign.patients[s.patient].name +
         ", " + campaign.operators[s.who].name + ", setting " + campaign.settings[s.setting].name +
         ", seed " + std::to_string(s.seed);
}

void runCampaign(const CampaignOptions& options) {
  const PlannedCampaign plan(options);
  checkBeforehand(plan);
  if (options.parts == 1) prepareRecords(plan);
  removeLeftovers(plan.out / "work");  // first: it makes room where the disk is full
  makeFoldersOf(plan);
  std::printf("%s: %s\n", plan.campaign.title.c_str(), sizeInWords(plan.campaign).c_str());
  Run run(plan);
  run.goThrough();
  run.sayHowItWent();
  if (options.parts == 1 && !run.wasInterrupted()) collectTable(plan);
  run.needAll();
  if (options.parts == 1) deliverCampaign(plan);
}

}  // namespace palpa::study

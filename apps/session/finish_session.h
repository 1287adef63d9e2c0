#pragma once

#include <filesystem>
#include <memory>
#include <vector>

#include "apps/record/store/delivery.h"

/// What a session owes whose program died, or was left behind because a part of it hung: report and
/// table, made from its evidence, and its trials in the records.
namespace palpa::session {

/// A session from before its first tick until its report is written: noted in this user's folder of
/// states and held there, so that others see that it runs, and that it was left when its program
/// dies. Without such a folder nothing is noted; that stops no session.
class BegunSession {
 public:
  explicit BegunSession(const std::filesystem::path& folder);
  ~BegunSession();  ///< forgotten, where report and table are there
  BegunSession(const BegunSession&) = delete;
  BegunSession& operator=(const BegunSession&) = delete;

 private:
  const std::filesystem::path folder_;
  std::unique_ptr<record::PendingHold> hold_;
};

/// Folders of this user's sessions whose program ended before report and table; the newest first.
std::vector<std::filesystem::path> unfinishedSessions();

/// One line on standard error, once in a process, where there are any.
void offerUnfinished();

enum class FinishAgain { no, yes };

/// Writes report.html and trials.csv beside the evidence as the session would have, as far as it
/// came, and delivers what was noted for the records; then standard output says what was written.
/// Where nothing is owed it says so and changes nothing, unless it shall be made again. `session`:
/// a folder, or its session.palpa. Throws UsageError where there is no session or one that runs,
/// Error where its evidence is damaged.
void finishSession(const std::filesystem::path& session, FinishAgain again);

/// The same of a session that failed in the middle, by the session itself, with the reason in the
/// report; nothing where no trial had ended, or where it cannot be made: it is owed then.
void reportFailed(const std::filesystem::path& folder, const std::string& why) noexcept;

}  // namespace palpa::session

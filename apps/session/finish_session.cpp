#include "apps/session/finish_session.h"

#include <algorithm>
#include <cstdio>
#include <utility>

#include "anatomy/base/counted.h"
#include "anatomy/base/error.h"
#include "anatomy/base/json_file.h"
#include "anatomy/base/sha256.h"
#include "anatomy/base/whole_file.h"
#include "apps/evidence/recorded_session.h"
#include "apps/evidence/recorded_trials.h"
#include "apps/os/file_access.h"
#include "apps/runtime/clock.h"
#include "apps/session/comparison_session.h"
#include "apps/session/needle_session.h"
#include "apps/session/palpation_session.h"
#include "apps/session/pulse_session.h"
#include "apps/session/search_session.h"
#include "apps/session/session_facts.h"
#include "apps/session/session_records.h"

namespace palpa::session {
namespace {

namespace fs = std::filesystem;
using training::Engine;

constexpr char kEvidenceName[] = "session.palpa", kReportName[] = "report.html",
               kTableName[] = "trials.csv", kDemonstration[] = "demonstration";
constexpr std::size_t kNoteName = 32;  // of a hash's digits

/// The same kind of list as of what waits for the records, in a folder beside it.
record::PendingList begunSessions() {
  return record::PendingList(os::stateFolder("Set HOME, or XDG_STATE_HOME to a folder of yours") /
                             "palpa/begun");
}

std::string noteNameOf(const fs::path& folder) {
  return sha256(folder.string()).substr(0, kNoteName);
}

bool owesFiles(const fs::path& folder) {
  std::error_code none;
  return fs::exists(folder / kEvidenceName, none) &&
         !(fs::exists(folder / kReportName, none) && fs::exists(folder / kTableName, none));
}

fs::path wholePath(const fs::path& path) { return fs::absolute(path).lexically_normal(); }

}  // namespace

BegunSession::BegunSession(const fs::path& folder) : folder_(wholePath(folder / "").parent_path()) {
  try {
    record::PendingList begun = begunSessions();
    const std::string name = noteNameOf(folder_);
    if (begun.isHeld(name)) return;  // of a session that was first in this folder
    begun.note({name, folder_ / kEvidenceName, ""});
    hold_ = begun.hold(name);
  } catch (const Error&) {
    // no place for it: a session that dies is then found by whoever knows its folder
  }
}

BegunSession::~BegunSession() {
  if (!hold_ || owesFiles(folder_)) return;
  try {
    begunSessions().forget(noteNameOf(folder_));
  } catch (const std::exception&) {  // looked through again by the next who asks
  }
}

std::vector<fs::path> unfinishedSessions() {
  std::vector<std::pair<fs::file_time_type, fs::path>> left;
  try {
    record::PendingList begun = begunSessions();
    for (const record::PendingSession& session : begun.sessions()) {
      const fs::path folder = session.evidence.parent_path();
      if (begun.isHeld(session.uuid)) continue;
      std::error_code none;
      if (owesFiles(folder))
        left.emplace_back(fs::last_write_time(session.evidence, none), folder);
      else
        begun.forget(session.uuid);
    }
  } catch (const Error&) {  // without a folder of states nothing was noted
  }
  std::sort(left.rbegin(), left.rend());
  std::vector<fs::path> folders;
  for (auto& [written, folder] : left) folders.push_back(std::move(folder));
  return folders;
}

void offerUnfinished() {
  static bool offered = false;
  if (std::exchange(offered, true)) return;
  const std::vector<fs::path> left = unfinishedSessions();
  if (left.empty()) return;
  const std::string more = left.size() > 1 ? "; " + counted(left.size() - 1, "more session") +
                                                 " likewise: palpa finish lists them"
                                           : "";
  std::fprintf(stderr, "A session was not finished: %s. Its report and table: palpa finish %s%s\n",
               left.front().c_str(), left.front().c_str(), more.c_str());
}

namespace {

/// A session that is to be finished.
struct LeftSession {
  fs::path evidence, folder;
  record::SessionReader reader;
  std::vector<record::RecordedTrial> trials;

  explicit LeftSession(const fs::path& file)
      : evidence(file), folder(file.parent_path()), reader(file), trials(reader.trials()) {}
  std::size_t ended() const {
    return static_cast<std::size_t>(
        std::count_if(trials.begin(), trials.end(), [](const auto& t) { return t.ended; }));
  }
};

fs::path evidenceOf(const fs::path& given) {
  std::error_code none;
  fs::path file = wholePath(fs::is_directory(given, none) ? given / kEvidenceName : given);
  if (!fs::is_regular_file(file, none))
    throw UsageError("is not there", file.string(),
                     "Give the folder of a session, or its session.palpa; palpa finish alone lists "
                     "the sessions that were not finished");
  return file;
}

bool isHeld(const fs::path& folder) {
  try {
    return begunSessions().isHeld(noteNameOf(folder));
  } catch (const Error&) {  // nothing was noted
    return false;
  }
}

void requireNotRunning(const fs::path& folder) {
  if (!runtime::comesTrue(runtime::kKilledLetsGo, [&] { return !isHeld(folder); }))
    throw UsageError(
        "is still running, or is being finished", folder.string(),
        "Wait until it is over; Escape twice, or Ctrl-C, ends a session with its report");
}

/// Those whose files are there.
std::vector<trial::SavedPicture> picturesIn(const std::vector<runtime::Event>& events,
                                            const fs::path& folder) {
  std::vector<trial::SavedPicture> pictures;
  for (const runtime::Event& event : events) {
    if (!event.is(runtime::EventKind::picture)) continue;
    const trial::PictureInWords words = trial::pictureIn(event.text);
    std::error_code none;
    if (words.file.empty() || !fs::is_regular_file(folder / words.file, none)) continue;
    pictures.push_back({folder / words.file, {event.trial, event.value, "", words.caption}});
  }
  return pictures;
}

constexpr char kProgramEnded[] =
    "The session's program ended before its report: this was made from the evidence by palpa "
    "finish";
constexpr char kMadeAgain[] = "It was made again from the evidence by palpa finish";

/// `made`: how the report came about.
ReportTail tailOf(const LeftSession& session, const std::string& made) {
  const std::vector<runtime::Event> events = session.reader.events();
  SessionRun run;
  std::copy_if(events.begin(), events.end(), std::back_inserter(run.safety_events),
               trial::isForTheReport);
  ReportTail tail{picturesIn(events, session.folder), {}};
  tail.notes.push_back(
      {"This report", made, "what only the running program knew, as its lateness, is not told"});
  for (const record::RecordedTrial& trial : session.trials)
    if (!trial.ended)
      tail.notes.push_back({"Trial " + std::to_string(trial.header.trial), "was not finished",
                            "the session broke off in the middle of it: it is not scored"});
  for (report::Fact& fact : runNotes(run)) tail.notes.push_back(std::move(fact));
  return tail;
}

/// Those that ended, of trials judged again.
template <class Trial, class Recorded, class Judged>
std::vector<Trial> endedOnes(std::vector<Recorded> recorded, Judged judged) {
  std::vector<Trial> ended;
  for (Recorded& trial : recorded)
    if (trial.recorded.ended)
      ended.push_back({std::move(trial.*judged), trial.recorded.end.reason});
  return ended;
}

void writeNeedle(const LeftSession& session, const ReportHead& head, const ReportTail& tail) {
  const evidence::RecordedSession recorded(session.evidence);
  writeNeedleResults(head,
                     endedOnes<task_needle::CompletedTrial>(recordedNeedles(recorded),
                                                            &evidence::RecordedNeedle::again),
                     tail, recorded.X_DA(), recorded.views(), session.evidence);
}

void writePalpation(const LeftSession& session, const ReportHead& head, const ReportTail& tail) {
  const task_palpation::Scoring scoring = task_palpation::scoringOf(
      JsonFile::ofText(session.reader.info().task_json, "the recorded task"));
  writePalpationResults(
      head,
      endedOnes<task_palpation::CompletedPalpation>(evidence::recordedPalpations(session.reader),
                                                    &evidence::RecordedPalpation::assessment),
      scoring, tail, session.evidence);
}

void writeReportOf(const LeftSession& session, const std::string& made) {
  const ReportHead head = headIn(session.reader.info(), session.evidence.string());
  const ReportTail tail = tailOf(session, made);
  switch (evidence::engineOf(session.reader)) {
    case Engine::needle:
      return writeNeedle(session, head, tail);
    case Engine::palpation:
      return writePalpation(session, head, tail);
    case Engine::search:
      return writeSearchResults(
          head,
          endedOnes<task_search::CompletedSearch>(evidence::recordedSearches(session.reader),
                                                  &evidence::RecordedSearch::again),
          tail, session.evidence);
    case Engine::squeeze:
    case Engine::friction:
      return writeComparisonResults(
          head,
          endedOnes<task_comparison::CompletedComparison>(
              evidence::recordedComparisons(session.reader), &evidence::RecordedComparison::again),
          tail, session.evidence);
    case Engine::pulse:
      return writePulseResults(
          head,
          endedOnes<task_pulse::CompletedPulse>(evidence::recordedPulses(session.reader),
                                                &evidence::RecordedPulse::again),
          task_pulse::rulesIn(
              JsonFile::ofText(session.reader.info().task_json, "the recorded task")),
          tail, session.evidence);
  }
}

/// Where its trials are still to go; empty: nowhere.
std::string recordsNotedFor(const std::string& uuid) {
  try {
    const record::PendingList pending(record::PendingList::usualFolder());
    for (const record::PendingSession& session : pending.sessions())
      if (session.uuid == uuid && !pending.isHeld(uuid)) return session.url;
  } catch (const Error&) {  // without a folder of states nothing was noted
  }
  return "";
}

/// Report and table, both or none.
void makeFiles(const LeftSession& session, const std::string& made) {
  const BegunSession held(session.folder);
  WrittenTogether written;
  writeReportOf(session, made);
  written.keep();
}

void deliverNoted(const std::string& records, const fs::path& folder) {
  if (records.empty()) return;
  SessionOptions delivered;
  delivered.records = records;
  delivered.quiet = true;
  deliverSession(delivered, folder);
}

void sayFinished(const LeftSession& session) {
  const std::size_t ended = session.ended(), open = session.trials.size() - ended;
  std::printf("%s judged from the evidence%s\n", counted(ended, "trial").c_str(),
              open > 0 ? "; one was not finished, and is not scored" : "");
  std::printf(
      "Written to %s:\n  report.html     what happened, as far as the session came: open this "
      "first\n  trials.csv      one row a scored trial\n",
      session.folder.c_str());
}

}  // namespace

void finishSession(const fs::path& given, FinishAgain again) {
  const fs::path evidence = evidenceOf(given), folder = evidence.parent_path();
  requireNotRunning(folder);
  const LeftSession session(evidence);
  const bool anew = again == FinishAgain::yes,
             demonstration = session.reader.info().command == kDemonstration;
  const std::string records = recordsNotedFor(session.reader.info().uuid);
  if ((demonstration || !owesFiles(folder)) && !anew && records.empty()) {
    std::printf("Nothing is owed: %s\n",
                demonstration ? "a demonstration has no report"
                              : ("report.html and trials.csv are in " + folder.string()).c_str());
    return;
  }
  if (owesFiles(folder) || anew) {
    makeFiles(session, owesFiles(folder) ? kProgramEnded : kMadeAgain);
    sayFinished(session);
  }
  deliverNoted(records, folder);
}

void reportFailed(const fs::path& folder, const std::string& why) noexcept {
  try {
    const LeftSession session(wholePath(folder) / kEvidenceName);
    if (session.ended() == 0 || !owesFiles(folder)) return;
    makeFiles(session, "The session failed: " + why.substr(0, why.find('\n')) +
                           ". This was made from its evidence");
    deliverNoted(recordsNotedFor(session.reader.info().uuid), session.folder);
  } catch (const std::exception&) {  // palpa finish says why it cannot
  }
}

}  // namespace palpa::session

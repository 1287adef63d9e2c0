#include "apps/study/run/study_run.h"

#include <cmath>
#include <cstdio>

#include "anatomy/base/counted.h"
#include "anatomy/base/error.h"
#include "anatomy/base/sha256.h"
#include "anatomy/base/uuid.h"
#include "apps/evidence/evidence_records.h"
#include "apps/record/store/delivery.h"
#include "apps/record/store/study_store.h"
#include "apps/runtime/clock.h"
#include "apps/session/output_folder.h"
#include "apps/session/whole_session.h"
#include "apps/station/station_file.h"
#include "apps/study/progress.h"
#include "apps/study/run/participant.h"
#include "apps/study/run/session.h"

namespace palpa::study {
namespace {

namespace fs = std::filesystem;
using study::Next;

const char* plural(int count) { return count == 1 ? "" : "s"; }

/// Trials on a station that is not calibrated would count for nothing.
void needCalibrated(const StudyOptions& o) {
  if (o.session.station.empty()) return;
  station::Station station = station::readStation(o.session.station);
  station::judgeAge(station, runtime::utcNow());
  if (!station.calibrated())
    throw UsageError(
        "is not calibrated (" + station.calibration_verdict + "), so no trial would count",
        o.session.station, "Calibrate it: palpa calibrate all");
}

void greet(const study::Protocol& protocol, const StudyParticipant& participant) {
  const record::Enrolment& e = participant.enrolment();
  std::printf("%s\nTrainee %s, group %s%s%s\n", protocol.title.c_str(), e.trainee.c_str(),
              e.group.c_str(), e.simulated ? ", simulated" : "",
              participant.trials() ? ": continues" : ": begins");
  if (!protocol.blind() && !e.condition.empty())
    std::printf("Condition: %s, %s\n", e.condition.c_str(),
                protocol.condition(e.condition)->means.c_str());
  if (!participant.online())
    std::printf(
        "The records cannot be reached: this station's own notes are used, what is done is sent "
        "later\n");
}

void rest(const Next& next, bool fast) {
  const int seconds = static_cast<int>(std::lround(next.rest_s));
  if (fast || seconds <= 0) return;
  std::printf("Rest: %d s (Ctrl-C leaves; the same command continues)\n", seconds);
  std::fflush(stdout);
  runtime::SteadyClock().sleepUntil(seconds * runtime::kSecond);
}

void announce(const study::Protocol& protocol, const Next& next) {
  const study::Session& session = protocol.sessions[static_cast<std::size_t>(next.session - 1)];
  const study::Block& block = protocol.block(next.step);
  std::printf(
      "\nSession %d of %zu (%s), %s: %d trial%s%s\n", next.session, protocol.sessions.size(),
      session.name.c_str(), block.name.c_str(), next.trials, plural(next.trials),
      next.done
          ? (", " + std::to_string(next.done) + " of " + std::to_string(block.trials) + " are done")
                .c_str()
          : "");
  std::fflush(stdout);
}

/// Noted before its first trial, so that even a killed program has lost none that ended.
session::SessionLeft holdTrials(const StudyOptions& o, const study::Protocol& protocol,
                                const StudyParticipant& participant, const Next& next) {
  session::SessionOptions session =
      studySession(o.session, protocol, participant.enrolment(), next);
  session.out =
      studyFolder(o.session.out, protocol, participant.enrolment().trainee, next).string();
  record::PendingList pending(record::PendingList::usualFolder());
  pending.note(
      {session.uuid, fs::path(session.out) / "session.palpa", evidence::absoluteRecords(o.url)});
  const auto held = pending.hold(session.uuid);
  try {
    return session::holdSession(protocol.block(next.step).engine, session);
  } catch (...) {
    if (!fs::exists(fs::path(session.out) / "session.palpa")) pending.forget(session.uuid);
    throw;
  }
}

int countingTrials(const StudyParticipant& participant) {
  int count = 0;
  for (const study::DoneTrial& trial : participant.done()) count += trial.counts();
  return count;
}

/// False: left.
bool trialsHeld(const StudyOptions& o, const study::Protocol& protocol,
                StudyParticipant& participant, const Next& next) {
  rest(next, o.session.fast);
  announce(protocol, next);
  const int before = countingTrials(participant);
  const session::SessionLeft left = holdTrials(o, protocol, participant, next);
  participant.refresh();
  const int counted = countingTrials(participant) - before;
  std::printf("%d trial%s kept%s\n", counted, plural(counted),
              participant.online()
                  ? " in the records"
                  : " on this station; they are sent when the records can be reached");
  if (left.quit) return false;
  if (counted == 0)
    throw Error("no trial of this session counts", left.folder.string(),
                "See why in its report, then start again: the same command continues");
  return true;
}

bool answered(const StudyOptions& o, const study::Protocol& protocol, StudyParticipant& participant,
              const Next& next) {
  const study::Questionnaire& questionnaire =
      *protocol.sessions[static_cast<std::size_t>(next.session - 1)].questionnaire;
  return o.answers.empty() ? askQuestions(questionnaire, next, participant)
                           : takeAnswers(o.answers, questionnaire, next, participant);
}

void sayFarewell(const Next& next, const study::Protocol& protocol, int session) {
  if (next.kind == NextKind::finished) {
    std::printf("\nFinished: all of %s\n", protocol.id.c_str());
    return;
  }
  std::printf("\nSession %d of %zu is done; the next one%s\n", session, protocol.sessions.size(),
              next.not_before.empty() ? " can begin" : (": not before " + next.not_before).c_str());
}

/// Nobody's to predict, and kept in the records, where everything follows from it.
std::uint64_t drawnSeed() { return std::stoull(sha256(newUuid()).substr(0, 16), nullptr, 16); }

}  // namespace

void runStudySession(const StudyOptions& o) {
  const study::Protocol protocol = study::readProtocol(o.protocol);
  needCalibrated(o);
  StudyParticipant participant(protocol, o.trainee, o.url, o.seed ? o.seed : drawnSeed());
  greet(protocol, participant);
  const int session = participant.next(runtime::utcNow()).session;
  for (;;) {
    const Next next = participant.next(runtime::utcNow());
    for (const std::string& remark : next.remarks) std::printf("Note: %s\n", remark.c_str());
    if (next.kind == NextKind::finished || next.session != session)
      return sayFarewell(next, protocol, session);
    if (!next.not_before.empty())
      throw UsageError("must not begin before " + next.not_before,
                       "session " + std::to_string(next.session) + " of trainee " + o.trainee,
                       "Come back then");
    const bool done = next.kind == NextKind::trials ? trialsHeld(o, protocol, participant, next)
                                                    : answered(o, protocol, participant, next);
    if (done) continue;
    std::printf("\nNot finished: the same command continues from here\n");
    return;
  }
}

namespace {

using study::Next;

void reportTrainee(const study::Protocol& protocol, record::RecordStore& store,
                   const record::Enrolment& e) {
  std::vector<study::DoneTrial> trials;
  for (const record::TrialWithSession& t :
       store.trials({.trainee = e.trainee, .study = protocol.id}))
    trials.push_back(study::doneTrial(t.session, t.trial));
  std::vector<std::pair<int, std::string>> answered;
  for (const record::ItemAnswer& a : record::StudyStore(store).answers(protocol.id, e.trainee))
    answered.emplace_back(static_cast<int>(a.session), a.item);
  const Next next = study::nextOf(protocol, e.condition, trials, answered, runtime::utcNow());
  std::printf("  %-12s %-14s %s%s\n", e.trainee.c_str(), e.group.c_str(),
              study::whereIs(protocol, next).c_str(), e.simulated ? " (simulated)" : "");
  for (const std::string& remark : next.remarks) std::printf("    Note: %s\n", remark.c_str());
}

/// Counts of a group alone: those of conditions would tell who is next.
void reportGroup(const study::Protocol& protocol, record::StudyStore& studies,
                 const std::string& group) {
  const std::int64_t given = studies.placesGiven(protocol.id, group);
  std::printf("  %-14s %s assigned", group.c_str(), counted(given, "place").c_str());
  if (protocol.allocation)
    std::printf(
        given % protocol.allocation->block ? "; balanced again after %lld more"
                                           : "; conditions balanced",
        static_cast<long long>(protocol.allocation->block - given % protocol.allocation->block));
  std::printf("\n");
}

}  // namespace

void reportStudy(const StudyOptions& o) {
  const study::Protocol protocol = study::readProtocol(o.protocol);
  record::RecordStore store(o.url);
  record::StudyStore studies(store);
  std::printf("%s (%s)\nTrials and rests of a trainee: %s\n", protocol.title.c_str(),
              protocol.id.c_str(), study::longestTimeInWords(protocol).c_str());
  for (const study::Group& group : protocol.groups) reportGroup(protocol, studies, group.name);
  const std::vector<record::Enrolment> enrolled = studies.enrolments(protocol.id);
  std::printf("%zu enrolled\n", enrolled.size());
  for (const record::Enrolment& e : enrolled) reportTrainee(protocol, store, e);
}

}  // namespace palpa::study

#include <cmath>
#include <cstdio>

#include "anatomy/base/counted.h"
#include "anatomy/base/error.h"
#include "apps/cli/arguments.h"
#include "apps/cli/records_actions.h"
#include "apps/runtime/clock.h"

namespace palpa::cli {
namespace {

std::string agreed(const std::string& utc) {
  return utc.empty() ? "not agreed" : "agreed on " + utc.substr(0, 10);
}

void printTrial(const record::StoredTrial& t) {
  const double seconds = t.metric("time_s"), total = t.metric("total"),
               found = t.metric("sensitivity_pct");
  std::printf("    trial %lld (%s): %s", static_cast<long long>(t.number), t.role.c_str(),
              t.outcome.c_str());
  if (std::isfinite(seconds)) std::printf(", %.1f s", seconds);
  if (std::isfinite(total)) std::printf(", total penalty %.1f", total);
  if (std::isfinite(found)) std::printf(", %.0f %% of the lumps found", found);
  std::printf("%s%s%s\n", t.force_feedback ? "" : ", without force feedback",
              t.reason.empty() ? "" : ": ", t.reason.c_str());
}

void printSession(const record::StoredSession& s) {
  std::printf("  session %lld, %s: %s at %s%s", static_cast<long long>(s.arrival),
              s.started_utc.c_str(), s.task.c_str(), s.station.c_str(),
              s.simulated ? ", simulated" : "");
  if (!s.study.empty())
    std::printf(", study %s, slot %lld", s.study.c_str(), static_cast<long long>(s.slot));
  std::printf("\n");
}

}  // namespace

record::Trainee traineeIn(record::RecordStore& store, const std::string& id) {
  const std::optional<record::Trainee> t = store.trainee(id);
  if (!t)
    throw UsageError("is not in the records", "trainee " + id,
                     "palpa records trainee list shows who is in them");
  return *t;
}

void showTrainee(const RecordsOptions& o) {
  requireRecords(o.url);
  record::RecordStore store(o.url);
  const record::Trainee t = traineeIn(store, o.trainee.id);
  const std::vector<record::TrialWithSession> trials = store.trials({.trainee = t.id});
  const std::vector<record::StoredSession> sessions = store.sessions(t.id);
  std::printf("Trainee %s%s%s, %s-handed%s%s, since %s\n", t.id.c_str(),
              t.group.empty() ? "" : ", ", t.group.c_str(), t.handedness.c_str(),
              t.experience.empty() ? "" : ", ", t.experience.c_str(),
              t.added_utc.substr(0, 10).c_str());
  std::printf("  training records: %s; use in studies: %s; keep until: %s\n",
              agreed(t.consent_utc).c_str(), agreed(t.research_utc).c_str(),
              t.retain_until.empty() ? "no limit was set" : t.retain_until.c_str());
  std::printf("  %s, %s\n", counted(sessions.size(), "session").c_str(),
              counted(trials.size(), "trial").c_str());
  auto next = trials.begin();  // both are in the order of arrival
  for (const record::StoredSession& s : sessions) {
    printSession(s);
    for (; next != trials.end() && next->session.uuid == s.uuid; ++next) printTrial(next->trial);
  }
}

void listOverdue(const RecordsOptions& o) {
  record::RecordStore store(o.url);
  const std::string date = o.date.empty() ? runtime::utcNow().substr(0, 10) : o.date;
  const std::vector<record::Trainee> over = store.overdue(date);
  std::printf("On %s the time of %s is over\n", date.c_str(),
              counted(over.size(), "trainee").c_str());
  for (const record::Trainee& t : over)
    std::printf("  %-16s keep until %s, %s\n", t.id.c_str(), t.retain_until.c_str(),
                counted(store.sessions(t.id).size(), "session").c_str());
  if (!o.remove || over.empty()) return;
  if (!o.yes)
    throw UsageError(
        "would delete the records and evidence of " + counted(over.size(), "person") + " for good",
        "--delete", "Add --yes if that is meant");
  std::vector<std::string> ids;
  for (const record::Trainee& t : over) ids.push_back(t.id);
  deletePeople(store, o, ids);
}

void deletePerson(const RecordsOptions& o) {
  requireRecords(o.url);
  record::RecordStore store(o.url);
  const int meant = (o.trainee.id.empty() ? 0 : 1) + (o.left ? 1 : 0) + (o.forget.empty() ? 0 : 1);
  if (meant != 1)
    throw UsageError("states what is meant", "--id, --left or --forget", "Give one of them");
  if (o.left) return deleteLeft(store, o);
  if (!o.forget.empty()) return forgetLeft(store, o.forget);
  const std::size_t sessions = store.sessions(traineeIn(store, o.trainee.id).id).size();
  if (!o.yes)
    throw UsageError("would delete this person's " + counted(sessions, "session") +
                         " with their evidence for good",
                     "trainee " + o.trainee.id, "Add --yes if that is meant");
  deletePeople(store, o, {o.trainee.id});
}

}  // namespace palpa::cli

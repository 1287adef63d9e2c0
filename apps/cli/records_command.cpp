#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <memory>

#include "anatomy/geometry/error.h"
#include "anatomy/geometry/whole_file.h"
#include "apps/assess/metrics/metric_table.h"
#include "apps/cli/commands.h"
#include "apps/cli/evidence_delivery.h"
#include "apps/cli/output_folder.h"
#include "apps/cli/records_place.h"
#include "apps/cli/study_copy.h"
#include "apps/record/session_file.h"
#include "apps/record/store/pending.h"

namespace palpa::cli {
namespace {

namespace fs = std::filesystem;

struct RecordsOptions {
  std::string url;
  record::Trainee trainee;
  std::string group, experience, handedness, retain_until;   ///< of a change: empty leaves it
  bool consent = false, research = false, yes = false;
  std::vector<std::string> sessions;
  std::string out;
};

void print(const record::Trainee& t, std::size_t sessions) {
  std::printf("%-16s %-14s %-20s %-6s consent %-10s research %-10s keep until %-10s %zu session%s\n", t.id.c_str(), t.group.c_str(), t.experience.c_str(), t.handedness.c_str(),
              t.consent_utc.empty() ? "no" : t.consent_utc.substr(0, 10).c_str(), t.research_utc.empty() ? "no" : t.research_utc.substr(0, 10).c_str(), t.retain_until.empty() ? "-" : t.retain_until.c_str(),
              sessions, sessions == 1 ? "" : "s");
}

void addTrainee(RecordsOptions o) {
  record::RecordStore store(o.url);
  o.trainee.group = o.group;
  o.trainee.experience = o.experience;
  o.trainee.handedness = o.handedness.empty() ? "right" : o.handedness;
  o.trainee.retain_until = o.retain_until;
  o.trainee.added_utc = utcNow();
  if (o.consent) o.trainee.consent_utc = o.trainee.added_utc;
  if (o.research) o.trainee.research_utc = o.trainee.added_utc;
  store.addTrainee(o.trainee);
  std::printf("Trainee %s added to the %s\n", o.trainee.id.c_str(), store.place().c_str());
  if (!o.consent) std::printf("Consent to keeping training records is not noted: palpa records trainee change --id %s --consent\n", o.trainee.id.c_str());
}

void changeTrainee(const RecordsOptions& o) {
  record::RecordStore store(o.url);
  std::optional<record::Trainee> t = store.trainee(o.trainee.id);
  if (!t) throw UsageError("is not in the records", "trainee " + o.trainee.id, "palpa records trainee list shows who is");
  if (!o.group.empty()) t->group = o.group;
  if (!o.experience.empty()) t->experience = o.experience;
  if (!o.handedness.empty()) t->handedness = o.handedness;
  if (!o.retain_until.empty()) t->retain_until = o.retain_until;
  if (o.consent) t->consent_utc = utcNow();
  if (o.research) t->research_utc = utcNow();
  store.changeTrainee(*t);
  print(*t, store.sessions(t->id).size());
}

void listTrainees(const RecordsOptions& o) {
  record::RecordStore store(o.url);
  const std::vector<record::Trainee> all = store.trainees();
  std::printf("%zu trainee%s in the %s\n", all.size(), all.size() == 1 ? "" : "s", store.place().c_str());
  for (const record::Trainee& t : all) print(t, store.sessions(t.id).size());
}

void deliverEvidence(const fs::path& file, const std::string& url) {
  const EvidenceRecords records = recordsOf(file);
  try {
    const record::Delivered delivered = deliverSession(file, records, url);
    std::printf("%s: trainee %s, %d trial%s added, %d there already%s\n", file.string().c_str(), records.session.trainee.c_str(), delivered.added, delivered.added == 1 ? "" : "s", delivered.present,
                records.unfinished ? ", one unfinished left out" : "");
  } catch (const record::StoreUnreachable&) {
    std::printf("%s: noted; palpa records deliver sends it\n", file.string().c_str());
    throw;
  }
}

void addSessions(const RecordsOptions& o) {
  for (const std::string& session : o.sessions) deliverEvidence(fs::is_directory(session) ? fs::path(session) / "session.palpa" : fs::path(session), o.url);
}

void deliverPending(const RecordsOptions&) {
  const auto waiting = record::PendingList(record::PendingList::usualFolder()).sessions();
  if (waiting.empty()) std::printf("Nothing waits to be delivered\n");
  for (const record::PendingSession& session : waiting) deliverEvidence(session.evidence, session.url);
}

/// Only what is this session's evidence: another file may lie there by now.
bool removeEvidence(const record::StoredSession& session) {
  try {
    if (record::SessionReader(session.evidence).info().uuid != session.uuid) return false;
  } catch (const Error&) {   // not here, or not to be read
    return false;
  }
  std::error_code problem;
  const bool gone = fs::remove(session.evidence, problem);
  for (const char* beside : {"-wal", "-shm"}) fs::remove(session.evidence + beside, problem);
  return gone;
}

void deletePerson(const RecordsOptions& o) {
  record::RecordStore store(o.url);
  const std::size_t sessions = store.sessions(o.trainee.id).size();
  if (!o.yes) throw UsageError("would delete this person's " + std::to_string(sessions) + " sessions with their evidence for good", "trainee " + o.trainee.id, "Add --yes if that is meant");
  removeStudyCopies(o.trainee.id);
  for (const record::StoredSession& session : store.deletePerson(o.trainee.id, utcNow())) {
    if (!removeEvidence(session)) continue;
    store.evidenceDeleted(session.uuid);
    std::printf("Deleted: %s; its folder may still hold a report and pictures\n", session.evidence.c_str());
  }
  std::printf("Trainee %s and %zu session%s deleted; late deliveries will be refused\n", o.trainee.id.c_str(), sessions, sessions == 1 ? "" : "s");
  for (const record::StoredSession& left : store.evidenceToDelete())
    std::printf("Still to be deleted where it was made: %s (session %s)\n", left.evidence.c_str(), left.uuid.c_str());
}

void writeMetrics(const RecordsOptions& o) {
  const std::string text = metrics::metricsAsMarkdown();
  if (o.out.empty()) {
    std::fputs(text.c_str(), stdout);
    return;
  }
  writeWhole(o.out, text);
  std::printf("Written: %s\n", o.out.c_str());
}

/// A subcommand with the options that all of them share.
CLI::App* sub(CLI::App* parent, const std::shared_ptr<RecordsOptions>& o, const char* name, const char* help, void (*action)(const RecordsOptions&)) {
  CLI::App* command = parent->add_subcommand(name, help);
  addRecordsArgument(*command, o->url);
  command->callback([o, action] { action(*o); });
  return command;
}

void addTraineeOptions(CLI::App* command, RecordsOptions& o) {
  command->add_option("--group", o.group, "In the educator's words: novice, experienced, ...");
  command->add_option("--experience", o.experience, "\"3rd year\", \"50 lines\", ...");
  command->add_option("--handedness", o.handedness, "right (default) or left")->check(CLI::IsMember({"right", "left"}));
  command->add_option("--keep-until", o.retain_until, "Date after which the records are to be deleted")->type_name("YYYY-MM-DD")->check([](const std::string& d) {
    const bool date = d.size() == 10 && d[4] == '-' && d[7] == '-' && d.find_first_not_of("0123456789-") == std::string::npos;
    return date ? std::string() : std::string("a date is written 2027-03-01");
  });
  command->add_flag("--consent", o.consent, "The trainee has agreed to training records, today");
  command->add_flag("--research", o.research, "The trainee has agreed to use in studies, today");
}

CLI::Option* addId(CLI::App* command, RecordsOptions& o) { return command->add_option("--id", o.trainee.id, "The trainee's pseudonym")->required()->type_name("ID"); }

}  // namespace

void addRecords(CLI::App& program) {
  CLI::App* command = program.add_subcommand("records", "Trainees and their trials: one store for all sessions");
  command->require_subcommand(1);
  command->footer("Examples:\n  palpa records trainee add --id T001 --group novice --consent\n  palpa paracentesis --trainee T001\n  palpa records add out/paracentesis-20260301-120000\n"
                  "  palpa records trainee list\n  palpa records delete --id T001 --yes");
  const auto o = std::make_shared<RecordsOptions>();
  CLI::App* trainee = command->add_subcommand("trainee", "Who trains, by pseudonym");
  trainee->require_subcommand(1);
  CLI::App* add = sub(trainee, o, "add", "Add a trainee", [](const RecordsOptions& r) { addTrainee(r); });
  CLI::App* change = sub(trainee, o, "change", "Change what is given; note a consent", changeTrainee);
  for (CLI::App* one : {add, change}) {
    addId(one, *o);
    addTraineeOptions(one, *o);
  }
  sub(trainee, o, "list", "Who is in the records", listTrainees);
  sub(command, o, "add", "Bring finished sessions into the records; as often as you like", addSessions)->add_option("sessions", o->sessions, "session.palpa, or a session's folder")->required()->type_name("FILE...");
  CLI::App* waiting = command->add_subcommand("deliver", "Send what could not be sent before");
  waiting->callback([o] { deliverPending(*o); });
  CLI::App* remove = sub(command, o, "delete", "Delete a person: records and evidence, for good", deletePerson);
  addId(remove, *o);
  remove->add_flag("--yes", o->yes, "Yes, for good");
  CLI::App* table = command->add_subcommand("metrics", "What every figure of a trial is: definition, unit, direction");
  table->add_option("--out", o->out, "Markdown file; default: standard output")->type_name("FILE");
  table->callback([o] { writeMetrics(*o); });
}

}  // namespace palpa::cli

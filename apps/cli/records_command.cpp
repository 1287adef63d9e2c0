#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <map>
#include <memory>
#include <sstream>

#include "anatomy/base/counted.h"
#include "anatomy/base/error.h"
#include "anatomy/base/utc.h"
#include "anatomy/base/whole_file.h"
#include "apps/assess/metrics/metric_table.h"
#include "apps/cli/arguments.h"
#include "apps/cli/commands.h"
#include "apps/cli/records_actions.h"
#include "apps/cli/values.h"
#include "apps/evidence/evidence_records.h"
#include "apps/record/store/delivery.h"
#include "apps/runtime/clock.h"
#include "apps/session/output_folder.h"

namespace palpa::cli {
namespace {

namespace fs = std::filesystem;

void print(const record::Trainee& t, std::size_t sessions) {
  std::printf(
      "%-16s %-14s %-20s %-6s consent %-10s research %-10s keep until %-10s %zu session%s\n",
      t.id.c_str(), t.group.c_str(), t.experience.c_str(), t.handedness.c_str(),
      t.consent_utc.empty() ? "no" : t.consent_utc.substr(0, 10).c_str(),
      t.research_utc.empty() ? "no" : t.research_utc.substr(0, 10).c_str(),
      t.retain_until.empty() ? "-" : t.retain_until.c_str(), sessions, sessions == 1 ? "" : "s");
}

void addTrainee(RecordsOptions o) {
  record::RecordStore store(o.url);
  o.trainee.group = o.group;
  o.trainee.experience = o.experience;
  o.trainee.handedness = o.handedness.empty() ? "right" : o.handedness;
  o.trainee.retain_until = o.retain_until;
  o.trainee.added_utc = runtime::utcNow();
  if (o.consent) o.trainee.consent_utc = o.trainee.added_utc;
  if (o.research) o.trainee.research_utc = o.trainee.added_utc;
  store.addTrainee(o.trainee);
  std::printf("Trainee %s added to the %s\n", o.trainee.id.c_str(), store.place().c_str());
  if (!o.consent)
    std::printf(
        "Consent to keeping training records is not noted: palpa records trainee change --id %s "
        "--consent\n",
        o.trainee.id.c_str());
}

void changeTrainee(const RecordsOptions& o) {
  record::RecordStore store(o.url);
  record::Trainee t = traineeIn(store, o.trainee.id);
  if (!o.group.empty()) t.group = o.group;
  if (!o.experience.empty()) t.experience = o.experience;
  if (!o.handedness.empty()) t.handedness = o.handedness;
  if (!o.retain_until.empty()) t.retain_until = o.retain_until;
  if (o.consent) t.consent_utc = runtime::utcNow();
  if (o.research) t.research_utc = runtime::utcNow();
  store.changeTrainee(t);
  print(t, store.sessions(t.id).size());
}

void listTrainees(const RecordsOptions& o) {
  record::RecordStore store(o.url);
  const std::vector<record::Trainee> all = store.trainees();
  std::printf("%s in the %s\n", counted(all.size(), "trainee").c_str(), store.place().c_str());
  std::map<std::string, std::size_t> sessions;
  for (const record::Tally& tally : store.tallies())
    sessions[tally.trainee] = static_cast<std::size_t>(tally.sessions);
  for (const record::Trainee& t : all) print(t, sessions[t.id]);
}

void bring(const fs::path& file, const std::string& url) {
  try {
    const evidence::EvidenceDelivery done = evidence::deliverEvidence(file, url);
    std::printf("%s: trainee %s, %s added, %d there already%s\n", file.string().c_str(),
                done.trainee.c_str(), counted(done.trials.added, "trial").c_str(),
                done.trials.present, done.unfinished ? ", one unfinished left out" : "");
  } catch (const record::StoreUnreachable&) {
    std::printf("%s: noted; palpa records deliver sends it\n", file.string().c_str());
    throw;
  }
}

void addSessions(const RecordsOptions& o) {
  for (const std::string& session : o.sessions)
    bring(fs::is_directory(session) ? fs::path(session) / "session.palpa" : fs::path(session),
          o.url);
}

/// One that fails does not keep the others back.
void deliverPending(const RecordsOptions& o) {
  record::PendingList pending(record::PendingList::usualFolder());
  auto waiting = pending.sessions();
  if (!o.forget.empty()) {
    if (std::erase_if(waiting,
                      [&](const record::PendingSession& s) { return s.uuid == o.forget; }) == 0)
      throw UsageError("is not among the sessions that wait", "session " + o.forget,
                       "palpa records deliver names them");
    pending.forget(o.forget);
    std::printf("Forgotten: session %s; its evidence stays where it is\n", o.forget.c_str());
  }
  if (waiting.empty()) std::printf("Nothing waits to be delivered\n");
  std::size_t failed = 0;
  for (const record::PendingSession& session : waiting) try {
      if (pending.isHeld(session.uuid)) {
        std::printf("Session %s is still going on\n", session.uuid.c_str());
        continue;
      }
      bring(session.evidence, session.url);
      pending.forget(session.uuid);
    } catch (const Error& e) {
      std::printf("Session %s waits on: %s\n", session.uuid.c_str(), e.what());
      ++failed;
    }
  if (failed > 0)
    throw Error("could not be delivered: see above", counted(failed, "session"),
                "Try again later; one that never can be: palpa records deliver --forget UUID");
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
CLI::App* sub(CLI::App* parent, const std::shared_ptr<RecordsOptions>& o, const char* name,
              const char* help, void (*action)(const RecordsOptions&)) {
  CLI::App* command = parent->add_subcommand(name, help);
  addRecordsArgument(*command, o->url);
  command->callback([o, action] { action(*o); });
  return command;
}

std::string whyNoDate(const std::string& written) {
  const auto date = dateIn(written);
  const bool good = date && date->year() >= std::chrono::year(2000) && isoDate(*date) == written;
  return good ? "" : "a date is written 2027-03-01";
}

void addTraineeOptions(CLI::App* command, RecordsOptions& o) {
  command->add_option("--group", o.group, "In the educator's words: novice, experienced, ...");
  command->add_option("--experience", o.experience, "\"3rd year\", \"50 lines\", ...");
  command->add_option("--handedness", o.handedness, "right (default) or left")
      ->check(oneOf({"right", "left"}));
  command
      ->add_option("--keep-until", o.retain_until, "Date after which the records are to be deleted")
      ->type_name("YYYY-MM-DD")
      ->check(whyNoDate);
  command->add_flag("--consent", o.consent, "The trainee has agreed to training records, today");
  command->add_flag("--research", o.research, "The trainee has agreed to use in studies, today");
}

CLI::Option* addId(CLI::App* command, RecordsOptions& o) {
  return command->add_option("--id", o.trainee.id, "The trainee's pseudonym")
      ->required()
      ->type_name("ID");
}

void addWho(CLI::App* command, RecordsOptions& o) {
  command->add_option("--id", o.trainee.id, "One trainee's pseudonym")->type_name("ID");
  command->add_flag("--all", o.all, "Everybody in the records");
}

void addTrainees(CLI::App* command, const std::shared_ptr<RecordsOptions>& o) {
  CLI::App* trainee = command->add_subcommand("trainee", "Who trains, by pseudonym");
  trainee->require_subcommand(1);
  CLI::App* add =
      sub(trainee, o, "add", "Add a trainee", [](const RecordsOptions& r) { addTrainee(r); });
  CLI::App* change = sub(trainee, o, "change", "Change the fields that are given; record a consent",
                         changeTrainee);
  for (CLI::App* one : {add, change}) {
    addId(one, *o);
    addTraineeOptions(one, *o);
  }
  sub(trainee, o, "list", "Who is in the records", listTrainees);
  addId(sub(command, o, "show", "Sessions and trials of a person, in plain words", showTrainee),
        *o);
  CLI::App* overdue =
      sub(command, o, "overdue", "Whose records were to be kept until a date that has passed",
          listOverdue);
  overdue->add_option("--date", o->date, "Instead of today")
      ->type_name("YYYY-MM-DD")
      ->check(whyNoDate);
  overdue->add_flag("--delete", o->remove, "Delete them, with their evidence");
  CLI::App* remove =
      sub(command, o, "delete",
          "Delete a person: records, evidence, reports, and what the console keeps, for good",
          deletePerson);
  remove->add_option("--id", o->trainee.id, "The trainee's pseudonym")->type_name("ID");
  remove->add_flag("--left", o->left,
                   "Delete what earlier deletions had to leave, where it is on this computer");
  remove
      ->add_option("--forget", o->forget,
                   "A session whose evidence is gone for good: it is not named any more")
      ->type_name("UUID");
  for (CLI::App* one : {overdue, remove}) {
    one->add_flag("--yes", o->yes, "Yes, for good");
    one->add_option("--home", o->home,
                    "Where the console keeps its sessions (default ~/.local/share/palpa/console)")
        ->type_name("DIR");
  }
}

void addStore(CLI::App* command, const std::shared_ptr<RecordsOptions>& o) {
  sub(command, o, "add", "Add finished sessions to the records; adding one again does no harm",
      addSessions)
      ->add_option("sessions", o->sessions, "session.palpa, or a session's folder")
      ->required()
      ->type_name("FILE...");
  CLI::App* waiting = command->add_subcommand("deliver", "Send what could not be sent before");
  waiting->add_option("--forget", o->forget, "A session that is not to be sent any more")
      ->type_name("UUID");
  waiting->callback([o] { deliverPending(*o); });
  sub(command, o, "backup", "Everything into one file", backUpRecords)
      ->add_option("--out", o->out, "File to write")
      ->required()
      ->type_name("FILE");
  sub(command, o, "restore",
      "Restore a backup into empty records: a new file, or an empty database on a server",
      restoreRecords)
      ->add_option("--from", o->from, "File that palpa records backup wrote")
      ->required()
      ->type_name("FILE");
  sub(command, o, "migrate", "Update the tables to the newest version, and say from which",
      migrateRecords);
}

void addData(CLI::App* command, const std::shared_ptr<RecordsOptions>& o) {
  CLI::App* data =
      sub(command, o, "export", "Tables for other programs, with a dictionary: people by pseudonym",
          exportRecords);
  addWho(data, *o);
  data->add_option("--out", o->out, "Folder (default out/records-<time>)")->type_name("DIR");
  data->add_option("--format", o->format, "csv, json, or both (default)")
      ->check(oneOf({"csv", "json", "both"}))
      ->type_name("csv|json|both");
  data->add_flag("--research", o->research, "For a study: only people who have agreed to that");
  data->add_flag("--paths", o->paths, "Include the paths of evidence on this computer");
  CLI::App* tell = sub(command, o, "xapi",
                       "Report trials to a learning record store (xAPI); what cannot be sent now "
                       "waits and is sent next time",
                       sendRecords);
  tell->add_option("--to", o->to, "Its address, without user and password")
      ->required()
      ->type_name("URL");
  addWho(tell, *o);
  tell->add_option("--user", o->user, "The password comes from PALPA_XAPI_PASSWORD or ~/.netrc")
      ->type_name("NAME");
  tell->add_option("--home-page", o->home_page,
                   "Whose pseudonyms these are: an address of your centre")
      ->type_name("IRI");
  tell->add_flag("--simulated", o->simulated, "Report simulated sessions as well");
  tell->add_flag("--insecure", o->insecure, "Allow http to another computer");
  CLI::App* table = command->add_subcommand(
      "metrics", "What every figure of a trial means: definition, unit, direction");
  table->add_option("--out", o->out, "Markdown file; default: standard output")->type_name("FILE");
  table->callback([o] { writeMetrics(*o); });
}

/// What the help of each command below shows.
struct RecordsExample {
  const char *command, *words;
};
constexpr RecordsExample kRecordsExamples[] = {
    {"trainee", "trainee add --id T001 --group novice --consent"},
    {"trainee add", "trainee add --id T001 --group novice --handedness left --consent"},
    {"trainee change", "trainee change --id T001 --experience \"3rd year\" --research"},
    {"trainee list", "trainee list --records ~/records.sqlite"},
    {"show", "show --id T001"},
    {"overdue", "overdue\n  palpa records overdue --delete --yes"},
    {"delete", "delete --id T001 --yes"},
    {"add", "add out/subclavian-20260301-120000"},
    {"deliver", "deliver"},
    {"backup", "backup --out records-2026-03-01.sqlite"},
    {"restore", "restore --from records-2026-03-01.sqlite --records ~/new.sqlite"},
    {"migrate", "migrate --records ~/records.sqlite"},
    {"export", "export --all --out data\n  palpa records export --id T001 --format json"},
    {"xapi", "xapi --to https://lrs.example.org/xapi --all --user palpa"},
    {"metrics", "metrics --out metrics.md"},
};

void showExamples(CLI::App* records) {
  for (const RecordsExample& one : kRecordsExamples) {
    CLI::App* command = records;
    std::istringstream path(one.command);
    for (std::string word; path >> word;) command = command->get_subcommand(word);
    command->footer(std::string("Example:\n  palpa records ") + one.words);
  }
}

}  // namespace

void addRecords(CLI::App& program) {
  CLI::App* command =
      program.add_subcommand("records", "Trainees and their trials: one store for all sessions");
  command->require_subcommand(1);
  command->footer(
      "Examples:\n  export PALPA_RECORDS=~/records.sqlite\n  palpa records trainee add --id T001 "
      "--group novice --consent\n  palpa subclavian --trainee T001\n  palpa records add "
      "out/subclavian-20260301-120000\n"
      "  palpa records show --id T001\n  palpa records export --all --out data\n  palpa records "
      "backup --out records-2026-03-01.sqlite\n  palpa records delete --id T001 --yes");
  const auto o = std::make_shared<RecordsOptions>();
  addTrainees(command, o);
  addStore(command, o);
  addData(command, o);
  showExamples(command);
}

}  // namespace palpa::cli

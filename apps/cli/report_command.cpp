#include <cstdio>
#include <memory>

#include <nlohmann/json.hpp>

#include "anatomy/base/counted.h"
#include "anatomy/base/error.h"
#include "anatomy/base/json_text.h"
#include "apps/cli/arguments.h"
#include "apps/cli/commands.h"
#include "apps/cli/values.h"
#include "apps/evidence/evidence_records.h"
#include "apps/evidence/rating_forms.h"
#include "apps/evidence/recorded_session.h"
#include "apps/report/needle/session_report.h"
#include "apps/report/practice/practice_reports.h"
#include "apps/runtime/clock.h"
#include "apps/session/output_folder.h"
#include "apps/session/session_facts.h"

namespace palpa::cli {
namespace {

constexpr const char* kTrialExamples = R"(Examples:
  palpa report trial out/A/session.palpa --out trial-1.html
      what happened, the errors of technique, what the simulator can say about pass or fail
  palpa report trial out/A/session.palpa --trial 2 --beside out/expert/session.palpa --out trial-2.html
      the same with an expert's trial in the same picture
  palpa report trial out/A/session.palpa --answers rater-1.csv --standard 90 --out trial-1.html
      with a rater's checklist and global rating (palpa rate form), by the lower standard
A pass needs a trial in assessment (--assess), the checklist at its standard, a global rating, and no critical error.)";

struct TrialReportOptions {
  std::string session, beside, checklist, global, answers, records, rater, out = "trial.html";
  int trial = 1, beside_trial = 1;
  double standard = 0;
};

/// One trial of a session, scored again.
struct FoundTrial {
  assess::TrialAssessment assessment;
  std::vector<assess::TrialSample> samples;
};

std::string sessionFile(const std::string& given) {
  return std::filesystem::is_directory(given)
             ? (std::filesystem::path(given) / "session.palpa").string()
             : given;
}

FoundTrial findTrial(const evidence::RecordedSession& session, int number,
                     const std::string& file) {
  FoundTrial found;
  bool there = false;
  session.eachTrial(
      [&](const record::RecordedTrial& trial, const evidence::RecordedSession::Samples& samples) {
        if (trial.header.trial != number) return;
        if (!trial.ended)
          throw UsageError("was not finished: the program stopped in the middle",
                           file + ", trial " + std::to_string(number), "Choose another");
        there = true;
        found = {session.rescore(trial, samples), samples};
      });
  if (!there)
    throw UsageError("is not in the session, which has " + std::to_string(session.trials().size()),
                     file + ", trial " + std::to_string(number), "Choose another with --trial");
  return found;
}

competence::FormAnswers answersFor(const TrialReportOptions& o, const evidence::RatingForms& forms,
                                   const std::string& uuid) {
  if (!o.answers.empty())
    return competence::parseAnswers(evidence::textOf(o.answers), o.answers, forms.checklist,
                                    &forms.global);
  if (o.rater.empty()) return {};
  const std::string records = o.records.empty() ? usualRecords() : o.records;
  requireRecords(records);
  record::RecordStore store(records);
  competence::FormAnswers answers =
      evidence::answersIn(record::ratingsIn(store, uuid), o.trial, o.rater, forms);
  if (answers.checklist.empty() && answers.global.empty())
    throw UsageError("has not rated this trial", "rater " + o.rater,
                     "Enter the form first: palpa rate enter");
  return answers;
}

report::BesideTrial besideOf(const TrialReportOptions& o) {
  if (o.beside.empty()) return {};
  const std::string file = sessionFile(o.beside);
  const evidence::RecordedSession session(file);
  const FoundTrial other = findTrial(session, o.beside_trial, file);
  const std::string who = session.operatorName() == "custom" ? "a simulated operator"
                          : session.simulated() ? "a simulated " + session.operatorName()
                          : session.operatorName() == "expert" ? "an expert"
                                                               : "another person";
  return {session.operatorName() == "expert" ? "expert" : "beside",
          "The dash-dotted line is trial " + std::to_string(o.beside_trial) + " of " + who +
              ", from the start of that trial.",
          evidence::thinned(other.samples)};
}

void needsPath(const evidence::RecordedSession& session, const std::string& file) {
  if (session.hasGoal() || session.reader().info().expert_path_json.empty())
    throw UsageError("has no expert path: there is no technique to judge", file,
                     "Choose a session of palpa subclavian");
}

void reportTrial(const TrialReportOptions& o) {
  const evidence::RatingForms forms = evidence::readForms(o.checklist, o.global);
  const std::string file = sessionFile(o.session);
  const evidence::RecordedSession session(file);
  needsPath(session, file);
  const nlohmann::json facts = parseJson(session.reader().info().session_json);
  FoundTrial found = findTrial(session, o.trial, file);
  report::TrialPage page{found.assessment, evidence::thinned(found.samples), {}};
  page.verdict = evidence::verdictOf(page.assessment, forms,
                                     answersFor(o, forms, session.reader().info().uuid),
                                     evidence::standardOf(forms.checklist, o.standard));
  page.certification = competence::whatCannotBeCertified(1);
  page.beside = besideOf(o);
  report::SessionReport whole;
  whole.title = "Subclavian access, trial " + std::to_string(o.trial);
  whole.trainee = facts.value("trainee", "");
  whole.simulated = session.simulated();
  whole.when = session.reader().info().started_utc;
  whole.station = {{"Software", session.reader().info().software, ""},
                   {"Judged by", std::string("palpa ") + PALPA_VERSION, forms.checklist.title}};
  const std::string status = competence::statusWords(page.verdict->status),
                    reason =
                        page.verdict->reasons.empty() ? "" : ": " + page.verdict->reasons.front();
  whole.trials.push_back(std::move(page));
  report::writeReport(whole, o.out);
  std::printf("Trial %d%s: %s%s\n", o.trial, whole.simulated ? " (simulated)" : "", status.c_str(),
              reason.c_str());
  for (const assess::TechnicalError& error : found.assessment.errors)
    std::printf("  %s: %s\n", error.title.c_str(), error.sentence.c_str());
  std::printf("Written: %s\n", o.out.c_str());
}

}  // namespace

void addReportTrial(CLI::App& report) {
  CLI::App* command = report.add_subcommand(
      "trial",
      "One trial of a needle session: errors of technique, pass or fail, beside an expert's");
  command->footer(kTrialExamples);
  const auto o = std::make_shared<TrialReportOptions>();
  command->add_option("session", o->session, "session.palpa, or a session's folder")
      ->required()
      ->type_name("FILE");
  command->add_option("--trial", o->trial, "Number of the trial (default 1)")
      ->check(inRange(1, 100000));
  command->add_option("--beside", o->beside, "Session with a trial to draw beside it, an expert's")
      ->type_name("FILE");
  command->add_option("--beside-trial", o->beside_trial, "Which of its trials (default 1)")
      ->check(inRange(1, 100000));
  command
      ->add_option(
          "--standard", o->standard,
          "Share of items required, per cent: a standard of the checklist (default: its first)")
      ->check(aNumber());
  command->add_option("--checklist", o->checklist, "Checklist (default: the shipped one)")
      ->type_name("FILE");
  command->add_option("--global", o->global, "Global rating (default: the shipped one)")
      ->type_name("FILE");
  command->add_option("--answers", o->answers, "What a rater marked, typed in: item,value")
      ->type_name("FILE");
  command->add_option("--rater", o->rater, "The rater whose sheet is in the records");
  command
      ->add_option("--records", o->records,
                   "Records with the rater's sheet: a file, or postgresql://user@host/database "
                   "(default: as of palpa records)")
      ->type_name("FILE|URL");
  command->add_option("--out", o->out, "Page to write (default trial.html)")->type_name("FILE");
  command->callback([o] { reportTrial(*o); });
}

namespace {

struct ReportOptions {
  std::string url, out;
  evidence::PracticeChoice choice;
  statistics::CusumRates rates;
};

void reportTrainee(const ReportOptions& o) {
  statistics::cusumLimits(o.rates);  // refused before anything is read
  record::RecordStore store(o.url);
  const std::optional<record::Trainee> trainee = store.trainee(o.choice.trainee);
  if (!trainee)
    throw UsageError("is not in the records", "trainee " + o.choice.trainee,
                     "palpa records trainee list shows who is in them");
  const report::TraineeReport page{trainee->id,
                                   trainee->group,
                                   trainee->experience,
                                   runtime::utcNow(),
                                   std::string("palpa ") + PALPA_VERSION,
                                   o.rates,
                                   evidence::practiceIn(store, o.choice)};
  if (page.trials.empty())
    throw UsageError("has no trials" +
                         (o.choice.task.empty() ? std::string() : " of " + o.choice.task) +
                         " in the records",
                     "trainee " + trainee->id,
                     "palpa records show --id " + trainee->id +
                         " says what there is; palpa records add brings sessions in");
  session::OutputFolder output(o.out, "report-" + trainee->id);
  const std::filesystem::path file = output.path() / "trainee.html";
  report::writeTraineeReport(page, file);
  output.keep();
  std::printf("Written: %s (%s)\n", file.string().c_str(),
              counted(page.trials.size(), "trial").c_str());
}

void reportCohort(const ReportOptions& o) {
  statistics::cusumLimits(o.rates);
  record::RecordStore store(o.url);
  report::CohortReport page{o.choice.group, runtime::utcNow(),
                            std::string("palpa ") + PALPA_VERSION, o.rates,
                            evidence::practiceIn(store, o.choice)};
  const std::size_t trials = page.trials.size();
  if (trials == 0)
    throw UsageError(
        "has no trials in the records",
        o.choice.group.empty() ? "this choice" : "group " + o.choice.group,
        "palpa records trainee list shows the groups; palpa records add brings sessions in");
  session::OutputFolder output(o.out, "report-cohort");
  const std::filesystem::path file = output.path() / "cohort.html";
  report::writeCohortReport(std::move(page), file);
  output.keep();
  std::printf("Written: %s (%s)\n", file.string().c_str(), counted(trials, "trial").c_str());
}

void addPageArguments(CLI::App& command, ReportOptions& o) {
  addRecordsArgument(command, o.url);
  command.add_option("--task", o.choice.task,
                     "Only trials of this command: subclavian, palpation, search, squeeze, "
                     "friction, pulse");
  command
      .add_option("--leave-out-study", o.choice.left_out,
                  "Without the trials of this study: whoever leads it may not know conditions")
      ->type_name("ID")
      ->expected(1);
  command
      .add_option("--acceptable", o.rates.acceptable,
                  "Failure rate that is acceptable; the educator's choice, none is established "
                  "(with --unacceptable: 0.10/0.25, 0.10/0.20, 0.05/0.15, 0.05/0.10 need 13, "
                  "19, 20, 41 trials without failure)")
      ->check(aNumber());
  command.add_option("--unacceptable", o.rates.unacceptable, "Failure rate that is not")
      ->check(aNumber());
  command.add_option("--out", o.out, "Folder for the page; default: out/report-...")
      ->type_name("DIR");
}

}  // namespace

void addReport(CLI::App& program) {
  CLI::App* command =
      program.add_subcommand("report", "Pages of a trial, a trainee's or a group's practice");
  command->require_subcommand(1);
  command->footer(
      "Examples:\n  palpa report trial out/A --beside out/expert --out trial.html\n  palpa report "
      "trainee --id T017 --out out/T017\n  palpa report cohort --group novice --task subclavian "
      "--out out/novices");
  const auto o = std::make_shared<ReportOptions>();
  CLI::App* trainee = command->add_subcommand(
      "trainee", "One trainee: what got better, what recurs, competence, retention");
  trainee->add_option("--id", o->choice.trainee, "The trainee's pseudonym")
      ->required()
      ->type_name("ID");
  addPageArguments(*trainee, *o);
  trainee->footer("Example:\n  palpa report trainee --id T017 --out out/T017");
  trainee->callback([o] { reportTrainee(*o); });
  CLI::App* cohort = command->add_subcommand(
      "cohort", "A group: common errors, who needs attention, learning, reliability");
  cohort->add_option("--group", o->choice.group, "Only trainees of this group; default: all");
  addPageArguments(*cohort, *o);
  cohort->footer(
      "Example:\n  palpa report cohort --group novice --task subclavian --out out/novices");
  cohort->callback([o] { reportCohort(*o); });
  addReportTrial(*command);
}

}  // namespace palpa::cli

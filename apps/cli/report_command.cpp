#include <cstdio>
#include <memory>

#include "anatomy/geometry/error.h"
#include "apps/cli/commands.h"
#include "apps/cli/output_folder.h"
#include "apps/cli/practice_records.h"
#include "apps/cli/records_place.h"
#include "apps/cli/report_trial.h"
#include "apps/report/cohort_report.h"
#include "apps/report/trainee_report.h"

namespace palpa::cli {
namespace {

struct ReportOptions {
  std::string url, out;
  PracticeChoice choice;
  statistics::CusumRates rates;
};

void reportTrainee(const ReportOptions& o) {
  statistics::cusumLimits(o.rates);  // refused before anything is read
  record::RecordStore store(o.url);
  const std::optional<record::Trainee> trainee = store.trainee(o.choice.trainee);
  if (!trainee)
    throw UsageError("is not in the records", "trainee " + o.choice.trainee,
                     "palpa records trainee list shows who is");
  const report::TraineeReport page{trainee->id,
                                   trainee->group,
                                   trainee->experience,
                                   utcNow(),
                                   std::string("palpa ") + PALPA_VERSION,
                                   o.rates,
                                   practiceIn(store, o.choice)};
  if (page.trials.empty())
    throw UsageError("has no trials" +
                         (o.choice.task.empty() ? std::string() : " of " + o.choice.task) +
                         " in the records",
                     "trainee " + trainee->id,
                     "palpa records show --id " + trainee->id +
                         " says what there is; palpa records add brings sessions in");
  const std::filesystem::path file =
      makeOutputFolder(o.out, "report-" + trainee->id) / "trainee.html";
  report::writeTraineeReport(page, file);
  std::printf("Written: %s (%zu trial%s)\n", file.string().c_str(), page.trials.size(),
              page.trials.size() == 1 ? "" : "s");
}

void reportCohort(const ReportOptions& o) {
  statistics::cusumLimits(o.rates);
  record::RecordStore store(o.url);
  const report::CohortReport page{o.choice.group, utcNow(), std::string("palpa ") + PALPA_VERSION,
                                  o.rates, practiceIn(store, o.choice)};
  if (page.trials.empty())
    throw UsageError(
        "has no trials in the records",
        o.choice.group.empty() ? "this choice" : "group " + o.choice.group,
        "palpa records trainee list shows the groups; palpa records add brings sessions in");
  const std::filesystem::path file = makeOutputFolder(o.out, "report-cohort") / "cohort.html";
  report::writeCohortReport(page, file);
  std::printf("Written: %s (%zu trials)\n", file.string().c_str(), page.trials.size());
}

void addPageArguments(CLI::App& command, ReportOptions& o) {
  addRecordsArgument(command, o.url);
  command.add_option("--task", o.choice.task,
                     "Only trials of this command: paracentesis, palpation, search, squeeze");
  command.add_option("--acceptable", o.rates.acceptable,
                     "Failure rate that is acceptable; the educator's choice, none is established "
                     "(with --unacceptable: 0.10/0.25, 0.10/0.20, 0.05/0.15, 0.05/0.10 need 13, "
                     "19, 20, 41 trials without failure)");
  command.add_option("--unacceptable", o.rates.unacceptable, "Failure rate that is not");
  command.add_option("--out", o.out, "Folder of the page; default: out/report-...")
      ->type_name("DIR");
}

}  // namespace

void addReport(CLI::App& program) {
  CLI::App* command =
      program.add_subcommand("report", "Pages of a trial, a trainee's or a group's practice");
  command->require_subcommand(1);
  command->footer(
      "Examples:\n  palpa report trial out/A --beside out/expert --out trial.html\n  palpa report "
      "trainee --id T017 --out out/T017\n  palpa report cohort --group novice --task paracentesis "
      "--out out/novices");
  const auto o = std::make_shared<ReportOptions>();
  CLI::App* trainee = command->add_subcommand(
      "trainee", "One trainee: what got better, what recurs, competence, retention");
  trainee->add_option("--id", o->choice.trainee, "The trainee's pseudonym")
      ->required()
      ->type_name("ID");
  addPageArguments(*trainee, *o);
  trainee->callback([o] { reportTrainee(*o); });
  CLI::App* cohort = command->add_subcommand(
      "cohort", "A group: common errors, who needs attention, learning, reliability");
  cohort->add_option("--group", o->choice.group, "Only trainees of this group; default: all");
  addPageArguments(*cohort, *o);
  cohort->callback([o] { reportCohort(*o); });
  addReportTrial(*command);
}

}  // namespace palpa::cli

#include <cstdio>
#include <memory>

#include "anatomy/base/counted.h"
#include "anatomy/base/error.h"
#include "apps/cli/arguments.h"
#include "apps/cli/commands.h"
#include "apps/cli/values.h"
#include "apps/evidence/evidence_records.h"
#include "apps/report/practice/practice_reports.h"
#include "apps/runtime/clock.h"
#include "apps/session/output_folder.h"

namespace palpa::cli {
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
      ->allow_extra_args(false);  // one each time that it is given
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
  addReportCertificate(*command);
}

}  // namespace palpa::cli

#include "apps/cli/report_trial.h"

#include <cstdio>
#include <memory>
#include <nlohmann/json.hpp>

#include "anatomy/geometry/error.h"
#include "apps/cli/rating_forms.h"
#include "apps/cli/recorded_session.h"
#include "apps/cli/records_place.h"
#include "apps/cli/session_facts.h"
#include "apps/cli/trial_samples.h"
#include "apps/report/session_report.h"

namespace palpa::cli {
namespace {

constexpr const char* kTrialExamples = R"(Examples:
  palpa report trial out/A/session.palpa --out trial-1.html
      what happened, the errors of technique, what the simulator can say of pass or fail
  palpa report trial out/A/session.palpa --trial 2 --beside out/expert/session.palpa --out trial-2.html
      the same with an expert's trial in the same picture
  palpa report trial out/A/session.palpa --answers rater-1.csv --standard 90 --out trial-1.html
      with a rater's checklist and global rating (palpa rate form), by the lower standard
Pass takes a trial in assessment (--assess), the checklist at its standard, a global rating, and no critical error.)";

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

FoundTrial findTrial(const RecordedSession& session, int number, const std::string& file) {
  FoundTrial found;
  bool there = false;
  session.eachTrial(
      [&](const record::RecordedTrial& trial, const RecordedSession::Samples& samples) {
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

competence::FormAnswers answersFor(const TrialReportOptions& o, const RatingForms& forms,
                                   const std::string& uuid) {
  if (!o.answers.empty())
    return competence::parseAnswers(textOf(o.answers), o.answers, forms.checklist, &forms.global);
  if (o.rater.empty()) return {};
  const std::string records = o.records.empty() ? usualRecords() : o.records;
  requireRecords(records);
  record::RecordStore store(records);
  const competence::FormAnswers answers =
      answersIn(record::ratingsIn(store, uuid), o.trial, o.rater, forms);
  if (answers.checklist.empty() && answers.global.empty())
    throw UsageError("has rated nothing of this trial", "rater " + o.rater,
                     "Enter the form first: palpa rate enter");
  return answers;
}

report::BesideTrial besideOf(const TrialReportOptions& o) {
  if (o.beside.empty()) return {};
  const std::string file = sessionFile(o.beside);
  const RecordedSession session(file);
  const FoundTrial other = findTrial(session, o.beside_trial, file);
  const std::string who = session.simulated() ? "a simulated " + session.operatorName()
                          : session.operatorName() == "expert" ? "an expert"
                                                               : "another person";
  return {session.operatorName() == "expert" ? "expert" : "beside",
          "The dash-dotted line is trial " + std::to_string(o.beside_trial) + " of " + who +
              ", from the start of that trial.",
          thinned(other.samples)};
}

void needsPath(const RecordedSession& session, const std::string& file) {
  if (session.hasGoal() || session.reader().info().expert_path_json.empty())
    throw UsageError("has no taught path: there is no technique to judge", file,
                     "Choose a session of paracentesis");
}

void reportTrial(const TrialReportOptions& o) {
  const RatingForms forms = readForms(o.checklist, o.global);
  const std::string file = sessionFile(o.session);
  const RecordedSession session(file);
  needsPath(session, file);
  const nlohmann::json facts = nlohmann::json::parse(session.reader().info().session_json);
  FoundTrial found = findTrial(session, o.trial, file);
  report::TrialPage page{found.assessment, thinned(found.samples), {}};
  page.verdict =
      verdictOf(page.assessment, forms, answersFor(o, forms, session.reader().info().uuid),
                standardOf(forms.checklist, o.standard));
  page.certification = competence::whatCannotBeCertified(1);
  page.beside = besideOf(o);
  report::SessionReport whole;
  whole.title = "Paracentesis, trial " + std::to_string(o.trial);
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
      ->check(CLI::Range(1, 100000));
  command->add_option("--beside", o->beside, "Session with a trial to draw beside it, an expert's")
      ->type_name("FILE");
  command->add_option("--beside-trial", o->beside_trial, "Which of its trials (default 1)")
      ->check(CLI::Range(1, 100000));
  command->add_option(
      "--standard", o->standard,
      "Share of items asked for, per cent, as the checklist has them (default: its first)");
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

}  // namespace palpa::cli

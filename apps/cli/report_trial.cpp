#include <cstdio>
#include <memory>
#include <string_view>

#include <nlohmann/json.hpp>

#include "anatomy/base/error.h"
#include "anatomy/base/json_text.h"
#include "apps/cli/arguments.h"
#include "apps/cli/commands.h"
#include "apps/cli/values.h"
#include "apps/evidence/rating_forms.h"
#include "apps/evidence/recorded_session.h"
#include "apps/evidence/told_events.h"
#include "apps/report/needle/session_report.h"
#include "apps/report/paper/certificate.h"

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

/// Whoever filled the sheet in, as its first line says: "# rater: R1"; else as was asked.
std::string raterOf(const TrialReportOptions& o) {
  constexpr std::string_view kSays = "# rater: ";
  if (o.answers.empty()) return o.rater;
  const std::string sheet = evidence::textOf(o.answers);
  if (!sheet.starts_with(kSays)) return o.rater;
  std::string said = sheet.substr(kSays.size(), sheet.find_first_of("\r\n") - kSays.size());
  if (!o.rater.empty() && o.rater != said)
    throw UsageError("filled in this sheet, not " + o.rater, "rater " + said,
                     "Leave --rater out, or give another sheet");
  return said;
}

/// A trial with its verdict, and what its sheet says of the session.
struct JudgedTrial {
  evidence::RatingForms forms;
  FoundTrial found;
  competence::Verdict verdict;
  report::SessionPage session;
  std::string rater;
  std::optional<assess::NeedleViews> views = {};
};

std::unique_ptr<JudgedTrial> judge(const TrialReportOptions& o) {
  const std::string file = sessionFile(o.session);
  const evidence::RecordedSession session(file);
  needsPath(session, file);
  auto judged =
      std::make_unique<JudgedTrial>(JudgedTrial{evidence::readForms(o.checklist, o.global),
                                                findTrial(session, o.trial, file),
                                                {},
                                                evidence::whatWasNoted(session.reader()),
                                                raterOf(o)});
  const record::SessionInfo& info = session.reader().info();
  judged->verdict = evidence::verdictOf(judged->found.assessment, judged->forms,
                                        answersFor(o, judged->forms, info.uuid),
                                        evidence::standardOf(judged->forms.checklist, o.standard));
  const nlohmann::json facts = parseJson(info.session_json),
                       told = facts.value("report", nlohmann::json::object());
  report::SessionPage& page = judged->session;
  page.title = told.value("title", "Subclavian access");
  page.trainee = facts.value("trainee", "");
  page.simulated = session.simulated();
  if (page.when.empty()) page.when = info.started_utc;
  page.station = {
      {"Software", info.software, ""},
      {"Judged by", std::string("palpa ") + PALPA_VERSION, judged->forms.checklist.title},
      {"Session", info.uuid, ""}};
  if (!judged->rater.empty()) page.station.push_back({"Rater", judged->rater, ""});
  judged->views = session.views();
  std::erase_if(page.remarks, [&](const report::Remark& r) { return r.trial != o.trial; });
  return judged;
}

void reportTrial(const TrialReportOptions& o) {
  const std::unique_ptr<JudgedTrial> judged = judge(o);
  const assess::TrialAssessment& assessment = judged->found.assessment;
  report::TrialPage page{assessment, evidence::thinned(judged->found.samples), {}};
  page.verdict = judged->verdict;
  page.certification = competence::whatCannotBeCertified(1);
  page.beside = besideOf(o);
  report::SessionReport whole;
  static_cast<report::SessionPage&>(whole) = judged->session;
  whole.title += ", trial " + std::to_string(o.trial);
  whole.trials.push_back(std::move(page));
  whole.views = judged->views;
  report::writeReport(whole, o.out);
  const competence::Verdict& verdict = judged->verdict;
  std::printf("Trial %d%s: %s%s\n", o.trial, whole.simulated ? " (simulated)" : "",
              competence::statusWords(verdict.status),
              verdict.reasons.empty() ? "" : (": " + verdict.reasons.front()).c_str());
  for (const assess::TechnicalError& error : assessment.errors)
    std::printf("  %s: %s\n", error.title.c_str(), error.sentence.c_str());
  std::printf("Written: %s\n", o.out.c_str());
}

std::string percentWords(double share) { return std::to_string(std::lround(100 * share)) + " %"; }

void certify(const TrialReportOptions& o) {
  const std::unique_ptr<JudgedTrial> judged = judge(o);
  const competence::Verdict& v = judged->verdict;
  const std::string trial = "trial " + std::to_string(o.trial);
  if (v.status != competence::Status::passed)
    throw UsageError("was not passed: " + v.reasons.front(), trial,
                     "palpa report trial tells the whole verdict");
  if (judged->rater.empty())
    throw UsageError("is not named", "the rater", "Say who rated with --rater");
  const assess::TrialAssessment& a = judged->found.assessment;
  const report::SessionPage& page = judged->session;
  report::Certificate sheet;
  sheet.task = page.title;
  sheet.simulated = page.simulated || a.simulated;
  sheet.facts = {{"Trainee", page.trainee},
                 {"Held", page.when},
                 {"What", "one trial in assessment (" + trial + "), every aid off"},
                 {"On", "a simulator with a phantom patient"},
                 {"Judged by", "simulator and rater " + judged->rater}};
  sheet.judged = {std::to_string(v.score.done) + " of " +
                      std::to_string(v.score.done + v.score.not_done) +
                      " items of the checklist were done; " + percentWords(v.standard) +
                      " were asked for (" + judged->forms.checklist.title + ").",
                  v.global_mean ? "The rater's global rating was " +
                                      report::trimmed(*v.global_mean, 1) + " of 5 on average."
                                : "",
                  "None of the critical errors was made; the vein was reached in " +
                      report::fixed(1e-3 * a.values.time_ms, 0) + " s."};
  sheet.limits = {competence::whatCannotBeCertified(1),
                  "It was done on a simulator: no study of this program has shown that who passes "
                  "here does better on patients."};
  sheet.made_by = std::string("palpa ") + PALPA_VERSION + ", session " + page.station[2].value;
  report::writeCertificate(sheet, o.out);
  std::printf("Written: %s\n", o.out.c_str());
}

}  // namespace

namespace {

void addJudged(CLI::App* command, const std::shared_ptr<TrialReportOptions>& o) {
  command->add_option("session", o->session, "session.palpa, or a session's folder")
      ->required()
      ->type_name("FILE");
  command->add_option("--trial", o->trial, "Number of the trial (default 1)")
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
}

}  // namespace

void addReportTrial(CLI::App& report) {
  CLI::App* command = report.add_subcommand(
      "trial",
      "One trial of a needle session: errors of technique, pass or fail, beside an expert's");
  command->footer(kTrialExamples);
  const auto o = std::make_shared<TrialReportOptions>();
  addJudged(command, o);
  command->add_option("--beside", o->beside, "Session with a trial to draw beside it, an expert's")
      ->type_name("FILE");
  command->add_option("--beside-trial", o->beside_trial, "Which of its trials (default 1)")
      ->check(inRange(1, 100000));
  command->add_option("--out", o->out, "Page to write (default trial.html)")->type_name("FILE");
  command->callback([o] { reportTrial(*o); });
}

void addReportCertificate(CLI::App& report) {
  CLI::App* command = report.add_subcommand(
      "certificate", "A sheet to sign for a trial in assessment that was passed (PDF)");
  command->footer(
      "Example:\n  palpa report certificate out/A --answers rater-1.csv --rater R1 --out A.pdf");
  const auto o = std::make_shared<TrialReportOptions>();
  o->out = "certificate.pdf";
  addJudged(command, o);
  command->add_option("--out", o->out, "PDF to write (default certificate.pdf)")->type_name("FILE");
  command->callback([o] { certify(*o); });
}

}  // namespace palpa::cli

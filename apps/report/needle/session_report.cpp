#include "apps/report/needle/session_report.h"

#include <algorithm>
#include <string>

#include "anatomy/base/whole_file.h"
#include "apps/report/needle/trial_chart.h"
#include "apps/report/needle/trial_sections.h"
#include "apps/report/page/html.h"
#include "apps/report/page/page_parts.h"
#include "apps/report/page/subtask_table.h"
#include "apps/training/trial_words.h"

namespace palpa::report {
namespace {

bool byPath(const SessionReport& report) {
  return std::all_of(report.trials.begin(), report.trials.end(),
                     [](const auto& t) { return t.assessment.by_path; });
}

void writeLinks(Html& html, const SessionReport& report) {
  if (report.trials.size() < 2) return;
  const auto nav = html.in("nav", {{"aria-label", "Trials"}});
  for (const TrialPage& page : report.trials) {
    const std::string number = std::to_string(page.assessment.trial);
    html.element("a",
                 {{"href", "#trial-" + number},
                  {"class", std::string("dot ") + cssClass(toneOfOutcome(page.assessment))},
                  {"title", outcomeWords(page.assessment)}},
                 "Trial " + number);
  }
  html.element("a", {{"href", "#all-trials"}}, "All trials");
}

void writeHeader(Html& html, const SessionReport& report) {
  const bool simulated = isSimulated(
      report, report.trials, [](const TrialPage& page) { return page.assessment.simulated; });
  writeSessionHeader(html, report, report.trials.size(), simulated,
                     [&] { writeLinks(html, report); });
}

void writeFooter(Html& html, const SessionReport& report) {
  const auto footer = html.in("footer");
  writeMadeBy(html, {&report.station, &report.notes, &report.registration});
}

void writeTrials(Html& html, const SessionReport& report) {
  eachPage(
      report.trials, report.courses, [](const TrialPage& page) { return page.assessment.trial; },
      [&](const TrialPage& page) {
        writeTrialSection(html, page, report.views ? &*report.views : nullptr);
        html.passOn();
      });
}

void writePage(Html& html, const SessionReport& report) {
  html.raw("<!doctype html>\n");
  {
    const auto root = html.in("html", {{"lang", "en"}});
    writeHeadElement(html, report.title, report.trainee,
                     std::string(subtaskTableStyle()) + std::string(competenceStyle()) +
                         std::string(report.views ? trackStyle() : ""));
    const auto body = html.in("body");
    writeHeader(html, report);
    {
      const auto main = html.in("main");
      writeTrials(html, report);
      writeOverview(html, report.trials);
      if (report.parts.augmented) writeSubtaskSection(html, report.parts);
      writeSessionEnd(
          html, report,
          [&] {
            if (!report.parts.augmented) writeSubtaskSection(html, report.parts);
            writeFacts(html, "Registration", report.registration);
          },
          byPath(report) ? [&] { writeGlossary(html); } : std::function<void()>());
    }
    writeFooter(html, report);
  }
  html.passOn();
}

}  // namespace

void writeReport(const SessionReport& report, const std::filesystem::path& file) {
  WholeFile whole(file);
  Html html(whole);
  writePage(html, report);
  whole.finish();
}

void writeTrialSection(Html& html, const TrialPage& page, const assess::NeedleViews* views) {
  const assess::TrialAssessment& trial = page.assessment;
  const std::string id = "trial-" + std::to_string(trial.trial);
  const auto section = html.in("section", {{"class", "card trial"}, {"id", id}});
  {
    const auto heading = html.in("h2");
    html.text("Trial " + std::to_string(trial.trial));
    if (const std::string& role = training::nameOf(trial.role); !role.empty())
      html.element("span", {{"class", "role"}}, role);
  }
  writeVerdict(html, trial);
  if (views && !page.samples.empty()) writeTrack(html, *views, page.samples);
  writeCompetence(html, page);
  if (trial.by_path) {
    html.element("h3", "Score");
    writeScoreTable(html, trial);
  }
  html.element("h3", "Course of the trial");
  writeTrialChart(html, page);
  if (trial.by_path) writeNearMisses(html, trial);
  writePictures(html, page.pictures);
}

namespace {

constexpr const char* kHeader =
    "USER_ID,FF,COL_LUNG,COL_RIB,COL_ART,COL_VEIN,PHASE_1,PHASE_2,ECON_MEAN,ECON_VAR,TIME,SUCCESS,"
    "TRIAL,SEED,SIMULATED,TOTAL,AUGMENTED,RULES";

/// RFC 4180: quoted only where needed, quotes doubled.
std::string field(const std::string& text) {
  if (text.find_first_of(",\"\r\n") == std::string::npos) return text;
  std::string quoted = "\"";
  for (const char c : text) quoted += c == '"' ? std::string("\"\"") : std::string(1, c);
  return quoted + '"';
}

std::string row(const std::string& user_id, const assess::TrialAssessment& trial) {
  const assess::ParacentesisValues& v = trial.values;
  std::string line = field(user_id) + (trial.force_feedback ? ",1" : ",0");
  for (const double value : {v.col_lung, v.col_rib, v.col_art, v.col_vein, v.phase_1, v.phase_2,
                             v.econ_mean, v.econ_var}) {
    line += ',' + (trial.by_path ? shortest(value) : "");
  }
  line += ',' + shortest(v.time_ms);
  line += v.success ? ",1," : ",0,";
  return line + std::to_string(trial.trial) + ',' + std::to_string(trial.seed) +
         (trial.simulated ? ",1," : ",0,") + (trial.by_path ? shortest(trial.total) : "") +
         (trial.augmented ? ",1," : ",0,") + (trial.by_path ? field(trial.rules) : "");
}

}  // namespace

void writeTrialsCsv(const std::string& user_id, const std::vector<assess::TrialAssessment>& trials,
                    const std::filesystem::path& file,
                    const std::vector<assess::SubtaskDose>& parts_of_none) {
  const std::vector<assess::SubtaskDose>& parts =
      trials.empty() ? parts_of_none : trials.front().doses;
  std::string csv = kHeader + subtaskColumns(parts) + '\n';
  for (const auto& trial : trials)
    csv += row(user_id, trial) + subtaskFields(parts, trial.doses) + '\n';
  writeWhole(file, csv);
}

}  // namespace palpa::report

#include "apps/report/trainee_report.h"

#include <algorithm>

#include "anatomy/geometry/whole_file.h"
#include "apps/report/data_table.h"
#include "apps/report/page_parts.h"
#include "apps/report/progress_style.h"
#include "apps/report/progress_words.h"
#include "apps/report/trainee_sections.h"
#include "apps/report/trainee_summary.h"

namespace palpa::report {
namespace {

bool anySimulated(const std::vector<progress::PracticeTrial>& trials) {
  return std::any_of(trials.begin(), trials.end(), [](const progress::PracticeTrial& t) { return t.simulated; });
}

std::string upperFirst(std::string text) {
  if (!text.empty() && text[0] >= 'a' && text[0] <= 'z') text[0] = static_cast<char>(text[0] - 'a' + 'A');
  return text;
}

void writeTraineeHeader(Html& html, const TraineeReport& report) {
  const auto header = html.in("header");
  html.element("h1", "Trainee " + report.trainee);
  {
    const auto who = html.in("p", {{"class", "who"}});
    for (const auto& [name, value] : {std::pair{"Group ", report.group}, std::pair{"Experience ", report.experience}, std::pair{"Trials ", std::to_string(report.trials.size())}, std::pair{"Page of ", report.made_utc.substr(0, 10)}}) {
      if (value.empty()) continue;
      const auto span = html.in("span");
      html.text(name);
      html.element("strong", value);
    }
  }
  if (anySimulated(report.trials)) writeSimulatedBanner(html);
}

/// Everything else of this kind of trial.
void writeFigureTable(Html& html, const progress::Series& series) {
  DataTable table{"All figures of all trials", {"Trial", "Session"}, {}};
  const std::vector<std::string>& shown = progress::shownFigures(series.engine);
  for (const std::string& metric : shown) table.columns.push_back(metrics::metricNamed(metric)->title + (scaleOf(metric).second.empty() ? std::string() : ", " + scaleOf(metric).second));
  for (std::size_t i = 0; i < series.trials.size(); ++i) {
    table.rows.push_back({std::to_string(i + 1), series.trials[i].started_utc.substr(0, 10)});
    for (const std::string& metric : shown) table.rows.back().push_back(fieldOf(metric, series.trials[i].metric(metric)));
  }
  writeDataTable(html, table);
}

void writeSeries(Html& html, const progress::Series& series, const statistics::CusumRates& rates) {
  const auto section = html.in("section", {{"class", "card series"}});
  {
    const auto head = html.in("h2");
    html.text(upperFirst(series.name()));
    if (series.simulated) html.element("span", {{"class", "badge"}}, "simulated");
  }
  writeTraineeSummary(html, series);
  writeLearningSection(html, series);
  writeCompetenceSection(html, series, rates);
  writeRetentionSection(html, series, rates);
  writeErrorSection(html, series);
  writeFigureTable(html, series);
}

void writeNothing(Html& html) {
  const auto section = html.in("section", {{"class", "card"}});
  html.element("p", "No trial counts yet: none was both scored and finished.");
}

void writeTraineeBody(Html& html, const TraineeReport& report) {
  const std::vector<progress::Series> all = progress::seriesOf(report.trials);
  const auto main = html.in("main");
  if (all.empty()) writeNothing(html);
  if (all.size() > 1) html.element("p", {{"class", "apart muted"}}, "Trials of different kinds are kept apart: another task, with or without force feedback, cues or guidance, simulated or not.");
  for (const progress::Series& series : all) writeSeries(html, series, report.rates);
  if (const std::string left = progress::leftOut(report.trials); !left.empty()) html.element("p", {{"class", "muted small"}}, "Left out of every figure: " + left + '.');
}

std::string traineeHtml(const TraineeReport& report) {
  Html html;
  html.raw("<!doctype html>\n");
  const auto write = [&] {
    const auto root = html.in("html", {{"lang", "en"}});
    writeHeadElement(html, "Progress", report.trainee, progressStyle());
    const auto body = html.in("body");
    writeTraineeHeader(html, report);
    writeTraineeBody(html, report);
    const auto footer = html.in("footer");
    html.element("p", {{"class", "muted small"}}, "Intervals of a trainee are over his or her trials: they say how sure these figures are, not how the next patient goes. Palpa has not been validated on people.");
    if (!report.software.empty()) html.element("p", {{"class", "muted small"}}, "Made by " + report.software + '.');
  };
  write();
  return html.str();
}

}  // namespace

void writeTraineeReport(const TraineeReport& report, const std::filesystem::path& file) { writeWhole(file, traineeHtml(report)); }

}  // namespace palpa::report

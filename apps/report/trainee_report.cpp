#include "apps/report/trainee_report.h"

#include "anatomy/geometry/whole_file.h"
#include "apps/report/data_table.h"
#include "apps/report/practice_page.h"
#include "apps/report/progress_words.h"
#include "apps/report/trainee_sections.h"
#include "apps/report/trainee_summary.h"

namespace palpa::report {
namespace {

/// Everything else of this kind of trial.
void writeFigureTable(Html& html, const progress::Series& series) {
  DataTable table{"All figures of all trials", {"Trial", "Session"}, {}};
  const std::vector<std::string>& shown = progress::shownFigures(series.engine);
  for (const std::string& metric : shown)
    table.columns.push_back(
        metrics::metricNamed(metric)->title +
        (scaleOf(metric).second.empty() ? std::string() : ", " + scaleOf(metric).second));
  for (std::size_t i = 0; i < series.trials.size(); ++i) {
    table.rows.push_back({std::to_string(i + 1), series.trials[i].started_utc.substr(0, 10)});
    for (const std::string& metric : shown)
      table.rows.back().push_back(fieldOf(metric, series.trials[i].metric(metric)));
  }
  writeDataTable(html, table);
}

}  // namespace

void writeTraineeReport(const TraineeReport& report, const std::filesystem::path& file) {
  const PracticePage page{"Progress",
                          report.trainee,
                          "Trainee " + report.trainee,
                          {{"Group", report.group},
                           {"Experience", report.experience},
                           {"Trials", std::to_string(report.trials.size())},
                           {"Page of", report.made_utc.substr(0, 10)}},
                          "Intervals of a trainee are over his or her trials: they say how sure "
                          "these figures are, not how the next patient goes.",
                          report.software};
  writeWhole(file,
             practiceHtml(page, report.trials, [&](Html& html, const progress::Series& series) {
               writeTraineeSummary(html, series);
               writeLearningSection(html, series);
               writeCompetenceSection(html, series, report.rates);
               writeRetentionSection(html, series, report.rates);
               writeErrorSection(html, series);
               writeFigureTable(html, series);
             }));
}

}  // namespace palpa::report

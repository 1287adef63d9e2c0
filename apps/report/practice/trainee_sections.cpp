#include <algorithm>
#include <optional>

#include "anatomy/base/counted.h"
#include "apps/assess/progress/competence.h"
#include "apps/assess/progress/errors.h"
#include "apps/assess/progress/learning_curve.h"
#include "apps/report/page/page_parts.h"
#include "apps/report/practice/practice_charts.h"
#include "apps/report/practice/progress_words.h"
#include "apps/training/engine.h"

namespace palpa::report {

using training::Engine;

namespace {

constexpr std::size_t kFewestPalpations =
    8;  // abdominal simulators: reliability 0.35 and -0.41 with fewer

std::string percent(double share) { return trimmed(100 * share, 1) + " %"; }

progress::Competence competenceIn(const progress::Series& series,
                                  const statistics::CusumRates& rates) {
  return progress::competenceOf(progress::failuresIn(series), rates);
}

bool locked(const progress::Series& series) {
  return series.engine == Engine::palpation && series.trials.size() < kFewestPalpations;
}

std::string ratesWords(const progress::Competence& c) {
  return "A failure rate of " + percent(c.rates.acceptable) + " is called acceptable here and " +
         percent(c.rates.unacceptable) +
         " unacceptable. These rates are the educator's choice: none is established for this "
         "procedure. ";
}

std::string competenceWords(const progress::Series& series, const progress::Competence& c) {
  const std::string done = counted(series.trials.size(), "trial");
  if (c.reached)
    return "The acceptable rate was accepted at trial " + std::to_string(*c.reached) + " (" +
           series.trials[*c.reached - 1].started_utc.substr(0, 10) +
           ") and no unacceptable one has been found since.";
  std::string words =
      c.lost ? "The unacceptable rate was found at trial " + std::to_string(*c.lost) + ". "
             : "Undecided after " + done + ". ";
  if (c.tooFew())
    words += "So few trials cannot certify anybody: with these rates it takes at least " +
             std::to_string(c.minimum) + ", all without failure. ";
  return words + "From now on at least " + std::to_string(c.still_clean) +
         " more without failure would be needed.";
}

std::vector<std::string> curvesOf(const progress::Series& series) {
  if (series.engine == Engine::needle) return {"total", "time_s"};
  if (series.engine == Engine::palpation) return {"sensitivity_pct", "coverage_deep_pct", "time_s"};
  return {"time_s"};
}

std::string lossWords(const progress::RetentionGap& gap, const std::string& metric) {
  const std::string means = figureOf(metric, gap.before) + " before (" +
                            counted(gap.before_n, "trial") + "), " + figureOf(metric, gap.after) +
                            " after (" + counted(gap.after_n, "trial") + ")";
  const std::string verdict = gap.loss > 0
                                  ? "lost " + figureOf(metric, gap.loss)
                                  : "nothing lost (" + figureOf(metric, -gap.loss) + " better)";
  return means + "; " + verdict + intervalWords(metric, gap.interval);
}

void writeGaps(Html& html, const progress::Series& series) {
  DataTable table{"", {"Pause, days", "From", "To", "Figure", "What it cost"}, {}, 3};
  for (const std::string& metric : curvesOf(series))
    for (const progress::RetentionGap& gap : progress::retentionGaps(series, metric))
      table.rows.push_back({std::to_string(gap.days), gap.before_utc.substr(0, 10),
                            gap.after_utc.substr(0, 10), metrics::metricNamed(metric)->title,
                            lossWords(gap, metric)});
  if (table.rows.empty()) {
    html.element("p",
                 "There was no pause of a week or more between sessions: nothing can be said yet "
                 "of what is kept.");
    return;
  }
  html.element("p",
               "Means of up to three trials before and after each pause of a week or more; "
               "intervals: bootstrap over these trials.");
  writeOpenTable(html, table);
}

}  // namespace

void writeLearningSection(Html& html, const progress::Series& series) {
  html.element("h3", "Learning");
  for (const std::string& metric : curvesOf(series)) writeLearningChart(html, series, metric);
  writeSuccessChart(html, series);
}

void writeCompetenceSection(Html& html, const progress::Series& series,
                            const statistics::CusumRates& rates) {
  html.element("h3", "Competence");
  if (locked(series)) {
    html.element("p", "Nobody passes or fails by fewer than eight cases; so far there are " +
                          std::to_string(series.trials.size()) + '.');
    return;
  }
  const progress::Competence c = competenceIn(series, rates);
  html.element("p", ratesWords(c) + competenceWords(series, c));
  writeCusumChart(html, series, c);
}

void writeRetentionSection(Html& html, const progress::Series& series,
                           const statistics::CusumRates& rates) {
  html.element("h3", "Retention");
  const progress::Competence c = competenceIn(series, rates);
  const auto tests = c.reached && !locked(series)
                         ? progress::retentionTests(series.trials[*c.reached - 1].started_utc)
                         : std::nullopt;
  if (tests)
    html.element("p", "Test again on " + tests->six_months + " and " + tests->twelve_months +
                          ", 6 and 12 months after the acceptable rate was accepted.");
  else
    html.element("p",
                 "Tests 6 and 12 months after competence are proposed here once it is reached.");
  writeGaps(html, series);
}

void writeErrorSection(Html& html, const progress::Series& series) {
  const std::vector<progress::ErrorCount> errors = progress::errorsIn(series);
  html.element("h3", "Errors");
  if (errors.empty()) {
    html.element("p", "None of the errors that figures can tell happened.");
    return;
  }
  DataTable table{"", {"Error", "Trials", "Last five", "What helps"}, {}, 3};
  for (const progress::ErrorCount& e : errors)
    table.rows.push_back(
        {e.kind->words, std::to_string(e.all.with) + " of " + std::to_string(e.all.of),
         std::to_string(e.lately.with) + " of " + std::to_string(e.lately.of), e.kind->practise});
  writeOpenTable(html, table);
}

}  // namespace palpa::report

#include "apps/study_analysis/comparison_table.h"

#include "apps/study_analysis/series.h"
#include "apps/study_analysis/words.h"

namespace palpa::study_analysis {
namespace {

double asNumber(std::size_t n) { return static_cast<double>(n); }

std::vector<Cell> sampleCells(const Comparison& c) {
  return {c.about,  metricTitle(c.metric), c.a_name, asNumber(c.a.n), c.a.mean, c.a.sd,
          c.b_name, asNumber(c.b.n),       c.b.mean, c.b.sd};
}

const std::vector<Column>& sampleColumns() {
  static const std::vector<Column> columns{
      {"about", "Where", 0},      {"figure", "Figure", 0},
      {"sample_a", "Of", 0},      {"n_a", "n", 0},
      {"mean_a", "Mean", 1},      {"sd_a", "SD", 1, Format::number, false},
      {"sample_b", "against", 0}, {"n_b", "n", 0},
      {"mean_b", "Mean", 1},      {"sd_b", "SD", 1, Format::number, false}};
  return columns;
}

Table startedWith(std::vector<Column> more) {
  Table table{sampleColumns(), {}};
  table.columns.insert(table.columns.end(), more.begin(), more.end());
  return table;
}

void add(Table& table, const Comparison& c, std::vector<Cell> more) {
  std::vector<Cell> row = sampleCells(c);
  row.insert(row.end(), more.begin(), more.end());
  table.rows.push_back(std::move(row));
}

}  // namespace

Table comparisonTable(const std::vector<Comparison>& all) {
  Table table = startedWith({{"difference", "Difference", 1},
                             {"low", "95 % from", 1},
                             {"high", "to", 1},
                             {"resampled_low", "Resampled from", 1, Format::number, false},
                             {"resampled_high", "to", 1, Format::number, false},
                             {"test", "Test", 0},
                             {"t", "t", 2, Format::number, false},
                             {"df", "df", 1, Format::number, false},
                             {"p", "p", 3, Format::p_value},
                             {"p_holm", "p (Holm)", 3, Format::p_value},
                             {"hedges_g", "Effect g", 2}});
  for (const Comparison& c : all)
    add(table, c,
        {c.difference, c.low, c.high, c.boot_low, c.boot_high,
         std::string(c.test == Test::paired ? "paired t" : "Welch"), c.t, c.degrees, c.p, c.p_holm,
         c.effect});
  return table;
}

Table publishedTable(const std::vector<Comparison>& all) {
  Table table = startedWith({{"difference", "Difference", 1},
                             {"t", "t", 2},
                             {"df", "df", 1},
                             {"p_one_tailed", "p, one-tailed", 4, Format::p_value}});
  for (const Comparison& c : all) add(table, c, {c.difference, c.t, c.degrees, c.p});
  return table;
}

std::vector<std::string> notesOf(const std::vector<Comparison>& all) {
  std::vector<std::string> notes;
  for (const Comparison& c : all) {
    const std::string where = c.about + ", " + metricTitle(c.metric) + ": ";
    if (!c.tested()) addOnce(notes, where + "not tested: " + c.not_tested);
    for (const std::string& concern : c.concerns) addOnce(notes, where + concern);
  }
  return notes;
}

std::vector<Column> cellColumns() {
  return {{"figure", "Figure", 0}, {"group", "Group", 0},   {"condition", "Condition", 0},
          {"n", "Subjects", 0},    {"trials", "Trials", 0}, {"mean", "Mean", 2},
          {"sd", "SD", 2},         {"low", "95 % from", 2}, {"high", "to", 2},
          {"median", "Median", 2}};
}

void addCellRows(Table& table, const std::string& metric, const std::vector<StudyRow>& rows,
                 const StudyDesign& design) {
  const std::vector<Series> series = seriesOf(rows, metric);
  for (const std::string& group : groupsOf(rows, design))
    for (const std::string& condition : conditionsOf(rows, design)) {
      const std::vector<Series> cell = within(series, group, condition);
      if (cell.empty()) continue;
      const std::vector<double> means = subjectMeans(cell);
      const statistics::Description d = statistics::describe(means);
      const PlotPoint interval = meanPoint(0, means);
      table.rows.push_back({metricTitle(metric), inWords(design, group), inWords(design, condition),
                            asNumber(d.n), asNumber(pooledTrials(cell).size()), d.mean, d.sd,
                            interval.low, interval.high, d.median});
    }
}

}  // namespace palpa::study_analysis

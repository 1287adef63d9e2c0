#include "apps/study/analysis/comparison.h"

#include <cmath>

#include <boost/math/distributions/students_t.hpp>

#include "anatomy/base/error.h"
#include "apps/assess/statistics/assumptions.h"
#include "apps/assess/statistics/bootstrap.h"
#include "apps/assess/statistics/tests_of_means.h"
#include "apps/study/analysis/exhibit.h"
#include "apps/study/analysis/series.h"

namespace palpa::study_analysis {
namespace {

using statistics::Samples;

/// The sentence of an Error without the place where it came from.
std::string reasonOf(const Error& e) {
  const std::string text = e.what();
  const std::size_t from = text.find(": ");
  return from == std::string::npos ? text : text.substr(from + 2);
}

void fill(Comparison& c, const statistics::TTest& t) {
  c.difference = t.difference;
  c.low = t.low;
  c.high = t.high;
  c.t = t.t;
  c.degrees = t.degrees;
  c.effect = t.effect;
}

std::vector<double> differencesOf(const std::vector<double>& a, const std::vector<double>& b) {
  std::vector<double> d;
  for (std::size_t i = 0; i < a.size(); ++i) d.push_back(a[i] - b[i]);
  return d;
}

/// Pairs are drawn as pairs: of their differences.
void resample(Comparison& c, const std::vector<double>& a, const std::vector<double>& b,
              std::uint64_t seed) {
  const statistics::BootstrapSettings settings{2000, 0.95, seed};
  const Samples samples = c.test == Test::paired ? Samples{differencesOf(a, b)} : Samples{a, b};
  const statistics::BootstrapInterval interval = statistics::bootstrap(
      samples,
      [](const Samples& s) {
        return statistics::meanOf(s[0]) - (s.size() > 1 ? statistics::meanOf(s[1]) : 0);
      },
      settings);
  c.boot_low = interval.low;
  c.boot_high = interval.high;
}

std::vector<std::string> concernsOf(const Comparison& c, const std::vector<double>& a,
                                    const std::vector<double>& b) {
  if (c.test == Test::welch) return statistics::concernsAbout({a, b}, {c.a_name, c.b_name});
  return statistics::concernsAbout({differencesOf(a, b)}, {c.a_name + " less " + c.b_name});
}

Comparison started(Test test, const std::vector<double>& a, const std::vector<double>& b,
                   const std::string& a_name, const std::string& b_name) {
  Comparison c;
  c.test = test;
  c.a_name = a_name;
  c.b_name = b_name;
  c.a = statistics::describe(a);
  c.b = statistics::describe(b);
  return c;
}

}  // namespace

Comparison compare(Test test, const std::vector<double>& a, const std::vector<double>& b,
                   const std::string& a_name, const std::string& b_name, std::uint64_t seed) {
  Comparison c = started(test, a, b, a_name, b_name);
  try {
    const statistics::TTest t =
        test == Test::paired ? statistics::paired(a, b) : statistics::welch(a, b);
    fill(c, t);
    c.p = t.p_two_sided;
    resample(c, a, b, seed);
    c.concerns = concernsOf(c, a, b);
  } catch (const Error& e) {
    c.not_tested = reasonOf(e);
  }
  return c;
}

Comparison compareAsPublished(const std::vector<double>& a, const std::vector<double>& b,
                              const std::string& a_name, const std::string& b_name) {
  Comparison c = started(Test::welch, a, b, a_name, b_name);
  try {
    const statistics::TTest t = statistics::welch(a, b);
    fill(c, t);
    c.p = t.p_less;
  } catch (const Error& e) {
    c.not_tested = reasonOf(e);
  }
  return c;
}

void correctTogether(const std::vector<Comparison*>& family) {
  std::vector<double> p;
  for (const Comparison* c : family)
    if (c->tested()) p.push_back(c->p);
  const std::vector<double> corrected = statistics::holm(p);
  std::size_t i = 0;
  for (Comparison* c : family)
    if (c->tested()) c->p_holm = corrected[i++];
}

PlotPoint meanPoint(double x, const std::vector<double>& values) {
  const statistics::Description d = statistics::describe(values);
  constexpr double kNone = std::numeric_limits<double>::quiet_NaN();
  if (d.n < 2) return {x, d.mean, kNone, kNone};  // of one nothing is known about the next
  const double n = static_cast<double>(d.n),
               half = d.sd / std::sqrt(n) *
                      boost::math::quantile(boost::math::students_t(n - 1), 0.975);
  return {x, d.mean, d.mean - half, d.mean + half};
}

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
  const std::vector<SubjectSeries> series = seriesOf(rows, metric);
  for (const std::string& group : groupsOf(rows, design))
    for (const std::string& condition : conditionsOf(rows, design)) {
      const std::vector<SubjectSeries> cell = within(series, group, condition);
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

#include "apps/report/page/standing.h"

#include <algorithm>
#include <cmath>
#include <string>

#include "anatomy/base/counted.h"
#include "apps/report/page/figure_words.h"
#include "apps/report/page/page_parts.h"

namespace palpa::report {
namespace {

constexpr std::size_t kMostFigures = 5;
constexpr double kWide = 1000, kLane = 11, kGap = 4,
                 kMark = 5;  // of the drawing, which is stretched

/// One figure of these trials beside what groups reached.
struct Row {
  std::string metric;
  std::vector<double> values;
  std::vector<const progress::Reach*> reaches;  ///< of each group; null: it has none
};

bool isYesOrNo(const Row& row) {
  const auto yes_or_no = [](double v) { return v == 0 || v == 1; };
  return std::all_of(row.values.begin(), row.values.end(), yes_or_no) &&
         std::all_of(row.reaches.begin(), row.reaches.end(), [&](const progress::Reach* reach) {
           return !reach || (yes_or_no(reach->low) && yes_or_no(reach->high));
         });
}

std::vector<Row> rowsOf(training::Engine engine, const std::vector<progress::JudgedTrial>& trials,
                        const std::vector<progress::Group>& groups) {
  const std::vector<progress::PracticeTrial> practice = progress::practiceOf(engine, trials);
  std::vector<Row> rows;
  for (const std::string& metric : progress::shownFigures(engine)) {
    Row row{metric, {}, {}};
    for (const progress::PracticeTrial& trial : practice)
      if (const double value = trial.metric(metric); std::isfinite(value))
        row.values.push_back(value);
    bool any = false;
    for (const progress::Group& group : groups) {
      row.reaches.push_back(group.reach(metric));
      any = any || row.reaches.back();
    }
    if (any && !row.values.empty() && !isYesOrNo(row) && rows.size() < kMostFigures)
      rows.push_back(std::move(row));
  }
  return rows;
}

/// Where a value lies on the drawing of a row.
class Scale {
 public:
  explicit Scale(const Row& row) {
    low_ = *std::min_element(row.values.begin(), row.values.end());
    high_ = *std::max_element(row.values.begin(), row.values.end());
    for (const progress::Reach* reach : row.reaches) {
      if (!reach) continue;
      low_ = std::min(low_, reach->low);
      high_ = std::max(high_, reach->high);
    }
    const double margin = high_ > low_ ? 0.04 * (high_ - low_) : 1;
    low_ -= margin;
    high_ += margin;
  }
  double operator()(double value) const { return kWide * (value - low_) / (high_ - low_); }

 private:
  double low_, high_;
};

void writeBox(Html& html, const char* looks, double x, double width, double y, double height) {
  html.empty("rect", {{"class", looks},
                      {"x", coordinate(x)},
                      {"y", coordinate(y)},
                      {"width", coordinate(std::max(width, 2.0))},
                      {"height", coordinate(height)}});
}

void writeDrawing(Html& html, const Row& row) {
  const Scale x(row);
  const double height = static_cast<double>(row.reaches.size()) * (kLane + kGap) + kGap;
  const auto svg =
      html.in("svg", {{"class", "standing"},
                      {"viewBox", "0 0 " + coordinate(kWide) + ' ' + coordinate(height)},
                      {"preserveAspectRatio", "none"},
                      {"aria-hidden", "true"}});
  writeBox(html, "lane", 0, kWide, 0, height);
  for (std::size_t i = 0; i < row.reaches.size(); ++i) {
    const progress::Reach* reach = row.reaches[i];
    if (!reach) continue;
    const double top = kGap + static_cast<double>(i) * (kLane + kGap);
    writeBox(html, i == 0 ? "group first" : "group", x(reach->low), x(reach->high) - x(reach->low),
             top, kLane);
    writeBox(html, "middle", x(reach->middle) - 1, 2, top, kLane);
  }
  for (const double value : row.values)
    writeBox(html, "here", x(value) - kMark / 2, kMark, 0, height);
}

std::string betterWords(const std::string& metric) {
  const metrics::MetricDefinition* known = metrics::metricNamed(metric);
  if (!known || known->better == metrics::Better::neither) return "";
  return known->better == metrics::Better::lower ? " (less is better)" : " (more is better)";
}

/// "1 240 points; experts 640 points to 903 points"
std::string figuresIn(const Row& row, const std::vector<progress::Group>& groups) {
  const auto [low, high] = std::minmax_element(row.values.begin(), row.values.end());
  std::string words = figureOf(row.metric, *low);
  if (row.values.size() > 1) words += " to " + figureOf(row.metric, *high);
  for (std::size_t i = 0; i < groups.size(); ++i)
    if (const progress::Reach* reach = row.reaches[i])
      words += "; " + groups[i].name + ' ' + figureOf(row.metric, reach->low) + " to " +
               figureOf(row.metric, reach->high);
  return words;
}

std::string keyOf(const progress::Group& group) {
  return group.name + (group.simulated ? " (simulated)" : "") + ": where " + group.what +
         " lie, and the middle one; " + counted(group.trials, "trial") +
         (group.people > 1 ? " of " + std::to_string(group.people) + " people" : "");
}

void writeKey(Html& html, const std::vector<progress::Group>& groups) {
  const auto list = html.in("ul", {{"class", "standing-key"}});
  const auto say = [&](const char* looks, const std::string& words) {
    const auto item = html.in("li");
    html.element("span", {{"class", std::string("swatch ") + looks}}, "");
    html.text(words);
  };
  say("here", "this session's trials");
  for (std::size_t i = 0; i < groups.size(); ++i) say(i == 0 ? "first" : "other", keyOf(groups[i]));
}

}  // namespace

void writeStanding(Html& html, training::Engine engine,
                   const std::vector<progress::JudgedTrial>& trials,
                   const std::vector<progress::Group>& groups) {
  const std::vector<Row> rows = rowsOf(engine, trials, groups);
  if (rows.empty()) return;
  const auto section = html.in("section", {{"class", "card"}});
  html.element("h2", "Beside others");
  for (const Row& row : rows) {
    const auto line = html.in("div", {{"class", "standing-row"}});
    html.element("p", titleOf(row.metric) + betterWords(row.metric));
    writeDrawing(html, row);
    html.element("p", {{"class", "muted"}}, figuresIn(row, groups));
  }
  writeKey(html, groups);
}

}  // namespace palpa::report

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <regex>
#include <set>
#include <sstream>

#include "anatomy/base/random.h"
#include "apps/report/page/html.h"
#include "apps/report/page/page_parts.h"
#include "apps/report/plot/chart_frame.h"
#include "apps/report/plot/path_data.h"
#include "apps/report/plot/svg_plot.h"

namespace palpa::report {
namespace {

/// Over many ranges: ticks lie within, are evenly spaced by 1, 2 or 5 times a power of ten, are as
/// many as fit, include zero where it is in range, and their labels differ.
TEST(NiceTicks, KeepTheirLaw) {
  for (const double width : {1e-6, 0.003, 0.07, 1.0, 2.5, 31.5, 300.0, 7777.0, 2e9}) {
    for (const double offset : {0.0, -0.37, -1.0, 0.21, 12.0}) {
      for (const int most : {2, 3, 5, 8, 13}) {
        const double from = offset * width, to = from + width;
        const Ticks ticks = niceTicks(from, to, most);
        const auto& v = ticks.values;
        ASSERT_LE(v.size(), static_cast<std::size_t>(most));
        ASSERT_GE(v.size(), 1u);
        const double slack = 1e-6 * width;
        ASSERT_GE(v.front(), from - slack);
        ASSERT_LE(v.back(), to + slack);
        if (from <= 0 && to >= 0) {
          ASSERT_EQ(std::count(v.begin(), v.end(), 0.0), 1);
        }
        std::set<std::string> labels;
        for (const double value : v) labels.insert(ticks.label(value));
        ASSERT_EQ(labels.size(), v.size()) << "range " << from << " to " << to;
        if (v.size() < 2) continue;
        const double step = v[1] - v[0];
        for (std::size_t i = 1; i < v.size(); ++i) ASSERT_NEAR(v[i] - v[i - 1], step, slack);
        const double mantissa = step / std::pow(10, std::floor(std::log10(step) + 1e-6));
        ASSERT_LT(
            std::min({std::fabs(mantissa - 1), std::fabs(mantissa - 2), std::fabs(mantissa - 5)}),
            1e-3)
            << step;
        ASSERT_LT(v.front() - from, step + slack);
        ASSERT_LT(to - v.back(), step + slack);
      }
    }
  }
}

TEST(NiceTicks, KnowsExamples) {
  const Ticks ticks = niceTicks(0, 31.5, 8);
  EXPECT_EQ(ticks.values, (std::vector<double>{0, 5, 10, 15, 20, 25, 30}));
  EXPECT_EQ(niceTicks(0, 1, 6).label(0.2), "0.2");
  EXPECT_TRUE(niceTicks(1, 1, 5).values.empty());
  EXPECT_TRUE(niceTicks(0, std::numeric_limits<double>::infinity(), 5).values.empty());
}

TEST(NiceCeiling, IsCloseAbove) {
  for (double value = 1e-4; value < 1e6; value *= 1.037) {
    const double ceiling = niceCeiling(value);
    EXPECT_GE(ceiling, value * (1 - 1e-6));
    EXPECT_LE(ceiling, 1.34 * value);  // the widest gaps of its grid: 1.5 to 2, 3 to 4
  }
  EXPECT_EQ(niceCeiling(0), 1);
}

TEST(Decimation, KeepsExtremesFirstAndLastOfEveryColumn) {
  std::vector<ChartPoint> points;
  for (int i = 0; i < 30000; ++i) {
    points.push_back({i * 0.001, std::sin(i * 0.37) * (i == 12345 ? 50 : 1)});
  }
  const Axis x{0, 30, 0, 300};
  const auto lines = decimated(points, x);
  ASSERT_EQ(lines.size(), 1u);
  const auto& line = lines[0];
  EXPECT_LE(line.size(), 4u * 301);
  EXPECT_TRUE(std::is_sorted(line.begin(), line.end(),
                             [](const ChartPoint& a, const ChartPoint& b) { return a.x < b.x; }));
  for (int column = 0; column < 300; ++column) {
    const auto extremes = [&](const std::vector<ChartPoint>& all) {
      double low = 1e9, high = -1e9;
      for (const ChartPoint& p : all) {
        if (std::floor(x.at(p.x)) != column) continue;
        low = std::min(low, p.y);
        high = std::max(high, p.y);
      }
      return std::pair(low, high);
    };
    ASSERT_EQ(extremes(line), extremes(points)) << "column " << column;
  }
  EXPECT_EQ(line.front().x, points.front().x);
  EXPECT_EQ(line.back().x, points.back().x);
}

TEST(Decimation, BreaksTheLineWhereThereIsNoNumber) {
  const double nan = std::nan("");
  const Axis x{0, 10, 0, 10};
  EXPECT_EQ(decimated({{0, 1}, {1, nan}, {2, 1}, {3, 2}}, x).size(), 2u);
  EXPECT_TRUE(decimated({{0, nan}}, x).empty());
  EXPECT_EQ(linePath({{0, 1}, {1, nan}, {2, 1}, {3, 2}}, x, {0, 2, 20, 0}), "M0 10M2 10l1-10");
  EXPECT_EQ(areaPath({{2, 1}, {3, 2}}, x, {0, 2, 20, 0}, 0), "M2 20l0-10 1-10 0 20Z");
}

std::vector<std::pair<double, double>> pointsIn(const std::string& path) {
  std::vector<std::pair<double, double>> points;
  std::istringstream in(
      std::regex_replace(std::regex_replace(path, std::regex("[Ml]"), " "), std::regex("-"), " -"));
  for (double x = 0, y = 0; in >> x >> y;)
    points.emplace_back(points.empty() ? x : points.back().first + x,
                        points.empty() ? y : points.back().second + y);
  return points;
}

double distanceFrom(double x, double y, const std::vector<std::pair<double, double>>& line) {
  double least = 1e9;
  for (std::size_t i = 1; i < line.size(); ++i) {
    const double dx = line[i].first - line[i - 1].first, dy = line[i].second - line[i - 1].second;
    const double px = x - line[i - 1].first, py = y - line[i - 1].second;
    const double t = std::clamp((px * dx + py * dy) / std::max(dx * dx + dy * dy, 1e-12), 0.0, 1.0);
    least = std::min(least, std::hypot(px - t * dx, py - t * dy));
  }
  return least;
}

/// What is left out lies on the line within a tenth of a px; nothing drifts.
TEST(PathData, IsShortAndGoesThroughEveryPoint) {
  RandomStream random(7, "path");
  std::vector<std::pair<double, double>> way{{3, 80}};
  PathData path;
  path.moveTo(3, 80);
  std::size_t plain = 5;
  for (int run = 0; run < 60; ++run) {
    const double slope = run % 3 ? 0 : 6 * random.uniform() - 3;
    for (int i = 0; i < 20; ++i) {
      way.emplace_back(way.back().first + 0.5,
                       way.back().second + slope + (run % 5 ? 0 : random.uniform() - 0.5));
      path.lineTo(way.back().first, way.back().second);
      plain += 2 + coordinate(way.back().first).size() + coordinate(way.back().second).size();
    }
  }
  const std::string d = path.str();
  EXPECT_LT(3 * d.size(), plain);
  const auto drawn = pointsIn(d);
  ASSERT_GT(drawn.size(), 60u);
  for (const auto& [x, y] : way) ASSERT_LT(distanceFrom(x, y, drawn), 0.18) << x << ' ' << y;
  EXPECT_NEAR(drawn.back().first, way.back().first, 0.051);
  EXPECT_NEAR(drawn.back().second, way.back().second, 0.051);
}

TEST(PathData, TurnsBackAndClosesAndBeginsAnew) {
  PathData path;
  for (const double y : {0.0, 4.0, 9.0, -3.0}) path.lineTo(1, y);  // back over the same column
  path.close();
  path.lineTo(5, 5);
  path.lineTo(5, 5);
  path.lineTo(5.04, 5);
  path.lineTo(4.5, 5.5);
  EXPECT_EQ(path.str(), "M1 0l0 9 0-12ZM5 5l-.5 .5");
}

TEST(Numbers, AreForPeople) {
  EXPECT_EQ(fixed(-1.25, 2), "\u22121.25");
  EXPECT_EQ(fixed(-0.001, 1), "0.0");
  EXPECT_EQ(fixed(3970.4, 1), "3970.4");
  EXPECT_EQ(fixed(-157840, 0), "\u2212157\u202f840");
  EXPECT_EQ(fixed(1234567.5, 1), "1\u202f234\u202f567.5");
  EXPECT_EQ(fixed(std::nan(""), 1), "–");
  EXPECT_EQ(trimmed(7, 2), "7");
  EXPECT_EQ(trimmed(100, 0), "100");
  EXPECT_EQ(trimmed(0.25, 3), "0.25");
  EXPECT_EQ(shortest(0.1), "0.1");
  EXPECT_EQ(coordinate(-12.04), "-12");
  EXPECT_EQ(coordinate(1e300).find('e'), std::string::npos);
}

TEST(Escaping, LeavesNoMarkupAndNoBrokenBytes) {
  EXPECT_EQ(escaped("<b a=\"1\">&'"), "&lt;b a=&quot;1&quot;&gt;&amp;&#39;");
  EXPECT_EQ(escaped("Ä–𝄞"), "Ä–𝄞");
  EXPECT_EQ(escaped(std::string("a\0\x1f\x7f\nb", 6)), "a\nb");
  const std::string lost = "\xef\xbf\xbd";
  EXPECT_EQ(escaped("\xc3"), lost);                        // cut short
  EXPECT_EQ(escaped("\xc0\xaf"), lost + lost);             // overlong slash
  EXPECT_EQ(escaped("\xed\xa0\x80"), lost + lost + lost);  // surrogate
}

}  // namespace
}  // namespace palpa::report

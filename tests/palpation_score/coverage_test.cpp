#include <gtest/gtest.h>

#include "apps/assess/palpation/coverage_map.h"
#include "apps/assess/palpation/search_pattern.h"
#include "searches.h"

namespace palpa::assess {
namespace {

const PressureLevels kLevels{0.3, 0.7, 1.2};

CoverageMap mapOf(const Search& search, double reach = 6e-3) {
  CoverageMap map({0.036, 0.036}, kLevels, reach);
  for (const PalpationSample& sample : search.samples()) map.add(sample);
  return map;
}

TEST(CoverageMap, OnePressCoversItsSurroundingsAsFirmlyAsItWas) {
  Search search;
  search.press(0.01, -0.02, 0.9);
  const CoverageMap map = mapOf(search);
  int felt = 0;
  for (int row = 0; row < map.rows(); ++row)
    for (int column = 0; column < map.columns(); ++column) {
      const bool near = (map.middle(column, row) - Vec3(0.01, -0.02, 0)).norm() <= 6e-3;
      EXPECT_EQ(map.level(column, row), near ? 2 : 0);
      felt += near;
    }
  EXPECT_NEAR(map.share(1), felt / static_cast<double>(map.rows() * map.columns()), 1e-12);
  EXPECT_EQ(map.share(3), 0);
  EXPECT_EQ(map.twice(), 0);
}

TEST(CoverageMap, StripsCoverAllAndAreFeltOnce) {
  const CoverageMap map = mapOf(inStrips(0.034, 0.0085, 1.3));
  EXPECT_EQ(map.share(3), 1);
  EXPECT_EQ(mapOf(inStrips(0.034, 0.0085, 0.6)).share(2), 0);
  EXPECT_LT(mapOf(inStrips(0.034, 0.017, 1.3)).share(1), 0.6);
}

TEST(CoverageMap, ComingBackIsFeltAnew) {
  Search search;
  search.press(0, 0, 1)
      .press(0.03, 0, 1)
      .press(0.03, 0.01, 1)
      .press(0.03, 0.02, 1)
      .press(0.03, -0.02, 1)
      .press(0, 0, 1);
  const CoverageMap map = mapOf(search);
  EXPECT_EQ(map.visits(map.columns() / 2, map.rows() / 2), 2);
  EXPECT_EQ(map.visits(map.columns() - 1, map.rows() / 2), 1);
}

TEST(Presses, SearchGoesOnAndPalpationStays) {
  Search search;
  for (const double y : {-0.03, -0.015, 0.0, 0.015, 0.03}) search.press(0, y, 1);
  for (int i = 0; i < 4; ++i) search.press(0.02 + 0.001 * i, 0.0, 1.3);
  const std::vector<Press> presses = pressesIn(search.samples(), 0.1);
  ASSERT_EQ(presses.size(), 9u);
  for (std::size_t i = 0; i < 9; ++i) EXPECT_EQ(presses[i].palpating, i >= 5) << i;
  EXPECT_NEAR(presses[7].p_P.x(), 0.022, 1e-9);
  EXPECT_NEAR(presses[7].peak, 1.3, 1e-9);
  EXPECT_NEAR(presses[1].slid, 0, 1e-12);
}

/// Every search turned and seen from the other side keeps its name, or becomes the other one that
/// it then is.
TEST(SearchPattern, IsRecognised) {
  const SearchArea area;
  const auto pattern = [&](const Search& search) {
    return patternOf(pressesIn(search.samples(), 0.1), area);
  };
  EXPECT_EQ(pattern(inStrips(0.034, 0.0085, 1)).pattern, SearchPattern::strips);
  EXPECT_GT(pattern(inStrips(0.034, 0.0085, 1)).kept, 0.9);
  const Search strips = inStrips(0.034, 0.0085, 1);
  Search rows, spiral, wild;
  for (const PalpationSample& s : strips.samples())
    if (s.f_n > 0.999) rows.press(s.p_P.y(), s.p_P.x(), 1);
  for (double turn = 0; turn < 20; turn += 0.5)
    spiral.press(0.0016 * turn * std::cos(turn), 0.0016 * turn * std::sin(turn), 1);
  for (int i = 0; i < 40; ++i)
    wild.press(0.03 * std::sin(7.3 * i * i), 0.03 * std::cos(3.1 * i * i + 1), 1);
  EXPECT_EQ(pattern(rows).pattern, SearchPattern::rows);
  EXPECT_EQ(pattern(spiral).pattern, SearchPattern::spiral);
  EXPECT_EQ(pattern(wild).pattern, SearchPattern::none);
  EXPECT_EQ(pattern(Search{}).pattern, SearchPattern::none);
}

}  // namespace
}  // namespace palpa::assess

#include "apps/assess/palpation/search_area.h"

#include <gtest/gtest.h>

#include "apps/assess/palpation/coverage_map.h"
#include "searches.h"

namespace palpa::assess {
namespace {

/// Two fields joined by a bridge, as the lobes of a thyroid are.
SearchArea butterfly() {
  SearchArea area{0.02, 0.02};
  area.outline = {{-0.02, -0.02}, {-0.01, -0.02}, {-0.01, -0.004}, {0.01, -0.004},
                  {0.01, -0.02},  {0.02, -0.02},  {0.02, 0.02},    {0.01, 0.02},
                  {0.01, 0.004},  {-0.01, 0.004}, {-0.01, 0.02},   {-0.02, 0.02}};
  return area;
}

TEST(SearchArea, KnowsHowFarInsideAPlaceIs) {
  const SearchArea box{0.03, 0.02}, area = butterfly();
  EXPECT_NEAR(insideBy(box, Vec3(0.025, 0, 0)), 0.005, 1e-12);
  EXPECT_NEAR(insideBy(box, Vec3(0, -0.025, 0)), -0.005, 1e-12);
  EXPECT_NEAR(insideBy(area, Vec3(0.015, 0.01, 0)), 0.005, 1e-12);
  EXPECT_NEAR(insideBy(area, Vec3(0, 0.001, 0)), 0.003, 1e-12) << "on the bridge";
  EXPECT_NEAR(insideBy(area, Vec3(0, 0.010, 0)), -0.006, 1e-12) << "between the fields";
}

TEST(SearchArea, TakesAPlaceToWhereItIsNearest) {
  const SearchArea area = butterfly();
  EXPECT_EQ(nearestIn(area, Vec3(0.015, 0.01, 7)), Vec3(0.015, 0.01, 7));
  EXPECT_LT((nearestIn(area, Vec3(0, 0.010, 7)) - Vec3(0, 0.004, 7)).norm(), 1e-12);
  EXPECT_LT((nearestIn(area, Vec3(0.05, 0.01, 0)) - Vec3(0.02, 0.01, 0)).norm(), 1e-12);
  EXPECT_EQ(nearestIn({0.03, 0.02}, Vec3(0.04, -0.03, 1)), Vec3(0.03, -0.02, 1));
}

TEST(CoverageMap, OnlyWhatLiesInTheOutlineCounts) {
  Search search;
  for (const double x : {-0.018, -0.013, 0.013, 0.018})
    for (double y = -0.018; y < 0.019; y += 0.004) search.press(x, y, 1);
  for (double x = -0.008; x < 0.009; x += 0.004) search.press(x, 0, 1);
  const SearchArea area = butterfly();
  CoverageMap map(area, {0.3, 0.7, 1.2}, 3e-3), box({0.02, 0.02}, {0.3, 0.7, 1.2}, 3e-3);
  for (const PalpationSample& sample : search.samples()) map.add(sample), box.add(sample);
  EXPECT_EQ(map.share(1), 1);
  EXPECT_LT(box.share(1), 0.85);
  EXPECT_FALSE(map.asked(map.columns() / 2, map.rows() - 1));
  EXPECT_TRUE(unfeltQuarters(map).empty());
}

/// On a slope of 45 degrees a fingertip tells of less than it seems from above.
TEST(CoverageMap, ReachIsTheStraightWayOnACurvedTop) {
  SearchArea area{0.02, 0.02};
  area.top.hollow = 1 / 0.02;
  area.top = onOrigin(area.top);
  Search search;
  search.press(0, 0.019, 1);
  CoverageMap steep(area, {0.3, 0.7, 1.2}, 6e-3), flat({0.02, 0.02}, {0.3, 0.7, 1.2}, 6e-3);
  for (const PalpationSample& sample : search.samples()) steep.add(sample), flat.add(sample);
  EXPECT_GT(steep.share(1), 0);
  EXPECT_LT(steep.share(1), 0.85 * flat.share(1));
  const Eigen::Vector2d longer = foreshortening(area);
  EXPECT_NEAR(longer.x(), 1, 1e-12);
  EXPECT_NEAR(longer.y(), std::sqrt(2.0), 1e-9);
}

}  // namespace
}  // namespace palpa::assess

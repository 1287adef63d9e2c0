#include "apps/task_search/valley_lines.h"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/task_search/shipped_search.h"

namespace palpa::task_search {
namespace {

TEST(ValleyLines, AreGroovesAndPitsAndNothingElse) {
  const SearchSettings task = shippedSearch();
  const haptics::SearchSurface surface =
      surfaceOf(task.spec, episodeWith(assess::SearchMode::augmented));
  const auto points = valleyPoints([&](double x, double y) { return surface.smoothHeight(x, y); },
                                   {task.spec.side});
  int pits = 0;
  std::array<std::vector<double>, 3> angles;
  for (const haptics::ValleyPoint& p : points) {
    double nearest = 1e9;
    std::size_t element = 0;
    for (int e = 0; e < 3; ++e) {
      const auto m = surface.middle(e);
      const double r = std::hypot(p.x - m[0], p.y - m[1]);
      if (r < nearest) nearest = r, element = static_cast<std::size_t>(e);
    }
    const auto m = surface.middle(static_cast<int>(element));
    const double r = std::hypot(p.x - m[0], p.y - m[1]);
    EXPECT_NEAR(p.radius, 2, 0.02);
    if (p.tx == 0 && p.ty == 0) {
      ++pits;
      EXPECT_LT(r, 0.005);
      continue;
    }
    EXPECT_NEAR(r, 30, 0.005);
    EXPECT_NEAR(std::abs(p.tx * (p.x - m[0]) + p.ty * (p.y - m[1])) / r, 0,
                0.01);  // along the groove
    angles[element].push_back(std::atan2(p.y - m[1], p.x - m[0]));
  }
  EXPECT_EQ(pits, 3);
  for (auto& a : angles) {
    std::sort(a.begin(), a.end());
    ASSERT_GT(a.size(), 300u);
    double widest = a.front() + 2 * 3.14159265358979 - a.back();
    for (std::size_t i = 1; i < a.size(); ++i) widest = std::max(widest, a[i] - a[i - 1]);
    EXPECT_LT(30 * widest, 1.5);  // U: no gap
  }
}

TEST(ValleyLines, OfAnotherSurfaceAreItsOwn) {
  const auto points =
      valleyPoints([](double x, double y) { return 0.05 * (x - 0.3 * y) * (x - 0.3 * y); }, {40});
  ASSERT_GT(points.size(), 50u);
  for (const haptics::ValleyPoint& p : points) {
    EXPECT_NEAR(p.x, 0.3 * p.y, 1e-6);
    EXPECT_NEAR(p.radius, 1 / (0.1 * (1 + 0.09)), 1e-3);
  }
  EXPECT_TRUE(valleyPoints([](double x, double y) { return -0.05 * (x * x + y * y); }, {40})
                  .empty());  // a hill
}

}  // namespace
}  // namespace palpa::task_search

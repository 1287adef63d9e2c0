#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "anatomy/base/random.h"
#include "apps/twin/feeling_hands.h"

namespace palpa::twin {
namespace {

constexpr double kThirdTurn_rad = 2 * std::numbers::pi / 3;
constexpr double kSeenHalf = 35 / (200.0 / 3);      // rad: of an element's outer rim on the circle
constexpr double kLookStep = kThirdTurn_rad / 240;  // as fine as it is looked
constexpr double kNotTaken = 1.2345;

/// The nearest way from one to the other, thirds of a turn being alike.
double apart(double a, double b) { return std::abs(std::remainder(a - b, kThirdTurn_rad)); }

double foundBy(const std::vector<double>& angles, double half = kSeenHalf) {
  return orientationBy(angles, half, kNotTaken);
}

TEST(SearchOrientation, JoltsAtTheRimsTellTheMiddle) {
  for (double orientation = 0; orientation < kThirdTurn_rad; orientation += 0.1) {
    std::vector<double> angles;
    for (int e = 0; e < 3; ++e)
      for (const double from : {-0.98, -0.8, 0.8, 0.98})
        angles.push_back(std::remainder(orientation + e * kThirdTurn_rad + from * kSeenHalf,
                                        3 * kThirdTurn_rad));
    EXPECT_LE(apart(foundBy(angles), orientation), kLookStep) << orientation;
  }
}

TEST(SearchOrientation, OneElementIsEnoughWhereverItIs) {
  for (const double angle : {-3.1, -1.7, 0.0, 0.4, 2.9, 6.0, 60.0}) {
    const double found = foundBy({angle});
    EXPECT_LE(apart(found, angle), kLookStep) << angle;
    EXPECT_GE(found, 0);
    EXPECT_LE(found, kThirdTurn_rad);
  }
}

TEST(SearchOrientation, SomeFalseJoltsDoNotMatter) {
  RandomStream random(7, "test.orientation");
  for (int n = 0; n < 50; ++n) {
    const double orientation = random.uniform(0, kThirdTurn_rad);
    std::vector<double> angles;
    for (int i = 0; i < 24; ++i)
      angles.push_back(orientation + (i % 3) * kThirdTurn_rad + (i % 2 ? 0.85 : -0.85) * kSeenHalf +
                       random.normal(0, 0.02));
    for (int i = 0; i < 5; ++i) angles.push_back(random.uniform(0, 3 * kThirdTurn_rad));
    EXPECT_LT(apart(foundBy(angles), orientation), 0.15 * kSeenHalf)
        << n;  // what is left free by jolts at 0.85 of the rim
  }
}

/// Wherever jolts lie, no direction has more of them about it than the one found; looked at as
/// finely as it looks.
TEST(SearchOrientation, NoDirectionHasMoreJoltsAboutIt) {
  RandomStream random(8, "test.directions");
  const auto about = [](const std::vector<double>& angles, double direction) {
    return std::count_if(angles.begin(), angles.end(),
                         [&](double angle) { return apart(angle, direction) <= kSeenHalf + 1e-9; });
  };
  for (int n = 0; n < 200; ++n) {
    std::vector<double> angles;
    for (int i = 0; i < 8; ++i) angles.push_back(random.uniform(0, 3 * kThirdTurn_rad));
    const double found = foundBy(angles), below = kLookStep * std::floor(found / kLookStep + 1e-9);
    const auto here = std::max(
        about(angles, below),
        about(angles, below + kLookStep));  // the middle may lie between two that are looked at
    for (int i = 0; i < 240; ++i) EXPECT_LE(about(angles, i * kLookStep), here) << n;
  }
}

TEST(SearchOrientation, WithoutJoltsItStaysWithItsStart) { EXPECT_EQ(foundBy({}), kNotTaken); }

/// As many in one place as in the one opposite, between the thirds: the one nearer the start.
TEST(SearchOrientation, ATieGoesToWhatIsNearerTheStart) {
  EXPECT_LE(apart(foundBy({0.4, 0.4 + kThirdTurn_rad / 2}, 0.3), 0.4 + kThirdTurn_rad / 2),
            kLookStep);
  EXPECT_LE(apart(foundBy({0.4, 0.4, 0.4 + kThirdTurn_rad / 2}, 0.3), 0.4), kLookStep)
      << "one more decides";
}

TEST(SearchOrientation, TheOrderOfTheJoltsDoesNotMatter) {
  std::vector<double> angles{0.1, 0.9, 2.4, 2.5, 4.4, 4.6, 5.9};
  const double found = foundBy(angles);
  std::reverse(angles.begin(), angles.end());
  EXPECT_EQ(foundBy(angles), found);
}

}  // namespace
}  // namespace palpa::twin

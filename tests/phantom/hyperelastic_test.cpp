#include "apps/twin/phantom/finite_elements.h"

#include <gtest/gtest.h>

#include <Eigen/LU>
#include <cmath>

namespace palpa::twin {
namespace {

const Eigen::Matrix3d kSome =
    (Eigen::Matrix3d() << 1.1, 0.2, -0.1, 0.05, 0.85, 0.15, -0.2, 0.1, 1.2).finished();
constexpr double kNudge = 1e-6;

Eigen::Matrix3d nudged(const Eigen::Matrix3d& F, int i, double by) {
  Eigen::Matrix3d G = F;
  G.data()[i] += by;
  return G;
}

TEST(Hyperelastic, StressAndStiffnessAreTheEnergysDerivatives) {
  constexpr double mu = 2.5;
  const ShapeChange here = changeOfShape(mu, kSome);
  const VolumeChange volume = changeOfVolume(kSome);
  for (int i = 0; i < 9; ++i) {
    const ShapeChange up = changeOfShape(mu, nudged(kSome, i, kNudge)),
                      down = changeOfShape(mu, nudged(kSome, i, -kNudge));
    EXPECT_NEAR((up.W - down.W) / (2 * kNudge), here.P[i], 1e-8);
    EXPECT_LT(((up.P - down.P) / (2 * kNudge) - here.A.col(i)).norm(), 1e-7);
    const VolumeChange more = changeOfVolume(nudged(kSome, i, kNudge)),
                       less = changeOfVolume(nudged(kSome, i, -kNudge));
    EXPECT_NEAR((more.J - less.J) / (2 * kNudge), volume.dJ[i], 1e-8);
    EXPECT_LT(((more.dJ - less.dJ) / (2 * kNudge) - volume.d2J.col(i)).norm(), 1e-7);
  }
}

/// Turning and swelling cost nothing; stretching by s while the volume stays costs mu/2 (s^2 + 2/s
/// - 3).
TEST(Hyperelastic, KnowsStretchFromTurningAndSwelling) {
  const Eigen::Matrix3d turn = (Eigen::Matrix3d() << 0, -1, 0, 1, 0, 0, 0, 0, 1).finished();
  EXPECT_NEAR(changeOfShape(3, 1.3 * turn).W, 0, 1e-12);
  EXPECT_LT(changeOfShape(3, turn).P.norm(), 1e-12);
  const double s = 1.5;
  const Eigen::Matrix3d stretch =
      Eigen::Vector3d(s, 1 / std::sqrt(s), 1 / std::sqrt(s)).asDiagonal();
  EXPECT_NEAR(changeOfShape(3, turn * stretch).W, 1.5 * (s * s + 2 / s - 3), 1e-12);
}

Brick box() {
  std::array<Eigen::Vector3d, 8> nodes;
  const double at[8][3] = {{0, 0, 0}, {2, 0, 0}, {2, 1, 0}, {0, 1, 0},
                           {0, 0, 3}, {2, 0, 3}, {2, 1, 3}, {0, 1, 3}};
  for (int a = 0; a < 8; ++a)
    nodes[static_cast<std::size_t>(a)] = 1e-3 * Eigen::Vector3d(at[a][0], at[a][1], at[a][2]);
  Brick brick = brickOf(nodes);
  for (Brick::IntegrationPoint& point : brick.points) point.shear = 2400;
  return brick;
}

Vec24 crooked() {
  Vec24 u;
  for (int i = 0; i < 24; ++i) u[i] = 1e-4 * std::sin(1.7 * i + 0.3);
  return u;
}

TEST(BrickElement, GradientAndTangentAreTheEnergysDerivatives) {
  const Brick brick = box();
  constexpr double bulk = 120e3, step = 1e-9;
  const Vec24 u = crooked();
  double E = 0, more = 0, less = 0;
  Vec24 g, g_more, g_less;
  Mat24 K;
  ASSERT_TRUE(energyOf(brick, bulk, u, &E, &g, &K));
  EXPECT_LT((K - K.transpose()).norm(), 1e-9 * K.norm());
  for (int i = 0; i < 24; ++i) {
    Vec24 up = u, down = u;
    up[i] += step;
    down[i] -= step;
    ASSERT_TRUE(energyOf(brick, bulk, up, &more, &g_more, nullptr) &&
                energyOf(brick, bulk, down, &less, &g_less, nullptr));
    EXPECT_NEAR((more - less) / (2 * step), g[i], 1e-6 * g.norm());
    EXPECT_LT(((g_more - g_less) / (2 * step) - K.col(i)).norm(), 1e-6 * K.norm());
  }
}

/// A whole box stretched evenly has the energy of its points, and its mean dilatation is its own.
TEST(BrickElement, EvenStretchIsExact) {
  const Brick brick = box();
  EXPECT_NEAR(brick.volume, 6e-9, 1e-20);
  const Eigen::Matrix3d F = Eigen::Vector3d(1.2, 0.9, 1.05).asDiagonal();
  Vec24 u;
  const double at[8][3] = {{0, 0, 0}, {2, 0, 0}, {2, 1, 0}, {0, 1, 0},
                           {0, 0, 3}, {2, 0, 3}, {2, 1, 3}, {0, 1, 3}};
  for (int a = 0; a < 8; ++a)
    u.segment<3>(3 * a) =
        (F - Eigen::Matrix3d::Identity()) * 1e-3 * Eigen::Vector3d(at[a][0], at[a][1], at[a][2]);
  double E = 0;
  Vec24 g;
  ASSERT_TRUE(energyOf(brick, 120e3, u, &E, &g, nullptr));
  const double J = F.determinant(),
               expected = 6e-9 * (changeOfShape(2400, F).W + 0.5 * 120e3 * (J - 1) * (J - 1));
  EXPECT_NEAR(E, expected, 1e-9 * expected);
}

TEST(BrickElement, TurnedInsideOutIsRefused) {
  Vec24 u = Vec24::Zero();
  for (int a = 4; a < 8; ++a) u[3 * a + 2] = -4e-3;  // the top below the bottom
  double E = 0;
  Vec24 g;
  EXPECT_FALSE(energyOf(box(), 120e3, u, &E, &g, nullptr));
}

}  // namespace
}  // namespace palpa::twin

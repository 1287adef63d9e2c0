#include "anatomy/deflection/skin_deflection.h"

#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>
#include <cmath>
#include <numbers>

#include "anatomy/base/error.h"

namespace palpa::anatomy {
namespace {

/// Clamped circular membrane of radius R under a force T spread evenly over a disc of radius a:
///   r > a: ln(R / r) / 2 pi        r < a: (ln(R / a) + (1 - r^2 / a^2) / 2) / 2 pi
double membrane(double r, double a, double R) {
  const double outside = std::log(R / std::max(r, a));
  return (outside + (r < a ? (1 - r * r / (a * a)) / 2 : 0)) / (2 * std::numbers::pi);
}

/// The same on a foundation, lambda = 1 / q: w'' + w' / r - q^2 w = -p. Inside p / q^2 + B I0(q r),
/// outside C K0(q r) + D I0(q r); value and slope meet at a, w(R) = 0; p = 1 / pi a^2.
class OnFoundation {
 public:
  OnFoundation(double a, double R, double lambda)
      : a_(a), q_(1 / lambda), p_(1 / (std::numbers::pi * a * a)) {
    // With I0 K1 + I1 K0 = 1 / x the conditions at a give C = p a / q I1(q a), B - D = -p a / q
    // K1(q a).
    C_ = p_ * a / q_ * I(1, q_ * a);
    D_ = -C_ * K(0, q_ * R) / I(0, q_ * R);
    B_ = D_ - p_ * a / q_ * K(1, q_ * a);
  }
  double at(double r) const {
    if (r < a_) return p_ / (q_ * q_) + B_ * I(0, q_ * r);
    return C_ * K(0, q_ * r) + D_ * I(0, q_ * r);
  }
  double slope(double r) const {
    if (r < a_) return B_ * q_ * I(1, q_ * r);
    return q_ * (D_ * I(1, q_ * r) - C_ * K(1, q_ * r));
  }

 private:
  static double I(int n, double x) { return std::cyl_bessel_i(n, x); }
  static double K(int n, double x) { return std::cyl_bessel_k(n, x); }
  double a_, q_, p_, B_, C_, D_;
};

SkinDeflection::Settings settings(double decay, int per_ring) {
  SkinDeflection::Settings s;
  s.decay = decay;
  s.per_ring = per_ring;
  return s;
}

/// Largest difference at the nodes from w(r), in parts of w(0).
template <class W>
double nodalError(const SkinDeflection& skin, W w) {
  const Eigen::VectorXd found = skin.solve(skin.load(Vec2::Zero()));
  double worst = 0;
  for (Eigen::Index i = 0; i < found.size(); ++i)
    worst = std::max(worst, std::abs(found[i] - w(skin.disc().nodes[i].norm())));
  return worst / w(0);
}

double membraneError(int per_ring) {
  const SkinDeflection skin(settings(0, per_ring));
  return nodalError(
      skin, [&](double r) { return membrane(r, skin.settings().contact, skin.settings().patch); });
}

double foundationError(int per_ring) {
  const SkinDeflection skin(settings(0.012, per_ring));
  const OnFoundation exact(skin.settings().contact, skin.settings().patch, 0.012);
  return nodalError(skin, [&](double r) { return exact.at(r); });
}

TEST(ClosedForm, MeetsItsOwnEquationAndRim) {
  const OnFoundation w(0.0015, 0.06, 0.012);
  EXPECT_NEAR(w.at(0.06), 0, 1e-12);
  EXPECT_NEAR(w.at(0.0015 - 1e-12), w.at(0.0015), 1e-9);
  EXPECT_NEAR(w.slope(0.0015 - 1e-12), w.slope(0.0015), 1e-6 * std::abs(w.slope(0.0015)));
  for (const double r : {0.0007, 0.004, 0.02}) {
    const double h = 1e-3 * r,
                 laplace = (w.slope(r + h) - w.slope(r - h)) / (2 * h) + w.slope(r) / r;
    const double p = r < 0.0015 ? 1 / (std::numbers::pi * 0.0015 * 0.0015) : 0;
    EXPECT_NEAR(laplace - w.at(r) / (0.012 * 0.012), -p, 1e-4 * (p + w.at(r) / (0.012 * 0.012)));
  }
}

TEST(SkinDeflection, OfAMembraneIsTheClosedForm) {
  RecordProperty("percent", std::to_string(100 * membraneError(48)));
  EXPECT_LT(membraneError(48), 0.02);
}

TEST(SkinDeflection, OnAFoundationIsTheClosedForm) {
  RecordProperty("percent", std::to_string(100 * foundationError(48)));
  EXPECT_LT(foundationError(48), 0.02);
}

TEST(SkinDeflection, ErrorFallsWithTheSquareOfTheEdge) {
  for (const auto error : {membraneError, foundationError}) {
    const double coarse = error(24), middle = error(48), fine = error(96);
    RecordProperty("order", std::to_string(std::log2(middle / fine)));
    EXPECT_NEAR(std::log2(coarse / middle), 2, 0.35);
    EXPECT_NEAR(std::log2(middle / fine), 2, 0.35);
  }
}

TEST(SkinDeflection, StiffnessIsSymmetricAndPositiveDefinite) {
  for (const double decay : {0.0, 0.012}) {
    const SkinDeflection skin(settings(decay, 24));
    const Eigen::MatrixXd K = skin.stiffness();
    EXPECT_LT((K - K.transpose()).cwiseAbs().maxCoeff(), 1e-12 * K.cwiseAbs().maxCoeff());
    EXPECT_GT(Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(K).eigenvalues()[0], 0);
  }
}

TEST(SkinDeflection, IsLinearAndReciprocal) {
  const SkinDeflection skin(settings(0.012, 24));
  const Eigen::VectorXd a = skin.load(Vec2::Zero()), b = skin.load({1, 0.3});
  const Eigen::VectorXd u = skin.solve(a), v = skin.solve(b);
  EXPECT_LT((skin.solve(2 * a - 3 * b) - 2 * u + 3 * v).norm(), 1e-12 * v.norm());
  EXPECT_NEAR(a.dot(v), b.dot(u), 1e-12 * a.dot(u));
}

TEST(SkinDeflection, HasTheDepthThatIsAskedForAndItsSign) {
  SkinDeflection skin({});
  for (const double depth : {0.003, -0.0012, 0.0}) {
    skin.update(depth, {0.4, 0});
    EXPECT_DOUBLE_EQ(skin.at(Vec2::Zero()).depth, depth);
    EXPECT_EQ(skin.at({0.061, 0}).depth, 0);
    EXPECT_NEAR(skin.at({0.0599999, 0}).depth, 0, 1e-6);
    if (depth != 0) {
      EXPECT_GT(skin.at({0.01, 0.01}).depth / depth, 0.05);
      EXPECT_LT(skin.at({0.01, 0.01}).depth / depth, 0.5);
    }
  }
}

TEST(SkinDeflection, IsRoundUnlessItLeans) {
  SkinDeflection skin({});
  const double r = 0.004;
  skin.update(0.003);
  const double even = skin.at({r, 0}).depth;
  for (int k = 0; k < 48; ++k) {
    const double turn = 2 * std::numbers::pi * k / 48;
    EXPECT_NEAR(skin.at({r * std::cos(turn), r * std::sin(turn)}).depth, even, 1e-3 * even);
  }
  skin.update(0.003, {0.8, 0});
  EXPECT_GT(skin.at({r, 0}).depth, 1.02 * even);
  EXPECT_LT(skin.at({-r, 0}).depth, 0.98 * even);
  EXPECT_NEAR(skin.at({0, r}).depth, skin.at({0, -r}).depth, 1e-3 * even);
}

TEST(SkinDeflection, SlopesAreTheClosedForms) {
  SkinDeflection skin(settings(0.012, 84));
  skin.update(0.003);
  const OnFoundation exact(skin.settings().contact, skin.settings().patch, 0.012);
  for (const double r : {0.003, 0.006, 0.012, 0.024}) {
    const Vec2 x(r * std::cos(0.7), r * std::sin(0.7)), slope = skin.at(x).slope;
    const double wanted = 0.003 * exact.slope(r) / exact.at(0);
    EXPECT_NEAR(slope.dot(x) / r, wanted, 0.03 * std::abs(wanted));
    EXPECT_NEAR(slope.x() * x.y() - slope.y() * x.x(), 0, 0.01 * r * std::abs(wanted));
  }
}

TEST(GradedDisc, IsFineAtTheContactAndHasNoHoles) {
  const GradedDisc disc = gradedDisc(0.0015, 0.06, 84);
  EXPECT_NEAR(static_cast<double>(disc.nodes.size()), 5000, 600);
  double area = 0;
  for (const auto& t : disc.triangles) {
    const Vec2 u = disc.nodes[t[1]] - disc.nodes[t[0]], v = disc.nodes[t[2]] - disc.nodes[t[0]];
    const double twice = u.x() * v.y() - u.y() * v.x();
    EXPECT_GT(twice, 0);
    area += twice / 2;
  }
  EXPECT_NEAR(area, 84 * 0.06 * 0.06 / 2 * std::sin(2 * std::numbers::pi / 84), 1e-12);
  EXPECT_LT(disc.radii[1] - disc.radii[0], 0.0003);
  EXPECT_GT(disc.radii.back() - disc.radii[disc.radii.size() - 2], 0.003);
}

TEST(GradedDisc, InterpolatesLinearFunctionsExactly) {
  const GradedDisc disc = gradedDisc(0.0015, 0.06, 24);
  const auto f = [](const Vec2& x) { return 3 + 2 * x.x() - 5 * x.y(); };
  for (int i = 0; i < 500; ++i) {
    const double r = 0.0585 * i / 500, turn = 2.39996 * i;
    const Vec2 x(r * std::cos(turn), r * std::sin(turn));
    GradedDisc::Place place;
    ASSERT_TRUE(disc.find(x, &place));
    double sum = 0;
    for (int k = 0; k < 4; ++k) {
      EXPECT_GE(place.weight[k], 0);
      sum += place.weight[k] * f(disc.nodes[place.node[k]]);
    }
    EXPECT_NEAR(sum, f(x), 1e-12);
  }
}

TEST(GradedDisc, RefusesImpossibleRadii) {
  EXPECT_THROW(gradedDisc(0.01, 0.01, 24), Error);
  EXPECT_THROW(gradedDisc(0, 0.01, 24), Error);
  EXPECT_THROW(gradedDisc(0.001, 0.01, 4), Error);
}

}  // namespace
}  // namespace palpa::anatomy

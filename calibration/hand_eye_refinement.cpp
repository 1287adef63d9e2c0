#include "calibration/hand_eye.h"

#include <algorithm>
#include <cmath>

#include "anatomy/base/error.h"
#include "anatomy/geometry/dense_solvers.h"
#include "calibration/rotation.h"

namespace palpa::calibration {
namespace {

const char kRefinement[] = "registration by a tag";
constexpr std::size_t kLeastPairs = 8;
constexpr int kUnknowns = 12;
constexpr int kOwnErrors =
    2;  // of a pose that make most of its corners' errors: the hand's tremble across the view
constexpr double kDerivativeStep = 1e-6;

struct Unknowns {
  Pose X_EM, X_DW;
  Unknowns by(const VectorX& dx) const {
    return {moved(X_EM, dx.head<6>()), moved(X_DW, dx.tail<6>())};
  }
};

VectorX residualsOf(const TagView& view, const Unknowns& x, const CameraModel& camera) {
  const Pose X_CM = view.X_CW * x.X_DW.inverse() * view.X_DE * x.X_EM;
  VectorX r(2 * view.p_M.size());
  for (std::size_t i = 0; i < view.p_M.size(); ++i)
    r.segment<2>(static_cast<Eigen::Index>(2 * i)) =
        camera.project(X_CM * view.p_M[i]) - view.pixels[i];
  return r;
}

MatrixX derivative(const TagView& view, const Unknowns& x, const CameraModel& camera) {
  MatrixX J(2 * view.p_M.size(), kUnknowns);
  for (int i = 0; i < kUnknowns; ++i) {
    const VectorX dx = kDerivativeStep * VectorX::Unit(kUnknowns, i);
    J.col(i) = (residualsOf(view, x.by(dx), camera) - residualsOf(view, x.by(-dx), camera)) /
               (2 * kDerivativeStep);
  }
  return J;
}

/// Bread and meat: the corners of one pose are one cluster; the factor makes up for the parameters
/// that its six errors were fitted with.
MatrixX clusteredCovariance(const std::vector<TagView>& views, const std::vector<bool>& good,
                            const Unknowns& x, const CameraModel& camera) {
  MatrixX bread = MatrixX::Zero(kUnknowns, kUnknowns), meat = bread;
  int clusters = 0;
  for (std::size_t i = 0; i < views.size(); ++i) {
    if (!good[i]) continue;
    const MatrixX J = derivative(views[i], x, camera);
    const VectorX g = J.transpose() * residualsOf(views[i], x, camera);
    bread += J.transpose() * J;
    meat += g * g.transpose();
    ++clusters;
  }
  const MatrixX inverse = inverseOf(bread);
  const double numbers = 6.0 * clusters;
  const MatrixX covariance =
      numbers / std::max(numbers - kUnknowns, 1.0) * inverse * meat * inverse;
  return 0.5 * (covariance + covariance.transpose());
}

Fit adjust(const std::vector<TagView>& views, const CameraModel& camera, Unknowns* x) {
  const auto size = static_cast<Eigen::Index>(2 * views.front().p_M.size());
  const auto residuals = [&](const VectorX& dx) {
    const Unknowns y = x->by(dx);
    VectorX r(size * static_cast<Eigen::Index>(views.size()));
    for (std::size_t i = 0; i < views.size(); ++i)
      r.segment(size * static_cast<Eigen::Index>(i), size) = residualsOf(views[i], y, camera);
    return r;
  };
  FitProblem problem{static_cast<int>(views.size()), static_cast<int>(size), kUnknowns, residuals,
                     [&](const VectorX& dx) { *x = x->by(dx); }};
  problem.freedom = kOwnErrors;
  return robustFit(problem, kRefinement);
}

/// Those with as many corners as most, and their poses.
struct Chosen {
  std::vector<TagView> views;
  std::vector<HandEyeSample> poses;
};

Chosen whole(const std::vector<TagView>& views, const std::vector<HandEyeSample>& poses) {
  std::size_t corners = 0;
  for (const TagView& view : views) corners = std::max(corners, view.p_M.size());
  Chosen chosen;
  for (std::size_t i = 0; i < views.size() && i < poses.size(); ++i) {
    if (views[i].p_M.size() != corners || views[i].pixels.size() != corners) continue;
    chosen.views.push_back(views[i]);
    chosen.poses.push_back(poses[i]);
  }
  if (chosen.views.size() < kLeastPairs)
    throw Error("the whole tag was seen in " + std::to_string(chosen.views.size()) + " poses only",
                kRefinement, "Hold the tool where the camera sees all of it, in ten poses or more");
  return chosen;
}

/// Mean squared distance of a pose's corners, px^2.
double squaresOf(const TagView& view, const Unknowns& x, const CameraModel& camera) {
  return residualsOf(view, x, camera).squaredNorm() / static_cast<double>(view.p_M.size());
}

void leaveOut(const Chosen& all, const std::vector<bool>& good, const CameraModel& camera,
              RefinedHandEye* result) {
  constexpr std::size_t kParts = 5;
  double start = 0, refined = 0, count = 0;
  for (std::size_t part = 0; part < kParts; ++part) {
    Chosen others;
    for (std::size_t i = 0; i < all.views.size(); ++i)
      if (i % kParts != part && good[i]) {
        others.views.push_back(all.views[i]);
        others.poses.push_back(all.poses[i]);
      }
    if (others.views.size() < kLeastPairs) return;
    const HandEye begun = calibrateHandEye(others.poses);
    const Unknowns before{begun.X_EM, begun.X_DC};
    Unknowns after = before;
    adjust(others.views, camera, &after);
    for (std::size_t i = part; i < all.views.size(); i += kParts) {
      if (!good[i]) continue;
      start += squaresOf(all.views[i], before, camera);
      refined += squaresOf(all.views[i], after, camera);
      ++count;
    }
  }
  result->left_out_start_px = std::sqrt(start / std::max(count, 1.0));
  result->left_out_px = std::sqrt(refined / std::max(count, 1.0));
}

}  // namespace

RefinedHandEye refineHandEye(const std::vector<TagView>& views,
                             const std::vector<HandEyeSample>& poses, const CameraModel& camera) {
  const Chosen all = whole(views, poses);
  const HandEye start = calibrateHandEye(all.poses);
  Unknowns x{start.X_EM, start.X_DC};
  RefinedHandEye result;
  result.fit = adjust(all.views, camera, &x);
  result.X_EM = x.X_EM;
  result.X_DW = x.X_DW;
  result.covariance = clusteredCovariance(all.views, result.fit.good, x, camera);
  double squares = 0, count = 0;
  for (std::size_t i = 0; i < all.views.size(); ++i)
    if (result.fit.good[i]) {
      squares += squaresOf(all.views[i], x, camera);
      ++count;
    }
  result.rms_px = std::sqrt(squares / count);
  leaveOut(all, result.fit.good, camera, &result);
  return result;
}

}  // namespace palpa::calibration

#include "calibration/registration.h"

#include <Eigen/LU>
#include <cmath>
#include <cstdio>

#include "anatomy/base/error.h"
#include "anatomy/geometry/dense_solvers.h"
#include "calibration/rotation.h"

namespace palpa::calibration {
namespace {

const char kLandmarks[] = "landmark registration";
constexpr double kFlat = 0.05;       // of the landmarks' spread: below it they lie on one line
constexpr double kOnePlace = 0.005;  // m: landmarks that all lie within this are one place
constexpr double kWrongScale = 0.1;

struct PointScatter {
  Vec3 mean_A, mean_B;
  Mat3 cross, of_A, of_B;  // weighted covariances
};

PointScatter spreadOf(const std::vector<TouchedLandmark>& landmarks) {
  PointScatter s{Vec3::Zero(), Vec3::Zero(), Mat3::Zero(), Mat3::Zero(), Mat3::Zero()};
  double weights = 0;
  for (const TouchedLandmark& l : landmarks) {
    const double w = 1 / (l.sd * l.sd);
    s.mean_A += w * l.p_A;
    s.mean_B += w * l.p_B;
    weights += w;
  }
  s.mean_A /= weights;
  s.mean_B /= weights;
  for (const TouchedLandmark& l : landmarks) {
    const double w = 1 / (l.sd * l.sd) / weights;
    const Vec3 a = l.p_A - s.mean_A, b = l.p_B - s.mean_B;
    s.cross += w * b * a.transpose();
    s.of_A += w * a * a.transpose();
    s.of_B += w * b * b.transpose();
  }
  return s;
}

void requireSpread(const PointScatter& s) {
  const Vec3 sizes = symmetricEigen(s.of_A).values.cwiseMax(0).cwiseSqrt();
  if (sizes[2] < kOnePlace)
    throw Error("the landmarks lie within " +
                    std::to_string(static_cast<int>(std::ceil(1e3 * sizes[2]))) + " mm",
                kLandmarks, "Choose landmarks all over the phantom; lengths are metres");
  if (sizes[1] < kFlat * sizes[2])
    throw Error("the landmarks lie on one line: nothing tells how the phantom is turned about it",
                kLandmarks, "Touch one beside that line");
  if (sizes[0] < kFlat * sizes[2])
    throw Error(
        "the landmarks lie in one plane: a mirrored list or a swapped axis would fit as well, with "
        "the anatomy upside down",
        kLandmarks, "Touch one well above or below that plane");
}

// Sizes may differ by a unit; a mirrored set fits only mirrored.
void requireLikeness(const PointScatter& s, double scale) {
  if (std::abs(scale - 1) > kWrongScale) {
    char words[160];
    std::snprintf(words, sizeof words,
                  "the touched landmarks are %.3g times as far apart as the known ones", scale);
    throw Error(words, kLandmarks,
                "One of the lists is in another unit, or landmarks are mixed up");
  }
  const Vec3 sizes = symmetricEigen(s.of_A).values.cwiseMax(0).cwiseSqrt();
  const bool solid = sizes[0] > 0.2 * sizes[2];
  if (solid && s.cross.determinant() < 0)
    throw Error("the touched landmarks are the mirror image of the known ones", kLandmarks,
                "See to left and right, and to the order of the axes");
}

}  // namespace

Mat3 LandmarkRegistration::covarianceAt(const Vec3& p_A) const {
  return pointCovariance(X_BA, covariance, p_A);
}

double LandmarkRegistration::tre(const Vec3& p_A) const {
  return std::sqrt(covarianceAt(p_A).trace());
}

LandmarkRegistration registerLandmarks(const std::vector<TouchedLandmark>& landmarks,
                                       double largest_fre, double most_outliers) {
  if (landmarks.size() < 4)
    throw Error(std::to_string(landmarks.size()) + " landmarks are too few", kLandmarks,
                "Touch four at least, better eight, not all in one plane");
  for (const TouchedLandmark& l : landmarks)
    if (!l.p_A.allFinite() || !l.p_B.allFinite() || !(l.sd > 0))
      throw Error("a landmark is not a number", kLandmarks, "Touch it again");
  const PointScatter spread = spreadOf(landmarks);
  requireSpread(spread);

  // Turned and shifted about the landmarks' middle, so that both are nearly independent.
  const Vec3 middle_A = spread.mean_A;
  Mat3 R = nearestRotation(spread.cross);
  Vec3 middle_B = spread.mean_B;
  const auto residuals = [&](const VectorX& dx) {
    const Mat3 turned = R * rotationOf(dx.head<3>());
    const Vec3 at = middle_B + dx.tail<3>();
    VectorX r(3 * landmarks.size());
    for (std::size_t i = 0; i < landmarks.size(); ++i)
      r.segment<3>(static_cast<Eigen::Index>(3 * i)) =
          (turned * (landmarks[i].p_A - middle_A) + at - landmarks[i].p_B) / landmarks[i].sd;
    return r;
  };
  const auto move = [&](const VectorX& dx) {
    R = R * rotationOf(dx.head<3>());
    middle_B += dx.tail<3>();
  };
  LandmarkRegistration result;
  result.scale = std::sqrt(spread.of_B.trace() / spread.of_A.trace());
  result.fit = robustFit({static_cast<int>(landmarks.size()), 3, 6, residuals, move}, kLandmarks,
                         most_outliers);
  R = nearestRotation(R);
  result.X_BA = makePose(R, middle_B - R * middle_A);
  // (turn, shift of the middle) -> (turn, shift of A's origin): shift = shift of the middle + R
  // [middle]x turn.
  Eigen::Matrix<double, 6, 6> J = Eigen::Matrix<double, 6, 6>::Identity();
  J.bottomLeftCorner<3, 3>() = R * crossMatrix(middle_A);
  result.covariance = J * result.fit.covariance * J.transpose();
  double squares = 0;
  int good = 0;
  std::vector<TouchedLandmark> kept;
  for (std::size_t i = 0; i < landmarks.size(); ++i) {
    if (!result.fit.good[i]) continue;
    squares += (result.X_BA * landmarks[i].p_A - landmarks[i].p_B).squaredNorm();
    kept.push_back(landmarks[i]);
    ++good;
  }
  result.fre = std::sqrt(squares / good);
  const PointScatter of_kept = spreadOf(kept);
  result.scale = std::sqrt(of_kept.of_B.trace() / of_kept.of_A.trace());
  requireLikeness(of_kept, result.scale);
  if (result.fre > largest_fre) {
    char words[120];
    std::snprintf(words, sizeof words, "the landmarks fit to %.1f mm rms only", 1e3 * result.fre);
    throw Error(words, kLandmarks,
                "See that they were touched in the order of the list, and touch them again");
  }
  return result;
}

}  // namespace palpa::calibration

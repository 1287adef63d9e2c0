#include "calibration/hand_eye.h"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <numbers>
#include <random>

#include "anatomy/base/error.h"
#include "anatomy/base/quantile.h"
#include "anatomy/geometry/dense_solvers.h"
#include "calibration/rotation.h"

namespace palpa::calibration {
namespace {

const char kHandEye[] = "hand-eye calibration";
constexpr double kLeastSpread = 3 * kDegree;
constexpr double kWorstTurn = 5 * kDegree,
                 kWorstShift = 0.03;  // rms at which samples do not belong together
constexpr std::size_t kLeastSamples = 8, kSubset = 8;
constexpr int kSubsets = 30;

struct Both {
  Pose X, Z;
};

/// Shifts of X and Z for given rotations: R_A t_X - t_Z = R_Z t_B - t_A.
void solveShifts(const std::vector<HandEyeSample>& samples, Both* both) {
  Eigen::Matrix<double, 6, 6> A = Eigen::Matrix<double, 6, 6>::Zero();
  Eigen::Matrix<double, 6, 1> b = Eigen::Matrix<double, 6, 1>::Zero();
  for (const HandEyeSample& s : samples) {
    Eigen::Matrix<double, 3, 6> rows;
    rows << s.X_DE.linear(), -Mat3::Identity();
    A += rows.transpose() * rows;
    b += rows.transpose() * (both->Z.linear() * s.X_CM.translation() - s.X_DE.translation());
  }
  const Eigen::Matrix<double, 6, 1> t = minimumNorm(A, b);
  both->X.translation() = t.head<3>();
  both->Z.translation() = t.tail<3>();
}

/// Shah 2013: (R_B (x) R_A) vec R_X = vec R_Z, so these are the right and left singular vectors of
/// the sum's largest singular value.
Both byKroneckerProduct(const std::vector<HandEyeSample>& samples) {
  using Mat9 = Eigen::Matrix<double, 9, 9>;
  Mat9 K = Mat9::Zero();
  for (const HandEyeSample& s : samples) {
    const Mat3 A = s.X_DE.linear(), B = s.X_CM.linear();
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < 3; ++j) K.block<3, 3>(3 * i, 3 * j) += B(i, j) * A;
  }
  const SingularValues<9> singular = singularValues(K);
  const auto rotation = [](const Mat3& m) {
    return nearestRotation(m.determinant() < 0 ? Mat3(-m) : m);
  };
  Both both{Pose::Identity(), Pose::Identity()};
  both.X.linear() = rotation(
      Eigen::Map<const Mat3>(Eigen::Matrix<double, 9, 1>(singular.V.col(0)).data()).eval());
  both.Z.linear() = rotation(
      Eigen::Map<const Mat3>(Eigen::Matrix<double, 9, 1>(singular.U.col(0)).data()).eval());
  solveShifts(samples, &both);
  return both;
}

/// Park & Martin 1994: axes of the relative motions of hand and tag differ by X's rotation.
Both byRelativeMotions(const std::vector<HandEyeSample>& samples) {
  Mat3 cross = Mat3::Zero();
  const std::size_t n = samples.size();
  for (std::size_t i = 0; i < n; ++i)
    for (const std::size_t apart : {n / 7 + 1, n / 3 + 1, n / 2}) {
      const HandEyeSample &p = samples[i], &q = samples[(i + apart) % n];
      const Vec3 hand = rotationVector(p.X_DE.linear().transpose() * q.X_DE.linear());
      const Vec3 tag = rotationVector(p.X_CM.linear().transpose() * q.X_CM.linear());
      cross += hand * tag.transpose();
    }
  Both both{Pose::Identity(), Pose::Identity()};
  both.X.linear() = nearestRotation(cross);
  Mat3 sum = Mat3::Zero();
  for (const HandEyeSample& s : samples)
    sum += s.X_DE.linear() * both.X.linear() * s.X_CM.linear().transpose();
  both.Z.linear() = nearestRotation(sum);
  solveShifts(samples, &both);
  return both;
}

struct Miss {
  Vec3 turn, shift;  // in M, in C
};
Miss missOf(const HandEyeSample& s, const Both& both) {
  const Pose predicted = both.Z.inverse() * s.X_DE * both.X;
  return {rotationVector(s.X_CM.linear().transpose() * predicted.linear()),
          predicted.translation() - s.X_CM.translation()};
}

/// Turn and shift together: a degree weighs as much as 5 mm.
double medianMiss(const std::vector<HandEyeSample>& samples, const Both& both) {
  std::vector<double> misses;
  for (const HandEyeSample& s : samples) {
    const Miss miss = missOf(s, both);
    misses.push_back(std::hypot(miss.turn.norm() / kDegree, miss.shift.norm() / 0.005));
  }
  return upperMedian(std::move(misses));
}

Both bestStart(const std::vector<HandEyeSample>& samples) {
  std::vector<Both> starts{byKroneckerProduct(samples), byRelativeMotions(samples)};
  std::mt19937 bits(1);
  std::vector<HandEyeSample> some = samples;
  for (int i = 0; i < kSubsets && samples.size() > kSubset; ++i) {
    for (std::size_t k = 0; k < kSubset; ++k)
      std::swap(some[k], some[k + bits() % (some.size() - k)]);
    const std::vector<HandEyeSample> subset(some.begin(), some.begin() + kSubset);
    starts.push_back(byKroneckerProduct(subset));
    starts.push_back(byRelativeMotions(subset));
  }
  return *std::min_element(starts.begin(), starts.end(), [&](const Both& a, const Both& b) {
    return medianMiss(samples, a) < medianMiss(samples, b);
  });
}

/// Spreads of the turn, the shift across the view and the shift along it.
struct Spreads {
  double turn = kDegree, across = 0.005, along = 0.005;
};

class HandEyeFit {
 public:
  HandEyeFit(const std::vector<HandEyeSample>& samples, const Both& start)
      : samples_(samples), both_(start) {}

  Fit run() {
    const FitProblem problem{static_cast<int>(samples_.size()), 6, 12,
                             [this](const VectorX& dx) { return residuals(dx); },
                             [this](const VectorX& dx) { both_ = at(dx); }};
    Fit fit = robustFit(problem, kHandEye);
    for (int i = 0; i < 3; ++i) {
      respread(fit);
      fit = robustFit(problem, kHandEye);
    }
    return fit;
  }
  const Both& both() const { return both_; }

 private:
  Both at(const VectorX& dx) const {
    return {moved(both_.X, dx.head<6>()), moved(both_.Z, dx.tail<6>())};
  }

  VectorX residuals(const VectorX& dx) const {
    const Both both = at(dx);
    VectorX r(6 * samples_.size());
    for (std::size_t i = 0; i < samples_.size(); ++i) {
      const Miss miss = missOf(samples_[i], both);
      r.segment<6>(static_cast<Eigen::Index>(6 * i)) << miss.turn / spreads_.turn,
          miss.shift.head<2>() / spreads_.across, miss.shift.z() / spreads_.along;
    }
    return r;
  }

  void respread(const Fit& fit) {
    double turn = 0, across = 0, along = 0, good = 0;
    for (std::size_t i = 0; i < samples_.size(); ++i) {
      if (!fit.good[i]) continue;
      const Miss miss = missOf(samples_[i], both_);
      turn += miss.turn.squaredNorm() / 3;
      across += miss.shift.head<2>().squaredNorm() / 2;
      along += miss.shift.z() * miss.shift.z();
      ++good;
    }
    spreads_ = {std::sqrt(turn / good) + 1e-9, std::sqrt(across / good) + 1e-9,
                std::sqrt(along / good) + 1e-9};
  }

  const std::vector<HandEyeSample>& samples_;
  Both both_;
  Spreads spreads_;
};

struct Rms {
  double turn = 0, shift = 0;
};

template <class Which>
Rms rmsOf(const std::vector<HandEyeSample>& samples, const Both& both, Which which) {
  double turn = 0, shift = 0, count = 0;
  for (std::size_t i = 0; i < samples.size(); ++i) {
    if (!which(i)) continue;
    const Miss miss = missOf(samples[i], both);
    turn += miss.turn.squaredNorm();
    shift += miss.shift.squaredNorm();
    ++count;
  }
  return {std::sqrt(turn / count), std::sqrt(shift / count)};
}

void requireSamples(const std::vector<HandEyeSample>& samples) {
  if (samples.size() < kLeastSamples)
    throw Error(std::to_string(samples.size()) + " samples are too few", kHandEye,
                "Take 15 or more, with the hand turned to every side");
  std::vector<Pose> hand, tag;
  for (const HandEyeSample& s : samples) {
    requirePose(s.X_DE, kHandEye);
    requirePose(s.X_CM, kHandEye);
    hand.push_back(s.X_DE);
    tag.push_back(s.X_CM);
  }
  for (const auto* poses : {&hand, &tag}) {
    const LeastTilted tilts = leastTilted(*poses);
    if (tilts.spread >= kLeastSpread) continue;
    char words[200];
    std::snprintf(words, sizeof words,
                  tilts.most < kLeastSpread
                      ? "the %s did not turn"
                      : "the %s turned about one axis only: the tag's place along it cannot be "
                        "known (it tilted by %.1f degrees rms)",
                  poses == &hand ? "hand" : "tag", tilts.spread / kDegree);
    throw Error(words, kHandEye,
                "Turn the hand about two other axes as well, by 20 degrees and more");
  }
}

/// Where one list inverted would fit, that is said.
[[noreturn]] void refuseMisfit(const std::vector<HandEyeSample>& samples, const Rms& rms) {
  std::vector<HandEyeSample> other = samples;
  for (HandEyeSample& s : other) s.X_CM = s.X_CM.inverse();
  const bool inverted =
      medianMiss(other, bestStart(other)) < 0.3 * medianMiss(samples, bestStart(samples));
  char words[200];
  std::snprintf(words, sizeof words,
                "hand and tag do not move together: %.1f degrees and %.0f mm rms remain",
                rms.turn / kDegree, 1e3 * rms.shift);
  throw Error(
      words, kHandEye,
      inverted
          ? "One of the lists seems to hold the inverse poses (camera in tag instead of tag in "
            "camera)"
          : "See that the samples of both lists were taken together, and that lengths are metres");
}

Both fitted(const std::vector<HandEyeSample>& samples, Fit* fit) {
  HandEyeFit hand_eye(samples, bestStart(samples));
  const Fit found = hand_eye.run();
  if (fit) *fit = found;
  return hand_eye.both();
}

/// Of each fifth, by what the others say; outliers of the whole fit do not count.
Rms leftOut(const std::vector<HandEyeSample>& samples, const std::vector<bool>& good) {
  constexpr std::size_t kParts = 5;
  double turn = 0, shift = 0;
  for (std::size_t part = 0; part < kParts; ++part) {
    std::vector<HandEyeSample> others;
    for (std::size_t i = 0; i < samples.size(); ++i)
      if (i % kParts != part && good[i]) others.push_back(samples[i]);
    const Rms rms = rmsOf(samples, fitted(others, nullptr),
                          [&](std::size_t i) { return i % kParts == part && good[i]; });
    turn += rms.turn * rms.turn / kParts;
    shift += rms.shift * rms.shift / kParts;
  }
  return {std::sqrt(turn), std::sqrt(shift)};
}

}  // namespace

Mat3 HandEye::covarianceAt(const Vec3& p_C) const {
  return pointCovariance(X_DC, covariance.bottomRightCorner<6, 6>(), p_C);
}

HandEye calibrateHandEye(const std::vector<HandEyeSample>& samples) {
  requireSamples(samples);
  HandEye result;
  Both both;
  try {
    both = fitted(samples, &result.fit);
  } catch (const Error&) {  // too many do not fit: say why, if that can be seen
    both = bestStart(samples);
    const Rms rms = rmsOf(samples, both, [](std::size_t) { return true; });
    if (rms.turn > kWorstTurn || rms.shift > kWorstShift) refuseMisfit(samples, rms);
    throw;
  }
  const Rms rms = rmsOf(samples, both, [&](std::size_t i) { return result.fit.good[i]; });
  if (rms.turn > kWorstTurn || rms.shift > kWorstShift) refuseMisfit(samples, rms);
  result.X_EM = both.X;
  result.X_DC = both.Z;
  result.covariance = result.fit.covariance;
  result.rms_turn = rms.turn;
  result.rms_shift = rms.shift;
  if (samples.size() >= 2 * kLeastSamples) {
    const Rms unseen = leftOut(samples, result.fit.good);
    result.left_out_turn = unseen.turn;
    result.left_out_shift = unseen.shift;
  }
  return result;
}

}  // namespace palpa::calibration

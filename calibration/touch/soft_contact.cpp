#include "calibration/touch/contact_laws.h"

#include <algorithm>
#include <cmath>

#include "anatomy/base/error.h"

namespace palpa::calibration {
namespace {

using haptics::HuntCrossley;
constexpr char kPressWhere[] = "material identification";
constexpr double kInContact =
    0.05;  // of the largest force: below, noise rules and logarithms scatter
constexpr int kLeastPressed = 100;  // samples in contact
constexpr double kCutOff = 1e-3,
                 kMostCutOff = 0.05;  // so near to the largest force; share of samples that may be
constexpr double kLeastSpeed =
    0.01;  // m/s: slower, relaxation looks like damping [chosen; hands press at 0.02 to 0.2]
constexpr double kDeterminedWithin =
    0.1;  // 95 % half-widths: of k relative, of m; of b by what it changes k with

std::vector<PressSample> inContact(const std::vector<PressSample>& samples, double largest) {
  std::vector<PressSample> chosen;
  for (const PressSample& s : samples)
    if (s.f > kInContact * largest) chosen.push_back(s);
  return chosen;
}

std::vector<PressSample> inContact(const std::vector<PressSample>& samples, const HuntCrossley& law,
                                   double x0, double largest) {
  std::vector<PressSample> chosen;
  for (const PressSample& s : samples)
    if (haptics::forceOf(law, s.x - x0, s.rate) > kInContact * largest) chosen.push_back(s);
  return chosen;
}

double largestForce(const std::vector<PressSample>& samples) {
  double largest = 0, least = 0;
  for (const PressSample& s : samples) {
    if (!std::isfinite(s.x) || !std::isfinite(s.rate) || !std::isfinite(s.f))
      throw Error("a sample is not a number", kPressWhere, "Record again");
    largest = std::max(largest, s.f);
    least = std::min(least, s.f);
  }
  if (-least > largest)
    throw Error("what is pressed pulls: the force has the wrong sign", kPressWhere,
                "Look at how the sensor is mounted, and which way the depth is counted");
  return largest;
}

double fastest(const std::vector<PressSample>& samples) {
  double speed = 0;
  for (const PressSample& s : samples) speed = std::max(speed, std::abs(s.rate));
  return speed;
}

/// What can be seen before anything is fitted.
void requireInformative(const std::vector<PressSample>& pressed, double largest) {
  if (static_cast<int>(pressed.size()) < kLeastPressed)
    throw Error(std::to_string(pressed.size()) + " samples in contact are too few, " +
                    std::to_string(kLeastPressed) + " are needed",
                kPressWhere, "Press and release for longer");
  const auto flat = std::count_if(pressed.begin(), pressed.end(), [&](const PressSample& s) {
    return s.f > (1 - kCutOff) * largest;
  });
  if (flat > kMostCutOff * static_cast<double>(pressed.size()))
    throw Error("the force is cut off at its largest: the sensor is saturated", kPressWhere,
                "Press less hard");
  const bool in =
      std::any_of(pressed.begin(), pressed.end(), [](const PressSample& s) { return s.rate > 0; });
  const bool out =
      std::any_of(pressed.begin(), pressed.end(), [](const PressSample& s) { return s.rate < 0; });
  if (!in || !out)
    throw Error("it was only pressed, or only released", kPressWhere,
                "Press and release several times");
}

/// State of the fit: ln k, m, c = b/k, x0.
class PressFit {
 public:
  PressFit(const std::vector<PressSample>& samples, const HuntCrossley& start, double x0)
      : samples_(samples), p_(std::log(start.k), start.m, start.b / start.k, x0) {
    double least = samples.front().x;
    for (const PressSample& s : samples) least = std::min(least, s.x);
    p_[3] = std::min(p_[3], least - kOutside);
  }
  Fit run() {
    return robustFit({static_cast<int>(samples_.size()), 1, 4,
                      [this](const VectorX& dp) { return residuals(dp); },
                      [this](const VectorX& dp) { p_ += dp.cwiseProduct(kPressSteps); }},
                     kPressWhere);
  }
  HuntCrossley law() const { return {std::exp(p_[0]), std::exp(p_[0]) * p_[2], p_[1]}; }
  double x0() const { return p_[3]; }
  /// d(k, b, m, x0) / d(step).
  Eigen::Matrix4d derivative() const {
    const double k = std::exp(p_[0]);
    Eigen::Matrix4d D = Eigen::Matrix4d::Zero();
    D(0, 0) = k;
    D(1, 0) = k * p_[2];
    D(1, 2) = k;
    D(2, 1) = 1;
    D(3, 3) = 1;
    return D * kPressSteps.asDiagonal();
  }

 private:
  VectorX residuals(const VectorX& dp) const {
    const Eigen::Vector4d p = p_ + Eigen::Vector4d(dp).cwiseProduct(kPressSteps);
    const double k = std::exp(p[0]);
    VectorX r(static_cast<Eigen::Index>(samples_.size()));
    for (std::size_t i = 0; i < samples_.size(); ++i) {
      const PressSample& s = samples_[i];
      r[static_cast<Eigen::Index>(i)] =
          s.f - k * std::pow(std::max(s.x - p[3], 1e-9), p[1]) * (1 + p[2] * s.rate);
    }
    return r;
  }
  inline static const Eigen::Vector4d kPressSteps{1, 1, 1, 1e-3};  // steps of like size
  static constexpr double kOutside = 1e-4;                         // m
  const std::vector<PressSample>& samples_;
  Eigen::Vector4d p_;
};

void requireDetermined(const SoftContact& found, double speed) {
  const HuntCrossley& law = found.law;
  const Eigen::Vector4d half = 1.96 * found.covariance.diagonal().cwiseSqrt();
  if (!found.covariance.allFinite() || half[0] > 0.5 * law.k || half[2] > 0.5)
    throw Error("the depths are too alike to tell the law's shape", kPressWhere,
                "Press to different depths, and lighter and deeper");
  if (speed < kLeastSpeed || half[1] * speed > 0.2 * law.k)
    throw Error("the speeds are too alike to tell the damping", kPressWhere,
                "Press slowly and fast");
  if (!(law.m >= 0.5 && law.m <= 4))
    throw Error("the exponent " + std::to_string(law.m) + " fits no soft body", kPressWhere,
                "Press along the normal, on one place, and record again");
  if (law.b < -half[1])
    throw Error("it gives back more than was put in", kPressWhere,
                "Is the sign of the force, or the time between force and position, right?");
}

}  // namespace

void PressEstimator::add(const PressSample& s) {
  if (!(s.f > 0) || !(s.x > 0) || !std::isfinite(s.rate)) return;
  largest_ = std::max(largest_, s.f);
  if (s.f < kInContact * largest_) return;
  const Eigen::Vector3d phi(1, std::log(s.x), s.rate);
  const Eigen::Vector3d P_phi = P_ * phi;
  const Eigen::Vector3d gain =
      P_phi / (forgetting_ / (s.f * s.f) + phi.dot(P_phi));  // variance of ln f: (sigma / f)^2
  theta_ += gain * (std::log(s.f) - phi.dot(theta_));
  P_ = (P_ - gain * P_phi.transpose()) / forgetting_;
  P_ = 0.5 * (P_ + P_.transpose()).eval();
  ++samples_;
}

HuntCrossley PressEstimator::law() const {
  const double k = std::exp(theta_[0]);
  return {k, k * theta_[2], theta_[1]};
}

SoftContact identifySoftContact(const std::vector<PressSample>& samples) {
  SoftContact found;
  found.largest_f = largestForce(samples);
  const std::vector<PressSample> pressed = inContact(samples, found.largest_f);
  requireInformative(pressed, found.largest_f);
  PressEstimator start;
  for (const PressSample& s : pressed) start.add(s);
  HuntCrossley guess = start.law();
  guess.m = std::clamp(guess.m, 0.8, 2.5);
  guess.b = std::clamp(guess.b, 0.0, 5 * guess.k);
  PressFit first(pressed, guess, 0);
  first.run();
  // Chosen anew by what the law predicts: chosen by their own noise, samples near the bound would
  // all err to one side.
  const std::vector<PressSample> chosen =
      inContact(samples, first.law(), first.x0(), found.largest_f);
  requireInformative(chosen, found.largest_f);
  PressFit fit(chosen, first.law(), first.x0());
  found.fit = fit.run();
  found.law = fit.law();
  found.x0 = fit.x0();
  const Eigen::Matrix4d D = fit.derivative();
  found.covariance = D * found.fit.covariance * D.transpose();
  found.rms = found.fit.rms;
  double squares = 0;
  for (const PressSample& s : chosen) squares += s.f * s.f / static_cast<double>(chosen.size());
  found.relative_rms = found.rms / std::sqrt(squares);
  const double speed = fastest(chosen);
  requireDetermined(found, speed);
  const Eigen::Vector4d half = 1.96 * found.covariance.diagonal().cwiseSqrt();
  if (half[0] > kDeterminedWithin * found.law.k || half[2] > kDeterminedWithin)
    found.advice = "Press deeper once or twice: the law's shape is told within " +
                   std::to_string(half[2]) + " only.";
  else if (half[1] * speed > kDeterminedWithin * found.law.k)
    found.advice = "Press faster once or twice: the damping is hardly told.";
  found.law.b = std::max(found.law.b, 0.0);
  return found;
}

}  // namespace palpa::calibration

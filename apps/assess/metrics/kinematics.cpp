#include "apps/assess/metrics/kinematics.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <complex>
#include <limits>
#include <unsupported/Eigen/FFT>

namespace palpa::metrics {
namespace {

constexpr double kNone = std::numeric_limits<double>::quiet_NaN();
constexpr double kShortestChord = 0.010;  // m
constexpr double kSpectrumTo_Hz = 10, kLeastAmplitude = 0.05;

/// How often a state of at least `settle_s` begins in which the speed is above the threshold; one
/// that is on at the start counts.
int beginnings(const std::vector<double>& speeds, double threshold, double settle_s) {
  const auto settle = static_cast<int>(std::ceil(settle_s / Motion::kStep_s - 1e-9));
  int count = 0, differs = 0;
  bool on = false;
  for (const double speed : speeds) {
    differs = (speed > threshold) != on ? differs + 1 : 0;
    if (differs <= settle) continue;
    on = !on;
    differs = 0;
    count += on;
  }
  return count;
}

/// Amplitude spectrum from 0 to 10 Hz; padded with zeros to 16 times the motion's length, so that
/// its arc is smooth.
std::vector<double> amplitudes(const std::vector<double>& speeds) {
  std::vector<double> padded = speeds;
  padded.resize(std::bit_ceil(16 * speeds.size()), 0);
  std::vector<std::complex<double>> spectrum;
  Eigen::FFT<double>().fwd(spectrum, padded);
  const double step_Hz = 1 / (Motion::kStep_s * static_cast<double>(padded.size()));
  std::vector<double> values;
  for (std::size_t k = 0; static_cast<double>(k) * step_Hz <= kSpectrumTo_Hz; ++k)
    values.push_back(std::abs(spectrum[k]));
  return values;
}

}  // namespace

double pathLength(const Motion& motion) {
  double sum = 0;
  for (std::size_t i = 1; i < motion.size(); ++i) sum += (motion.tip[i] - motion.tip[i - 1]).norm();
  return sum;
}

double pathInefficiency(const Motion& motion) {
  if (motion.size() == 0) return kNone;
  const double chord = (motion.tip.back() - motion.tip.front()).norm();
  return chord < kShortestChord ? kNone : pathLength(motion) / chord - 1;
}

double meanSpeed(const Motion& motion) {
  return motion.size() < 2
             ? kNone
             : pathLength(motion) / (static_cast<double>(motion.size() - 1) * Motion::kStep_s);
}

double boundingBoxVolume(const Motion& motion) {
  if (motion.size() == 0) return kNone;
  Vec3 low = motion.tip.front(), high = low;
  for (const Vec3& p : motion.tip) {
    low = low.cwiseMin(p);
    high = high.cwiseMax(p);
  }
  return (high - low).prod();
}

double rotationTotal(const Motion& motion) {
  double sum = 0;
  for (const double speed : turningSpeedsOf(motion)) sum += speed * Motion::kStep_s;
  return sum;
}

int translationalActions(const Motion& motion, const ActionRules& rules) {
  return beginnings(speedsOf(motion), rules.speed, rules.settle_s);
}
int rotationalActions(const Motion& motion, const ActionRules& rules) {
  return beginnings(turningSpeedsOf(motion), rules.turning_speed, rules.settle_s);
}

double spectralArcLength(const Motion& motion) {
  const std::vector<double> speeds = speedsOf(motion);
  if (speeds.size() < 3) return kNone;
  const std::vector<double> spectrum = amplitudes(speeds);
  if (!(spectrum[0] > 0)) return kNone;
  std::size_t last = 0;
  for (std::size_t k = 0; k < spectrum.size(); ++k)
    if (spectrum[k] / spectrum[0] >= kLeastAmplitude) last = k;
  if (last == 0) return kNone;
  double arc = 0;
  const double step = 1 / static_cast<double>(last);
  for (std::size_t k = 1; k <= last; ++k)
    arc += std::hypot(step, (spectrum[k] - spectrum[k - 1]) / spectrum[0]);
  return -arc;
}

double integratedJerk(const Motion& motion) {
  if (motion.size() < 4) return kNone;
  double sum = 0;
  for (std::size_t i = 3; i < motion.size(); ++i) {
    const Vec3 third =
        motion.tip[i] - 3 * motion.tip[i - 1] + 3 * motion.tip[i - 2] - motion.tip[i - 3];
    sum += third.squaredNorm() / std::pow(Motion::kStep_s, 6) * Motion::kStep_s;
  }
  return std::sqrt(sum);
}

}  // namespace palpa::metrics

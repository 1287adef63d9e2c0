#include "apps/assess/metrics/motion.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>
#include <numbers>
#include <utility>

#include "anatomy/base/error.h"
#include "anatomy/base/pinned_math.h"

namespace palpa::metrics {
namespace {

struct SampleSum {
  Vec3 tip = Vec3::Zero(), axis = Vec3::Zero();
  double inserted = 0, force = 0;
  int count = 0;

  void add(const RawSample& s) {
    tip += s.tip;
    axis += s.axis;
    inserted += s.inserted;
    force += s.force;
    ++count;
  }
  void appendTo(Motion& motion) const {
    motion.tip.push_back(tip / count);
    motion.axis.push_back(axis.normalized());
    motion.inserted.push_back(inserted / count);
    motion.force.push_back(force / count);
  }
};

void repeatLast(Motion& motion) {
  motion.tip.push_back(Vec3(motion.tip.back()));
  motion.axis.push_back(Vec3(motion.axis.back()));
  motion.inserted.push_back(double{motion.inserted.back()});
  motion.force.push_back(double{motion.force.back()});
}

void require(const RawSample& s, double before_s) {
  const bool finite = std::isfinite(s.t_s) && s.tip.allFinite() && s.axis.allFinite() &&
                      std::isfinite(s.inserted) && std::isfinite(s.force);
  if (!finite || s.t_s < before_s)
    throw Error(finite ? "the time runs backward" : "a sample is not finite",
                "motion at " + std::to_string(s.t_s) + " s", "The recording is damaged");
}

}  // namespace

Motion motionOf(const std::vector<RawSample>& samples) {
  Motion motion;
  if (samples.empty()) return motion;
  const double start = samples.front().t_s;
  SampleSum step;
  double before = start;
  for (const RawSample& s : samples) {
    require(s, before);
    before = s.t_s;
    const auto index = static_cast<std::size_t>((s.t_s - start) / Motion::kStep_s + 1e-9);
    if (index > motion.size() && step.count > 0) {
      step.appendTo(motion);
      step = {};
    }
    while (index > motion.size()) repeatLast(motion);
    step.add(s);
  }
  if (step.count > 0) step.appendTo(motion);
  return motion;
}

std::vector<double> speedsOf(const Motion& motion) {
  std::vector<double> speeds;
  for (std::size_t i = 1; i < motion.size(); ++i)
    speeds.push_back((motion.tip[i] - motion.tip[i - 1]).norm() / Motion::kStep_s);
  return speeds;
}

std::vector<double> turningSpeedsOf(const Motion& motion) {
  std::vector<double> speeds;
  for (std::size_t i = 1; i < motion.size(); ++i)
    speeds.push_back(pinned::atan2(motion.axis[i].cross(motion.axis[i - 1]).norm(),
                                   motion.axis[i].dot(motion.axis[i - 1])) /
                     Motion::kStep_s);
  return speeds;
}

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

/// A signal's discrete Fourier transform (Cooley and Tukey 1965), of a power of two of samples. By
/// hand, since libraries take their sines from the computer's.
struct Spectrum {
  std::vector<double> re, im;

  explicit Spectrum(std::vector<double> signal) : re(std::move(signal)), im(re.size(), 0.0) {
    reverseBits();
    const std::size_t n = re.size();
    std::vector<double> cosine(n / 2), sine(n / 2);
    for (std::size_t k = 0; k < n / 2; ++k) {
      const double turn = 2 * std::numbers::pi * static_cast<double>(k) / static_cast<double>(n);
      cosine[k] = pinned::cos(turn), sine[k] = -pinned::sin(turn);
    }
    for (std::size_t half = 1; half < n; half *= 2)
      for (std::size_t i = 0; i < n; i += 2 * half)
        for (std::size_t k = 0; k < half; ++k)
          join(i + k, i + k + half, cosine[k * (n / 2 / half)], sine[k * (n / 2 / half)]);
  }

 private:
  void join(std::size_t a, std::size_t b, double c, double s) {
    const double x = re[b] * c - im[b] * s, y = re[b] * s + im[b] * c;
    re[b] = re[a] - x, im[b] = im[a] - y;
    re[a] += x, im[a] += y;
  }
  void reverseBits() {
    for (std::size_t i = 1, j = 0; i < re.size(); ++i) {
      std::size_t bit = re.size() / 2;
      for (; j & bit; bit /= 2) j ^= bit;
      j ^= bit;
      if (i < j) std::swap(re[i], re[j]);
    }
  }
};

/// Amplitude spectrum from 0 to 10 Hz; padded with zeros to 16 times the motion's length, so that
/// its arc is smooth.
std::vector<double> amplitudes(const std::vector<double>& speeds) {
  std::vector<double> padded = speeds;
  padded.resize(std::bit_ceil(16 * speeds.size()), 0);
  const Spectrum spectrum(padded);
  const double step_Hz = 1 / (Motion::kStep_s * static_cast<double>(padded.size()));
  std::vector<double> values;
  for (std::size_t k = 0; static_cast<double>(k) * step_Hz <= kSpectrumTo_Hz; ++k)
    values.push_back(pinned::hypot(spectrum.re[k], spectrum.im[k]));
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
    arc += pinned::hypot(step, (spectrum[k] - spectrum[k - 1]) / spectrum[0]);
  return -arc;
}

double integratedJerk(const Motion& motion) {
  if (motion.size() < 4) return kNone;
  double sum = 0;
  for (std::size_t i = 3; i < motion.size(); ++i) {
    const Vec3 third =
        motion.tip[i] - 3 * motion.tip[i - 1] + 3 * motion.tip[i - 2] - motion.tip[i - 3];
    sum += third.squaredNorm() / pinned::pow(Motion::kStep_s, 6) * Motion::kStep_s;
  }
  return std::sqrt(sum);
}

namespace {

constexpr double kNoForce = std::numeric_limits<double>::quiet_NaN();

}  // namespace

double peakForce(const Motion& motion) {
  return motion.size() == 0 ? kNoForce
                            : *std::max_element(motion.force.begin(), motion.force.end());
}

double meanForce(const Motion& motion) {
  double sum = 0;
  int count = 0;
  for (const double f : motion.force) {
    if (f < kContactForce_N) continue;
    sum += f;
    ++count;
  }
  return count > 0 ? sum / count : kNoForce;
}

double overForceTime(const Motion& motion, double limit_N) {
  return Motion::kStep_s *
         static_cast<double>(std::count_if(motion.force.begin(), motion.force.end(),
                                           [&](double f) { return f > limit_N; }));
}

double forceJerk(const Motion& motion) {
  double sum = 0;
  int count = 0;
  for (std::size_t i = 1; i < motion.size(); ++i) {
    if (motion.force[i] < kContactForce_N || motion.force[i - 1] < kContactForce_N) continue;
    const double rate = (motion.force[i] - motion.force[i - 1]) / Motion::kStep_s;
    sum += rate * rate;
    ++count;
  }
  return count > 0 ? std::sqrt(sum / count) : kNoForce;
}

namespace {

bool insideAt(const Motion& motion, std::size_t i) { return motion.inserted[i] > 0; }
bool insideSince(const Motion& motion, std::size_t i) {
  return i > 0 && insideAt(motion, i) && insideAt(motion, i - 1);
}
Vec3 entryAt(const Motion& motion, std::size_t i) {
  return motion.tip[i] - motion.inserted[i] * motion.axis[i];
}
double triangle(const Vec3& a, const Vec3& b, const Vec3& c) {
  return (b - a).cross(c - a).norm() / 2;
}

}  // namespace

double tissueTime(const Motion& motion) {
  double sum = 0;
  for (std::size_t i = 0; i < motion.size(); ++i) sum += insideAt(motion, i) ? Motion::kStep_s : 0;
  return sum;
}

double tissuePath(const Motion& motion) {
  double sum = 0;
  for (std::size_t i = 1; i < motion.size(); ++i)
    if (insideSince(motion, i)) sum += (motion.tip[i] - motion.tip[i - 1]).norm();
  return sum;
}

double tissueDamage(const Motion& motion) {
  double sum = 0;
  for (std::size_t i = 1; i < motion.size(); ++i) {
    if (!insideSince(motion, i)) continue;
    const Vec3 before = entryAt(motion, i - 1), after = entryAt(motion, i);
    sum +=
        triangle(before, motion.tip[i - 1], motion.tip[i]) + triangle(before, motion.tip[i], after);
  }
  return sum;
}

int insertions(const Motion& motion) {
  int count = 0;
  for (std::size_t i = 0; i < motion.size(); ++i)
    count += insideAt(motion, i) && (i == 0 || !insideAt(motion, i - 1));
  return count;
}

}  // namespace palpa::metrics

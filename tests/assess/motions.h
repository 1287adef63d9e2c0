#pragma once

#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include "apps/assess/needle/assess_trial.h"
#include "apps/training/trial_words.h"

/// Hand-made motions with known answers. The patient has landmarks only; L is parallel to A on the
/// right side (medial +x, posterior +y, cephalad +z), so numbers can be checked by eye.
namespace palpa::assess::test {

constexpr double kDeg = M_PI / 180;

inline anatomy::Patient landmarksOnly() {
  anatomy::Patient patient;
  patient.name = "landmarks only";
  patient.landmarks[anatomy::landmark::kAcromialEnd] = {-0.16, 0.02, 0.0};
  patient.landmarks[anatomy::landmark::kSternalEnd] = {-0.01, 0.02, 0.0};
  patient.landmarks[anatomy::landmark::kMedialThird] = {-0.06, 0.02, 0.0};
  return patient;
}

/// Direction `elevation` toward the back out of the frontal plane and `azimuth` cephalad of medial.
inline Vec3 direction_L(double elevation, double azimuth) {
  return {std::cos(elevation) * std::cos(azimuth), std::sin(elevation),
          std::cos(elevation) * std::sin(azimuth)};
}

/// Entry 10 mm below the junction, phase 1 straight back for 8 mm, then medially 25 degrees steep
/// and 15 degrees cephalad for 30 mm.
inline calibration::TaughtPath taughtPath() {
  calibration::TaughtPath path;
  path.entry_L = {0, -0.02, -0.01};
  path.depth = 0.008;
  path.direction_L = direction_L(25 * kDeg, 15 * kDeg);
  path.direction_sd = 3 * kDeg;
  path.direction_acceptable = 6 * kDeg;
  path.line_from_L = path.entry_L + Vec3(0, 0.008, 0);
  path.line_to_L = path.line_from_L + 0.030 * path.direction_L;
  return path;
}

/// Of the body on which that path is taught.
inline calibration::TeachingLine teachingLine() {
  return {taughtPath().entry_L, Vec3::UnitY(), taughtPath().line_to_L};
}

/// Writes a trial tick by tick: hold, push along the needle, turn about the tip, with what is
/// touched.
class Motion {
 public:
  explicit Motion(double rate_Hz = 1000) : dt_(1 / rate_Hz) {
    now_.tip_A = toA(taughtPath().entry_L) - Vec3(0, 0.010, 0);
    now_.axis_A = Vec3::UnitY();
  }
  static Vec3 toA(const Vec3& p_L) { return p_L + Vec3(-0.06, 0.02, 0.0); }

  TrialSample& now() { return now_; }
  std::vector<TrialSample>& samples() { return samples_; }
  double time() const { return static_cast<double>(tick_) * dt_; }

  Motion& hold(double s) {
    for (const long end = tick_ + std::lround(s / dt_); tick_ < end;) write();
    return *this;
  }
  /// Along the needle by `distance` (negative: drawn back) at `speed`, m/s.
  Motion& push(double distance, double speed = 0.01) {
    const long n = std::lround(std::abs(distance) / speed / dt_);
    for (long i = 0; i < n; ++i) {
      now_.tip_A += now_.axis_A * (distance / static_cast<double>(n));
      if (now_.phase == haptics::NeedlePhase::inserted)
        now_.depth += distance / static_cast<double>(n);
      write();
    }
    return *this;
  }
  /// About the tip to a direction at `speed`, rad/s; `advance` m along the needle meanwhile.
  Motion& turnTo(const Vec3& axis_A, double speed = 20 * kDeg, double advance = 0) {
    const Vec3 from = now_.axis_A;
    const double angle = std::atan2(from.cross(axis_A).norm(), from.dot(axis_A));
    const long n = std::max(1L, std::lround(angle / speed / dt_));
    const Vec3 pivot = from.cross(axis_A).normalized();
    for (long i = 1; i <= n; ++i) {
      now_.axis_A =
          Eigen::AngleAxisd(angle * static_cast<double>(i) / static_cast<double>(n), pivot) * from;
      now_.tip_A += now_.axis_A * (advance / static_cast<double>(n));
      now_.depth += advance / static_cast<double>(n);
      write();
    }
    return *this;
  }
  Motion& puncture() {
    now_.phase = haptics::NeedlePhase::inserted;
    now_.tissue = Tissue::fat;
    now_.depth = 0;
    events_ = haptics::kSkinPunctured;
    write();
    return *this;
  }
  Motion& withdraw() {
    push(-now_.depth);
    now_.phase = haptics::NeedlePhase::outside;
    now_.tissue = Tissue::air;
    now_.wall = now_.bone = Organ::none;
    events_ = haptics::kWithdrawn;
    return *this;
  }
  Motion& in(Tissue tissue, Organ wall = Organ::none) {
    now_.tissue = tissue;
    now_.wall = wall;
    return *this;
  }
  Motion& bone(Organ organ, double force) {
    now_.bone = organ;
    now_.bone_force = force;
    return *this;
  }

 private:
  void write() {
    now_.t_s = time();
    now_.bevel_A = rotationWithZ(now_.axis_A, Vec3(0, -1, 0.3)).col(1);  // up
    now_.events = events_;
    events_ = 0;
    samples_.push_back(now_);
    ++tick_;
  }

  double dt_;
  long tick_ = 0;
  TrialSample now_;
  std::uint32_t events_ = 0;
  std::vector<TrialSample> samples_;
};

/// 1 s to the skin, entry, 8 mm, turn, 28 mm to the vein's wall, 2 mm into it, blood for 1 s.
inline Motion textbook(double rate_Hz = 1000) {
  Motion m(rate_Hz);
  m.push(0.010).puncture().push(0.008).turnTo(taughtPath().direction_L).push(0.028);
  m.in(Tissue::connective, Organ::vein).hold(0.2).in(Tissue::vein_lumen).push(0.002);
  m.now().plunger = 0.5;
  m.hold(1.0 + 1 / rate_Hz);
  return m;
}

inline TrialFacts facts(const std::string& outcome = "success") {
  TrialFacts f;
  f.trial = 1;
  f.role = training::Role::scored;
  f.outcome = training::outcomeNamed(outcome);
  return f;
}

/// A patient without lung and arteries, and one in whom they are far.
inline double nowhere(Organ, const Vec3&) { return std::numeric_limits<double>::infinity(); }
inline double far(Organ, const Vec3&) { return 0.5; }

inline TrialAssessment assess(const std::vector<TrialSample>& samples,
                              const std::string& outcome = "success",
                              const ScoringRules& rules = {}) {
  return assessTrial(facts(outcome), samples, landmarksOnly(), OrganDistance(far), taughtPath(),
                     rules);
}

inline const Penalty& penalty(const TrialAssessment& a, const std::string& code) {
  for (const Penalty& p : a.penalties)
    if (p.code == code) return p;
  throw std::runtime_error("no line " + code);
}

}  // namespace palpa::assess::test

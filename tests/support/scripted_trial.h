#pragma once

#include <algorithm>
#include <string>

#include "anatomy/base/random.h"
#include "anatomy/patient.h"
#include "tests/assess/motions.h"

/// Hand-made needle trials on a patient's landmarks, as the expert path has them, with one thing
/// wrong and everything else as a good trial scatters. Nobody performed them.
namespace palpa::test {

using assess::test::kDeg;

/// What is done, in the terms of the six errors. As it stands: nothing wrong.
struct Script {
  /// M, of the puncture from the taught one: toward the breastbone, toward the clavicle
  double along = 0, across = 0;
  double steeper = 0, cephalad = 0;           ///< rad, of the advance from the taught direction
  double clavicle_N = 1.5, clavicle_s = 0.6;  ///< the guide's touch
  bool finds_vein = true;
  double loses_after_s = 0;  ///< the vein is lost when blood has come so long; 0: never
  bool through = false;      ///< lost through the back wall, else drawn out
  double lost_s = 1;
  bool found_again = true;
  Tissue meets = Tissue::air;  ///< lung or artery, on the way
  int redirections = 0;        ///< drawn back and led a little elsewhere
  bool suction = true;
};

/// What of a good trial differs from one to the next: figures of the shipped path, "palpa calibrate
/// experts".
inline Script scattered(RandomStream& draw, const calibration::TaughtPath& path,
                        Script script = {}) {
  script.along += path.entry_sd * draw.openNormal();
  script.across += path.entry_sd * draw.openNormal();
  script.steeper += path.direction_sd * draw.openNormal();
  script.cephalad += path.direction_sd * draw.openNormal();
  script.clavicle_N *= 0.5 + draw.openUniform();
  script.clavicle_s *= 0.5 + draw.openUniform();
  return script;
}

/// A hand's tremor: 8 to 12 Hz, 0.1 mm and 0.2 degrees.
inline void tremble(std::vector<assess::TrialSample>* samples, RandomStream& draw) {
  const double turn = 2 * M_PI * (8 + 4 * draw.openUniform()),
               phase = 2 * M_PI * draw.openUniform();
  for (assess::TrialSample& s : *samples) {
    const double c = std::cos(turn * s.t_s + phase), n = std::sin(turn * s.t_s + phase);
    s.tip_A += 1e-4 * Vec3(c, n, 0.7 * c);
    s.axis_A = (s.axis_A + 0.2 * kDeg * Vec3(n, 0.5 * c, c)).normalized();
  }
}

/// The taught direction, turned: toward the back by `steeper`, toward the head by a true angle of
/// `cephalad`.
inline Vec3 turned_L(const Vec3& taught_L, double steeper, double cephalad) {
  const double elevation = std::asin(taught_L.y()) + steeper,
               azimuth = std::atan2(taught_L.z(), taught_L.x()) + cephalad / std::cos(elevation);
  return assess::test::direction_L(elevation, azimuth);
}

/// Leads a Motion through the steps of a script.
class ScriptedHand {
 public:
  ScriptedHand(const Script& script, const anatomy::LandmarkFrame& frame,
               const calibration::TaughtPath& path, RandomStream& draw)
      : script_(script), frame_(frame), path_(path), draw_(draw) {
    const Vec3 entry_L = path.entry_L + Vec3(script.along, 0, script.across);
    motion_.now().axis_A = frame.vectorToA(Vec3(0, 0.97, 0.24).normalized());
    motion_.now().tip_A = frame.pointToA(entry_L) - 0.010 * motion_.now().axis_A;
  }
  std::vector<assess::TrialSample> trial() {
    motion_.push(0.010).puncture().push(path_.depth * (0.9 + 0.2 * draw_.openUniform()));
    const Vec3 direction_A =
        frame_.vectorToA(turned_L(path_.direction_L, script_.steeper, script_.cephalad));
    motion_.hold(0.3).turnTo(direction_A, (20 + 15 * draw_.openUniform()) * kDeg);
    motion_.now().plunger = script_.suction ? 0.4 : 0;
    advance();
    tremble(&motion_.samples(), draw_);
    return motion_.samples();
  }

 private:
  double speed() { return 0.003 + 0.005 * draw_.openUniform(); }
  void advance() {
    motion_.push(0.006, speed())
        .bone(Organ::clavicle, script_.clavicle_N)
        .push(0.001 * script_.clavicle_s, 0.001)
        .bone(Organ::none, 0);
    for (int i = 0; i < script_.redirections; ++i) {
      motion_.push(0.008, speed()).push(-0.010);
      motion_.turnTo(motion_.now().axis_A + 5 * kDeg * frame_.vectorToA(Vec3(0, i % 2 ? -1 : 1, 0)),
                     10 * kDeg);
    }
    motion_.push(0.012, speed());
    if (script_.meets != Tissue::air)
      motion_.in(script_.meets).push(0.002, speed()).push(-0.002).in(Tissue::connective);
    if (script_.finds_vein)
      vein();
    else
      motion_.push(0.010, speed()).withdraw().hold(0.5);
  }
  void enter() {
    motion_.push(0.004, speed())
        .in(Tissue::connective, Organ::vein)
        .push(0.001, 0.003)
        .in(Tissue::vein_lumen)
        .push(0.001, 0.010);  // a tenth of a second
    motion_.now().plunger = 0.5;
  }
  void vein() {
    enter();
    if (script_.loses_after_s > 0) lose();
    if (motion_.now().tissue == Tissue::vein_lumen) motion_.hold(1.02);
  }
  void lose() {
    motion_.hold(script_.loses_after_s);
    motion_.in(Tissue::connective, Organ::none)
        .push(script_.through ? 0.004 : -0.004)
        .hold(script_.lost_s);
    if (!script_.found_again)
      motion_.withdraw().hold(0.5);
    else if (script_.through)
      motion_.push(-0.004).in(Tissue::vein_lumen).push(-0.001);
    else
      enter();
  }

  Script script_;
  const anatomy::LandmarkFrame& frame_;
  const calibration::TaughtPath& path_;
  RandomStream& draw_;
  assess::test::Motion motion_{200};
};

inline bool succeeds(const Script& script) {
  return script.finds_vein && (script.loses_after_s == 0 || script.found_again);
}

}  // namespace palpa::test

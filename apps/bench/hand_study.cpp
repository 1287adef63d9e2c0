#include "apps/bench/hand_study.h"

#include <algorithm>
#include <cmath>

#include "apps/bench/sensed_touch.h"

namespace palpa::bench {
namespace {

using twin::LedTip;

constexpr double kPressDeep = 7e-3, kHold = 3.0, kCalmAfter = 2.5;   // m; s of holding, and from when on it must be calm: a light grip rings for two seconds by itself
constexpr int kStepsPerTick = 8;                                        // phantom, hand and mechanics do not wait for the loop
constexpr std::uint64_t kHandSeed = 31;

/// Down, hold, across, hold, up; three times, deeper each time.
LedTip handsWay() {
  LedTip way(Vec3(-0.01, 0, 2e-3));
  for (int i = 1; i <= 3; ++i) {
    const Vec3 below(0, 0, -kPressDeep * i / 3);
    way.go(Vec3(-0.01, 0, 0) + below, 0.4, kHold).go(Vec3(0.01, 0, 0) + below, 0.5, kHold).go(Vec3(0.01, 0, 2e-3), 0.3).go(Vec3(-0.01, 0, 2e-3), 0.3);
  }
  return way;
}

/// Whether the hand has been standing for `kCalmAfter` and stands on.
bool calmNow(const LedTip& way, double t) { return t > kCalmAfter && (way.at(t) - way.at(t - kCalmAfter)).norm() < 1e-9 && way.at(t).z() < 0; }

}  // namespace

HandFigures handFigures(const twin::PhantomTwin& start, const HandCase& one) {
  const LedTip way = handsWay();
  twin::PhantomTwin phantom = start;
  twin::DeviceTwin device(one.truth, makePose(Mat3::Identity(), way.at(0)));
  SensedTouch sensed(kHandSeed, one.truth);
  haptics::FrictionModulationState state;
  HandFigures figures;
  Vec3 tip_last = way.at(0), f_touch = Vec3::Zero();
  double given = 0, sum2 = 0;
  int calm = 0;
  for (double t = 0; t < way.duration(); t += kPhantomTick) {
    const Vec3 true_tip = device.truePose().translation();
    const auto [tip, f_r] = sensed.feel(true_tip, f_touch, kPhantomTick);
    const haptics::Modulated now = haptics::modulateFriction(one.law, f_r, tip - tip_last, kPhantomTick, &state);
    tip_last = tip;
    const Vec3 f_d = one.modulated ? now.f_d : Vec3(Vec3::Zero());
    for (int i = 1; i <= kStepsPerTick; ++i) {
      const double part = kPhantomTick / kStepsPerTick;
      device.advance(part, makePose(Mat3::Identity(), way.at(t - kPhantomTick + i * part)), one.grip, f_d, f_touch);
      given += device.gripForce().dot(device.trueVelocity()) * part;
      f_touch = phantom.step(device.truePose().translation(), part).f;
    }
    figures.gained_mJ = std::max(figures.gained_mJ, -1e3 * given);
    figures.largest_N = std::max(figures.largest_N, f_d.norm());
    if (calmNow(way, t)) {
      sum2 += device.trueVelocity().squaredNorm();
      ++calm;
    } else if (calm > 0) {
      figures.still_mm_s = std::max(figures.still_mm_s, 1e3 * std::sqrt(sum2 / calm));
      sum2 = calm = 0;
    }
  }
  return figures;
}

std::vector<HandCase> handCases(const KnownPhantom& known) {
  // Phantom Premium 1.5: 8.5 N, 0.03 mm, 75 g, 0.04 N of friction (its maker's sheet). Falcon: 8 N, 0.06 mm; inertia and friction [chosen] as larger.
  const std::pair<const char*, twin::DeviceTruth> devices[] = {{"premium", {0.075, 0.04, 0.2, 30e-6, 0.0006, 8.5, 0.001, {}}}, {"falcon", {0.15, 0.25, 0.6, 60e-6, 0.0006, 8.0, 0.002, {}}}};
  const haptics::Dahl real = known.friction.law;
  struct Change {
    const char* name;
    double factor;
    haptics::Dahl wanted;
    bool modulated;
  };
  const Change changes[] = {{"none", 1, real, false}, {"stiffness x 0.5", 0.5, real, true}, {"stiffness x 2", 2, real, true},
                            {"smoother", 1, {0.5 * real.mu, real.sigma, real.B}, true}, {"rougher", 1, {2 * real.mu, real.sigma, 2 * real.B}, true}};
  std::vector<HandCase> cases;
  for (const auto& [name, truth] : devices) {
    for (const Change& change : changes) {
      for (const double stiffness : {100.0, 1000.0}) {
        for (const double damping : {2.0, 10.0}) {
          for (const double mass : {0.05, 0.2}) {
            haptics::StiffnessModulation contact = feelingOf(known, 0.1);
            contact.target.factor = change.factor;
            cases.push_back({name, change.name, truth, {stiffness, damping, mass}, {contact, change.wanted}, change.modulated});
          }
        }
      }
    }
  }
  return cases;
}

}  // namespace palpa::bench

#include "apps/bench/grip_study.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "apps/bench/sensed_touch.h"
#include "apps/twin/held_object.h"

namespace palpa::bench {
namespace {

using twin::LedTip;

constexpr double kHalf = 0.03, kMass = 0.02,
                 kGravity = 9.80665;  // m, kg, m/s^2: friction holds it at 5 mm of depth, and no
                                      // more than that is known of the sides
constexpr double kGripDeep = 5e-3, kSqueezed = 7e-3, kLift = 0.03;  // m
constexpr double kFalls = 1.5, kStill = 2.5;  // s: the support goes; from then on it must be calm:
                                              // a light grip rings for two seconds by itself
constexpr int kParts = 8;  // a tick's: object, hands and mechanics do not wait for the loop
constexpr std::uint64_t kGripSeed = 53;

/// Beside the object, in; up; harder; and down again, of the tool at +x. A hand that is a soft
/// spring reaches as much further as it takes to get so deep.
LedTip gripWay(const twin::PhantomTable& side, const GripCase& one) {
  const double factor = one.modulated ? one.law.target.factor : 1;
  const auto in = [&](double depth) {
    return kHalf - depth - factor * side.at(0, depth).f_up / one.grip.stiffness;
  };
  LedTip way(Vec3(kHalf + 3e-3, 0, 0));
  return way.go(Vec3(in(kGripDeep), 0, 0), 0.8, 3.7)
      .go(Vec3(in(kGripDeep), 0, kLift), 0.6, 3)
      .go(Vec3(in(kSqueezed), 0, kLift), 0.5, 3)
      .go(Vec3(in(kGripDeep), 0, 0.2 * kLift), 0.6, 3);
}

Vec3 mirrored(const Vec3& p) { return {-p.x(), p.y(), p.z()}; }

bool gripCalm(const LedTip& way, double t) {
  return t > kFalls + kStill && (way.at(t) - way.at(t - kStill)).norm() < 1e-9;
}

}  // namespace

GripFigures gripFigures(const twin::PhantomTable& side, const GripCase& one) {
  const LedTip way = gripWay(side, one);
  const auto hand = [&](std::size_t t, double at) {
    return makePose(Mat3::Identity(), t == 0 ? way.at(at) : mirrored(way.at(at)));
  };
  std::array<twin::DeviceTwin, 2> devices{twin::DeviceTwin(one.truth, hand(0, 0)),
                                          twin::DeviceTwin(one.truth, hand(1, 0))};
  std::array<SensedTouch, 2> sensed{SensedTouch(kGripSeed, one.truth),
                                    SensedTouch(kGripSeed + 1, one.truth)};
  twin::HeldObject object({kHalf, kMass}, side, {});
  haptics::SqueezeState state;
  HandWatch watch;
  std::array<Vec3, 2> f_touch{Vec3::Zero(), Vec3::Zero()};
  double given = 0;
  GripFigures figures;
  for (double t = 0; t < way.duration(); t += kPhantomTick) {
    std::array<Vec3, 2> p, f_r;
    for (std::size_t i = 0; i < 2; ++i)
      std::tie(p[i], f_r[i]) =
          sensed[i].feel(devices[i].truePose().translation(), f_touch[i], kPhantomTick);
    const haptics::Squeezed now = haptics::modulateSqueeze(one.law, f_r, p, &state);
    for (int part = 1; part <= kParts; ++part) {
      const double dt = kPhantomTick / kParts;
      std::array<Vec3, 2> tips;
      for (std::size_t i = 0; i < 2; ++i) {
        devices[i].advance(dt, hand(i, t - kPhantomTick + part * dt), one.grip,
                           one.modulated ? now.f_d[i] : Vec3(Vec3::Zero()), f_touch[i]);
        given += devices[i].gripForce().dot(devices[i].trueVelocity()) * dt;
        tips[i] = devices[i].truePose().translation();
      }
      f_touch = object.step(tips, dt, t < kFalls);
    }
    const double felt_weight =
        kMass * kGravity * (one.modulated ? std::max(one.law.weight_factor, 1.0) : 1.0);
    const double least = -felt_weight * std::max(-object.place().z(), 0.0);  // what falls gives
    for (std::size_t i = 0; i < 2; ++i)
      watch.count(given, least, one.modulated ? now.f_d[i] : Vec3(Vec3::Zero()),
                  devices[i].trueVelocity(), gripCalm(way, t));
    const double tools_z =
        0.5 * (devices[0].truePose().translation().z() + devices[1].truePose().translation().z());
    figures.dropped_mm = std::max(figures.dropped_mm, 1e3 * (tools_z - object.place().z()));
  }
  figures.hands = watch.figures();
  return figures;
}

std::vector<GripCase> gripCases(const haptics::HuntCrossley& side) {
  struct Change {
    const char* name;
    double factor, weight;
    bool modulated;
  };
  const Change changes[] = {
      {"none", 1, 1, false},          {"squeezed, x 0.5", 0.5, 1, true},
      {"squeezed, x 2", 2, 1, true},  {"half as heavy", 1, 0.5, true},
      {"twice as heavy", 1, 2, true}, {"squeezed, x 2, twice as heavy", 2, 2, true}};
  std::vector<GripCase> cases;
  for (const JudgedDevice& device : judgedDevices()) {
    for (const Change& change : changes) {
      for (const twin::HandGrip& grip : judgedHands()) {
        haptics::SqueezeModulation law;
        law.real = side;
        law.target.factor = change.factor;
        law.weight_factor = change.weight;
        cases.push_back({device.name, change.name, device.truth, grip, law, change.modulated});
      }
    }
  }
  return cases;
}

}  // namespace palpa::bench

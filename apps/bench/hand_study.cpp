#include "apps/bench/contact_study.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "anatomy/base/units.h"
#include "apps/bench/phantom_recording.h"
#include "apps/twin/soft_samples.h"

namespace palpa::bench {
namespace {

using twin::LedTip;

constexpr double kPressDeep = 7e-3, kHold = 3.0,
                 // m; s of holding, and from when on it must be calm: a light grip rings for two
                 // seconds by itself
    kCalmAfter = 2.5;
constexpr int kStepsPerTick = 8;  // phantom, hand and mechanics do not wait for the loop
constexpr std::uint64_t kHandSeed = 31;

/// Down, hold, across, hold, up; three times, deeper each time.
LedTip handsWay() {
  LedTip way(Vec3(-0.01, 0, 2e-3));
  for (int i = 1; i <= 3; ++i) {
    const Vec3 below(0, 0, -kPressDeep * i / 3);
    way.go(Vec3(-0.01, 0, 0) + below, 0.4, kHold)
        .go(Vec3(0.01, 0, 0) + below, 0.5, kHold)
        .go(Vec3(0.01, 0, 2e-3), 0.3)
        .go(Vec3(-0.01, 0, 2e-3), 0.3);
  }
  return way;
}

/// Whether the hand has been standing for `kCalmAfter` and stands on.
bool calmNow(const LedTip& way, double t) {
  return t > kCalmAfter && (way.at(t) - way.at(t - kCalmAfter)).norm() < 1e-9 && way.at(t).z() < 0;
}

}  // namespace

void HandWatch::count(double given_J, double least_J, const Vec3& f_d, const Vec3& v,
                      bool calm_now) {
  figures_.gained_mJ = std::max(figures_.gained_mJ, 1e3 * (least_J - given_J));
  figures_.largest_N = std::max(figures_.largest_N, f_d.norm());
  if (calm_now) {
    sum2_ += v.squaredNorm();
    ++calm_;
  } else if (calm_ > 0) {
    figures_.still_mm_s = std::max(figures_.still_mm_s, 1e3 * std::sqrt(sum2_ / calm_));
    sum2_ = calm_ = 0;
  }
}

HandFigures handFigures(const twin::PhantomTwin& start, const HandCase& one) {
  const LedTip way = handsWay();
  twin::PhantomTwin phantom = start;
  twin::DeviceTwin device(one.truth, makePose(Mat3::Identity(), way.at(0)));
  SensedTouch sensed(kHandSeed, one.truth, one.noise);
  haptics::TouchAugmentationState state;
  HandWatch watch;
  Vec3 f_touch = Vec3::Zero();
  double given = 0;
  for (double t = 0; t < way.duration(); t += kPhantomTick) {
    const auto [tip, f_r] = sensed.feel(device.truePose().translation(), f_touch, kPhantomTick);
    const haptics::AugmentedTouch now = haptics::augmentTouch(
        one.law, one.lumps, {{{true, tip + one.law.tip_radius * Vec3::UnitZ(), f_r}, {}}},
        kPhantomTick, &state);
    const Vec3 f_d = one.modulated ? now.f_d[0] : Vec3(Vec3::Zero());
    for (int i = 1; i <= kStepsPerTick; ++i) {
      const double part = kPhantomTick / kStepsPerTick;
      device.advance(part, makePose(Mat3::Identity(), way.at(t - kPhantomTick + i * part)),
                     one.grip, f_d, f_touch);
      given += device.gripForce().dot(device.trueVelocity()) * part;
      f_touch = phantom.step(device.truePose().translation(), part).f;
    }
    watch.count(given, 0, f_d, device.trueVelocity(), calmNow(way, t));
  }
  return watch.figures();
}

std::vector<JudgedDevice> judgedDevices() {
  // Phantom Premium 1.5: 8.5 N, 0.03 mm, 75 g, 0.04 N of friction (its maker's sheet). A coarse
  // one of three parallel legs: 8 N, 0.06 mm; inertia and friction [chosen] as larger.
  return {{"premium", {0.075, 0.04, 0.2, 30e-6, 0.0006, 8.5, 0.001, {}}},
          {"parallel", {0.15, 0.25, 0.6, 60e-6, 0.0006, 8.0, 0.002, {}}}};
}

std::vector<twin::HandGrip> judgedHands() {
  std::vector<twin::HandGrip> hands;
  for (const double stiffness : {100.0, 1000.0}) {
    for (const double damping : {2.0, 10.0}) {
      for (const double mass : {0.05, 0.2}) hands.push_back({stiffness, damping, mass});
    }
  }
  return hands;
}

std::vector<twin::HandGrip> ringingHands() { return {{100, 2, 0.2}, {1000, 2, 0.2}}; }

std::vector<HandCase> handCases(const KnownPhantom& known, const haptics::TouchAugmentation& lump,
                                const Vec3& p_T0, const std::vector<twin::HandGrip>& hands,
                                Noise noise) {
  const haptics::Dahl real = known.friction.law;
  struct HandChange {
    const char* name;
    double factor;
    haptics::Dahl wanted;
    bool lump, modulated;
  };
  const HandChange changes[] = {
      {"none", 1, real, false, false},
      {"stiffness x 0.5", 0.5, real, false, true},
      {"stiffness x 2", 2, real, false, true},
      {"smoother", 1, {0.5 * real.mu, real.sigma, real.B}, false, true},
      {"rougher", 1, {2 * real.mu, real.sigma, 2 * real.B}, false, true},
      {"lump", 1, real, true, true},
      {"lump, stiffness x 2, rougher", 2, {2 * real.mu, real.sigma, 2 * real.B}, true, true}};
  std::vector<HandCase> cases;
  for (const JudgedDevice& device : judgedDevices()) {
    for (const HandChange& change : changes) {
      for (const twin::HandGrip& grip : hands) {
        HandCase one{device.name, change.name, device.truth,     grip,
                     lump,        {},          change.modulated, noise};
        one.law.surface = {feelingOf(known, 0.1), change.wanted};
        one.law.surface.contact.target.factor = change.factor;
        one.law.other_friction = 1;
        if (change.lump) one.lumps = {{{pack(p_T0), 1}}};
        cases.push_back(one);
      }
    }
  }
  return cases;
}

namespace {

using twin::LedTip;

// m, kg: friction holds it at 5 mm of depth, and no more than that is known of the sides
constexpr double kHalf = 0.03, kMass = 0.02;
constexpr double kGripDeep = 5e-3, kSqueezed = 7e-3, kLift = 0.03;  // m
// s: the support goes; from then on it must be calm: a light grip rings for two seconds by itself
constexpr double kFalls = 1.5, kStill = 2.5;
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
  std::array<SensedTouch, 2> sensed{SensedTouch(kGripSeed, one.truth, one.noise),
                                    SensedTouch(kGripSeed + 1, one.truth, one.noise)};
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

std::vector<GripCase> gripCases(const calibration::SoftContact& side,
                                const std::vector<twin::HandGrip>& hands, Noise noise) {
  struct GripChange {
    const char* name;
    double factor, weight;
    bool modulated;
  };
  const GripChange changes[] = {
      {"none", 1, 1, false},          {"squeezed, x 0.5", 0.5, 1, true},
      {"squeezed, x 2", 2, 1, true},  {"half as heavy", 1, 0.5, true},
      {"twice as heavy", 1, 2, true}, {"squeezed, x 2, twice as heavy", 2, 2, true}};
  std::vector<GripCase> cases;
  for (const JudgedDevice& device : judgedDevices()) {
    for (const GripChange& change : changes) {
      for (const twin::HandGrip& grip : hands) {
        haptics::SqueezeModulation law;
        law.real = side.law;
        law.x0 = side.x0;
        law.target.factor = change.factor;
        law.weight_factor = change.weight;
        cases.push_back(
            {device.name, change.name, device.truth, grip, law, change.modulated, noise});
      }
    }
  }
  return cases;
}

}  // namespace palpa::bench

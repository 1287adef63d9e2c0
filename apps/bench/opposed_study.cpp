#include <algorithm>
#include <cmath>

#include "apps/bench/contact_study.h"
#include "calibration/touch/contact_laws.h"
#include "haptics/modulation/estimated_reaction.h"
#include "haptics/modulation/touch_augmentation.h"

namespace palpa::bench {
namespace {

using twin::LedTip;
using Tips = std::array<LedTip, 2>;
using Ticks = std::vector<std::array<PhantomTick, 2>>;

constexpr double kPinchDeep = 5e-3, kPinchLight = 1.5e-3, kAloneDeep = 6e-3, kClear = 2e-3;  // m
constexpr double kBesideLump = 8e-3, kOverLump = 0.012;                                      // m
constexpr double kLeastPinched = 0.1;                                                        // N
constexpr std::uint64_t kPinchSeen = 31, kPinchFresh = 131;  // seeds

/// The second tool follows the first on the other face.
Tips pinched(const LedTip& tip) { return {tip, tip}; }
/// The second tool is nowhere near.
Tips alone(const LedTip& tip) { return {tip, LedTip(Vec3(0, 0, 0.05))}; }

/// Of both tools: how far they have come toward each other, and with what force.
void addPinch(const Ticks& ticks, double thickness, std::vector<calibration::PressSample>* out) {
  for (const auto& [first, second] : ticks)
    out->push_back({0.5 * (second.tip.z() - first.tip.z() + thickness),
                    0.5 * (second.dp.z() - first.dp.z()) / kPhantomTick,
                    0.5 * (first.f_r.z() - second.f_r.z())});
}

void addPress(const Ticks& ticks, std::vector<calibration::PressSample>* out) {
  for (const auto& [first, second] : ticks)
    out->push_back({-first.tip.z(), -first.dp.z() / kPhantomTick, first.f_r.z()});
}

std::vector<calibration::SlideSample> slides(const Ticks& ticks) {
  std::vector<calibration::SlideSample> samples;
  for (const auto& [first, second] : ticks)
    samples.push_back(
        {first.tip, Vec3::UnitZ(), first.f_r.z(), -Vec3(first.f_r.x(), first.f_r.y(), 0)});
  return samples;
}

}  // namespace

double KnownSlab::givesWay(double f) const {
  if (!(f > 0)) return 0;
  const auto depth = [f](const calibration::SoftContact& contact) {
    return contact.x0 + haptics::depthOf(contact.law, f, 0);
  };
  return std::max(depth(alone) - depth(pinched.contact), 0.0);
}

KnownSlab identifySlab(const twin::OpposedTable& plain, Noise noise) {
  const twin::OpposedPhantomTwin twin(plain, {});
  const auto record = [&](const Tips& tips, std::uint64_t seed) {
    return recordOpposed(twin, tips, noise, seed);
  };
  const auto press = [](double deep, std::uint64_t seed) {
    return twin::pressing(Vec3::Zero(), deep, seed);
  };
  const auto tap = [](double deep, std::uint64_t seed) {
    return twin::tapping(Vec3::Zero(), deep, seed);
  };
  std::vector<calibration::PressSample> both, one;
  const std::uint64_t seed = kPinchSeen;
  addPinch(record(pinched(press(kPinchDeep, seed)), seed), plain.thickness, &both);
  addPinch(record(pinched(tap(kPinchDeep, seed + 1)), seed + 1), plain.thickness, &both);
  addPress(record(alone(press(kAloneDeep, seed + 2)), seed + 2), &one);
  addPress(record(alone(tap(kAloneDeep, seed + 3)), seed + 3), &one);
  const Ticks strokes =
      record(pinched(twin::stroking(Vec3::Zero(), kPinchDeep, kOverLump, Vec3::UnitX(), seed + 4)),
             seed + 4);
  return {{calibration::identifySoftContact(both),
           calibration::identifySurfaceFriction(slides(strokes), kPhantomTick)},
          calibration::identifySoftContact(one)};
}

std::vector<PlainTouches> pinchPlain(const twin::OpposedTable& plain, Noise noise) {
  constexpr double kShift = 3e-3, kStrokeReach = 0.01;  // m
  LedTip together(Vec3(kShift, 0, kClear));
  for (const double depth : {0.5 * kPinchDeep, 0.8 * kPinchDeep, kPinchDeep})
    together.go({kShift, 0, -depth}, 0.5, 0.3).go({kShift, 0, kClear}, 0.4);
  Tips in_turn = pinched(LedTip(Vec3(-kShift, 0, kClear)));
  const auto press = [&](double first, double second, double seconds, double hold) {
    in_turn[0].go({-kShift, 0, -first}, seconds, hold);
    in_turn[1].go({-kShift, 0, -second}, seconds, hold);
  };
  press(kPinchLight, kPinchLight, 0.3, 0);
  for (int i = 0; i < 3; ++i) {
    press(kPinchDeep, kPinchLight, 0.35, 0.1);
    press(kPinchLight, kPinchDeep, 0.35, 0.1);
  }
  press(-kClear, -kClear, 0.3, 0);
  LedTip stroke(Vec3(-kStrokeReach, 0, kClear));
  for (const double depth : {0.6 * kPinchDeep, 0.9 * kPinchDeep})
    stroke.go({-kStrokeReach, 0, -depth}, 0.4)
        .go({kStrokeReach, 0, -depth}, 0.9)
        .go({-kStrokeReach, 0, -depth}, 0.8);
  stroke.go({-kStrokeReach, 0, kClear}, 0.4);
  std::vector<PlainTouches> all;
  std::uint64_t seed = kPinchFresh;
  const twin::OpposedPhantomTwin twin(plain, {});
  for (const auto& [motion, tips] :
       {std::pair{"opposed", pinched(together)}, std::pair{"opposed in turn", in_turn},
        std::pair{"opposed, stroked", pinched(stroke)}})
    all.push_back({2, motion, recordOpposed(twin, tips, noise, seed++), true});
  return all;
}

namespace {

/// Of the first tool; one that is alone pushes the slab away as a whole, which the samples' frame
/// goes along with.
void addLump(const Ticks& ticks, const KnownSlab& known, bool gives,
             std::vector<calibration::LumpSample>* out) {
  double before = 0;
  for (const auto& [tick, second] : ticks) {
    const double s = gives ? known.givesWay(tick.f_r.z()) : 0;
    const Vec3 back = s * Vec3::UnitZ();
    out->push_back({tick.tip + back, Vec3::UnitZ(), tick.f_r, -tick.tip.z() - s,
                    (before - s - tick.dp.z()) / kPhantomTick, tick.truth.lump + back});
    before = s;
  }
}

}  // namespace

haptics::TouchAugmentation lumpInSlab(const twin::OpposedPhantom& lumped, const KnownSlab& known,
                                      Noise noise) {
  const twin::OpposedPhantomTwin twin(lumped.table, {});
  std::vector<calibration::LumpSample> samples;
  std::uint64_t seed = kPinchSeen + 100;
  const auto record = [&](const Tips& tips, bool gives) {
    addLump(recordOpposed(twin, tips, noise, seed), known, gives, &samples);
    ++seed;
  };
  record(pinched(twin::pressing(Vec3::Zero(), kPinchDeep, seed)), false);
  record(pinched(twin::tapping(Vec3::Zero(), kPinchDeep, seed)), false);
  record(alone(twin::pressing(Vec3::Zero(), kAloneDeep, seed)), true);
  record(alone(twin::tapping(Vec3::Zero(), kAloneDeep, seed)), true);
  record(alone(twin::stroking(Vec3::Zero(), kAloneDeep, kOverLump, Vec3(0, 1, 0), seed)), true);
  for (const Vec3& side : {Vec3(kBesideLump, 0, 0), Vec3(0, kBesideLump, 0),
                           Vec3(-kBesideLump, 0, 0), Vec3(0, -kBesideLump, 0)})
    record(alone(twin::pressing(side, kAloneDeep, seed)), true);
  const calibration::LumpContact found =
      calibration::identifyLump(samples, known.pinched.contact, known.pinched.friction.law,
                                lumped.block.lump->centre, lumped.table.tool_radius, kPhantomTick);
  haptics::TouchAugmentation law;
  law.surface.contact = feelingOf(known.pinched, kLeastPinched);
  law.kinds[0] = {found.l0, found.H_T, found.G};
  law.tip_radius = lumped.table.tool_radius;
  return law;
}

double estimateError(const PlainTouches& touches, const haptics::StiffnessModulation& law,
                     double tip_radius, double thickness) {
  RelativeRms error;
  haptics::EstimateState state;
  for (const auto& [first, second] : touches.ticks) {
    const Vec3 up = tip_radius * Vec3::UnitZ(), off = touches.opposed ? Vec3(-up) : up;
    const haptics::EstimatedReaction told = haptics::estimateReaction(
        {law, law}, {touches.opposed, thickness}, tip_radius, {true, first.tip + up, first.f_r},
        second.tip + off, kPhantomTick, &state);
    if (second.truth.contact) error.add(told.f_r - second.truth.f, second.truth.f);
  }
  return error.value();
}

LumpFigures opposedFigures(const std::vector<PlainTouches>& plain,
                           const twin::OpposedPhantom& lumped,
                           const haptics::TouchAugmentation& law) {
  return lumpFigures(plain, lumped.block.lump->centre, law, [&](const PlainTouches&) {
    return [slab = twin::OpposedPhantomTwin(lumped.table, {})](
               const std::array<Vec3, 2>& tips) mutable { return slab.step(tips, kPhantomTick); };
  });
}

}  // namespace palpa::bench

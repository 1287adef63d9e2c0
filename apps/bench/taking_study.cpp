#include "apps/bench/taking_study.h"

#include <algorithm>
#include <cmath>
#include <complex>
#include <numbers>

#include "anatomy/base/random.h"
#include "haptics/augmentation/augmentation.h"
#include "haptics/modulation/taken_lumps.h"

namespace palpa::bench {
namespace {

constexpr double kTakenDeep = 7e-3;  // m, as deep as the lumps were identified

haptics::AugmentationPlan steadyingPlan(const haptics::DampedBand& band) {
  haptics::AugmentationPlan plan;
  plan.count = 1;
  plan.largest = 3;  // N, as a task limits it
  haptics::Augmentation& a = plan.each[0];
  a.kind = haptics::AugmentationKind::steadying;
  a.amplitude = band.damping;
  a.from_Hz = band.from_Hz;
  a.to_Hz = band.to_Hz;
  a.blend_s = 0;
  return plan;
}

struct SteadiedRun {
  std::vector<double> x;  ///< m, of the tip, a tick each
  double largest_N = 0;
};

SteadiedRun trembling(const SteadiedCase& one, bool steadied) {
  constexpr double kSeconds = 30;
  RandomStream ways(one.seed, "bench.steadied_ways");
  twin::LedTip way(Vec3::Zero());
  while (way.duration() < kSeconds)
    way.go(Vec3(ways.uniform(-0.01, 0.01), 0, 0), ways.uniform(0.5, 1.2), ways.uniform(0.2, 0.6));
  twin::Tremor tremor(one.tremor_rms, RandomStream(one.seed, "bench.steadied_tremor"));
  twin::DeviceTwin device(one.truth, Pose::Identity());
  const haptics::AugmentationPlan plan = steadyingPlan(one.band);
  haptics::AugmentationState state;
  haptics::AugmentationInput in;
  Vec3 before = Vec3::Zero();
  SteadiedRun run;
  for (int k = 0; k < static_cast<int>(kSeconds / kPhantomTick); ++k) {
    const Vec3 read = unpack(device.encoderPose().p);
    in.dp = read - before;
    before = read;
    const Vec3 f_d = steadied ? haptics::augment(plan, in, &state).f : Vec3(Vec3::Zero());
    run.largest_N = std::max(run.largest_N, f_d.norm());
    const Vec3 wanted = way.at(k * kPhantomTick) + tremor.next(kPhantomTick);
    device.advance(kPhantomTick, makePose(Mat3::Identity(), wanted), one.grip, f_d);
    run.x.push_back(device.truePose().translation().x());
  }
  return run;
}

/// By a discrete Fourier transform over the whole run, Hann's window.
std::vector<std::complex<double>> spectrum(const std::vector<double>& x, double from_Hz,
                                           double to_Hz) {
  const double seconds = 1e-3 * static_cast<double>(x.size());
  std::vector<std::complex<double>> lines;
  for (double f = std::max(from_Hz, 1 / seconds); f <= to_Hz; f += 1 / seconds) {
    const std::complex<double> step = std::polar(1.0, -2e-3 * std::numbers::pi * f);
    std::complex<double> turn = 1, sum = 0;
    for (std::size_t k = 0; k < x.size(); ++k, turn *= step)
      sum += (0.5 - 0.5 * std::cos(2 * std::numbers::pi * static_cast<double>(k) /
                                   static_cast<double>(x.size()))) *
             x[k] * turn;
    lines.push_back(sum);
  }
  return lines;
}

double rmsOf(const std::vector<std::complex<double>>& lines) {
  double sum = 0;
  for (const std::complex<double>& line : lines) sum += std::norm(line);
  return std::sqrt(sum);
}

}  // namespace

TakenFigures takenFigures(const twin::Phantom& plain, const twin::Phantom& lumped,
                          const haptics::TouchAugmentation& law, Noise noise) {
  TakenFigures figures;
  RelativeRms left, there;
  for (const PlainTouches& touches : touchPlain(lumped, 1, noise)) {
    twin::PhantomTwin without(plain.table, {});
    haptics::TouchAugmentationState state;
    const haptics::PlacedLumps lumps{{{pack(lumped.block.lump->centre), 1, 1}}};
    for (const std::array<PhantomTick, 2>& ticks : touches.ticks) {
      const PhantomTick& tick = ticks[0];
      const Vec3 p_M = tick.tip + law.tip_radius * Vec3::UnitZ();
      const haptics::AugmentedTouch now = haptics::augmentTouch(
          law, lumps, {haptics::ToolTouch{true, p_M, tick.f_r}, {}}, kPhantomTick, &state);
      figures.iterations = std::max(figures.iterations, now.iterations);
      const twin::PhantomTouch wanted = without.step(tick.true_tip, kPhantomTick);
      if (!tick.truth.contact) continue;
      left.add(tick.truth.f + now.f_d[0] - wanted.f, wanted.f);
      there.add(tick.truth.f - wanted.f, wanted.f);
    }
  }
  figures.left = left.value();
  figures.there = there.value();
  figures.taken_N_per_m = haptics::steepestRise(law.kinds[0], law.tip_radius, kTakenDeep);
  return figures;
}

SteadiedFigures steadiedFigures(const SteadiedCase& one) {
  const SteadiedRun off = trembling(one, false), on = trembling(one, true);
  const auto ratio = [&](double from_Hz, double to_Hz) {
    return rmsOf(spectrum(on.x, from_Hz, to_Hz)) / rmsOf(spectrum(off.x, from_Hz, to_Hz));
  };
  std::vector<double> changed(off.x.size());
  for (std::size_t k = 0; k < changed.size(); ++k) changed[k] = on.x[k] - off.x[k];
  return {ratio(8, 12), rmsOf(spectrum(changed, 0, 2)) / rmsOf(spectrum(off.x, 0, 2)), ratio(4, 8),
          on.largest_N};
}

}  // namespace palpa::bench

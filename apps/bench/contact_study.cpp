#include "apps/bench/contact_study.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "anatomy/base/units.h"
#include "haptics/modulation/modulation.h"

namespace palpa::bench {
namespace {

using twin::LedTip;

constexpr double kDeep = 7e-3, kReach = 0.02;  // m
constexpr double kLeastFelt = 0.1;             // N, of the modulation
constexpr double kLeastJudged = 0.2;  // N: lighter touches come and go with the sensor's noise
const haptics::Dahl kOtherSurface{0.7, 900, 1.0};
constexpr std::uint64_t kSeen = 1, kFresh = 101;  // seeds

std::vector<calibration::PressSample> pressSamples(const std::vector<PhantomTick>& ticks) {
  std::vector<calibration::PressSample> samples;
  for (const PhantomTick& tick : ticks)
    samples.push_back({-tick.tip.z(), -tick.dp.z() / kPhantomTick, tick.f_r.z()});
  return samples;
}

std::vector<calibration::SlideSample> slideSamples(const std::vector<PhantomTick>& ticks) {
  std::vector<calibration::SlideSample> samples;
  for (const PhantomTick& tick : ticks)
    samples.push_back(
        {tick.tip, Vec3::UnitZ(), tick.f_r.z(), -Vec3(tick.f_r.x(), tick.f_r.y(), 0)});
  return samples;
}

/// The same silicone with the other surface: what truly drags there.
twin::SiliconeLaw otherSilicone() {
  twin::SiliconeLaw law;
  law.mu = kOtherSurface.mu;
  law.sigma = kOtherSurface.sigma;
  law.B = kOtherSurface.B;
  law.sticks = law.load_power = 0;
  return law;
}

Vec3 frictionOf(const twin::PhantomTouch& truth) { return truth.f - truth.f_n * truth.n; }

bool judged(const PhantomTick& tick) { return tick.truth.contact && tick.truth.f_n > kLeastJudged; }

Vec3 trueStep(const std::vector<PhantomTick>& ticks, std::size_t i) {
  return i > 0 ? Vec3(ticks[i].true_tip - ticks[i - 1].true_tip) : Vec3(Vec3::Zero());
}

}  // namespace

double reactionDelay(const TouchRun& run) {
  constexpr int kEarliest = -10, kLatest = 30;  // ticks
  const auto off = [&run](int shift) {
    double sum = 0;
    for (int i = 1 - kEarliest; i + kLatest + 1 < static_cast<int>(run.ticks.size()); ++i)
      sum += (run.ticks[static_cast<std::size_t>(i + shift)].f_r -
              run.ticks[static_cast<std::size_t>(i)].truth.f)
                 .squaredNorm();
    return sum;
  };
  int best = 0;
  for (int shift = kEarliest; shift <= kLatest; ++shift)
    if (off(shift) < off(best)) best = shift;
  const double before = off(best - 1), at = off(best), after = off(best + 1),
               bend = before - 2 * at + after;
  return kPhantomTick * (best + (bend > 0 ? 0.5 * (before - after) / bend : 0));
}

double RelativeRms::value() const { return of2_ > 0 ? std::sqrt(off2_ / of2_) : 0; }

KnownPhantom identifyPhantom(const twin::PhantomTwin& phantom, Noise noise) {
  std::vector<calibration::PressSample> presses =
      pressSamples(recordTouch(phantom, twin::pressing(Vec3::Zero(), kDeep, kSeen), noise, kSeen));
  const std::vector<calibration::PressSample> taps = pressSamples(
      recordTouch(phantom, twin::tapping(Vec3::Zero(), kDeep, kSeen + 1), noise, kSeen + 1));
  presses.insert(presses.end(), taps.begin(), taps.end());
  const std::vector<PhantomTick> strokes =
      recordTouch(phantom, twin::stroking(Vec3::Zero(), kDeep, kReach, Vec3::UnitX(), kSeen + 2),
                  noise, kSeen + 2);
  return {calibration::identifySoftContact(presses),
          calibration::identifySurfaceFriction(slideSamples(strokes), kPhantomTick)};
}

haptics::StiffnessModulation feelingOf(const KnownPhantom& known, double least_contact) {
  return {known.contact.law, known.contact.x0, known.friction.law, {}, least_contact};
}

std::vector<TouchRun> freshTouches(const twin::PhantomTwin& phantom, Noise noise) {
  const Vec3 way = Vec3(1, 0.4, 0).normalized();
  return {{"pressing",
           recordTouch(phantom, twin::pressing(Vec3::Zero(), kDeep, kFresh), noise, kFresh)},
          {"tapping",
           recordTouch(phantom, twin::tapping(Vec3::Zero(), kDeep, kFresh + 1), noise, kFresh + 1)},
          {"stroking",
           recordTouch(phantom, twin::stroking(Vec3::Zero(), kDeep, kReach, way, kFresh + 2), noise,
                       kFresh + 2)}};
}

double contactForceError(const KnownPhantom& known, const std::vector<TouchRun>& runs) {
  RelativeRms error;
  for (const TouchRun& run : runs) {
    for (std::size_t i = 1; i < run.ticks.size(); ++i) {
      const twin::PhantomTouch& truth = run.ticks[i].truth;
      if (!truth.contact) continue;
      const double rate = -trueStep(run.ticks, i).z() / kPhantomTick;
      error.add(
          (haptics::forceOf(known.contact.law, truth.x - known.contact.x0, rate) - truth.f_n) *
              truth.n,
          truth.f_n * truth.n);
    }
  }
  return error.value();
}

double frictionForceError(const KnownPhantom& known, const std::vector<TouchRun>& runs) {
  RelativeRms error;
  for (const TouchRun& run : runs) {
    haptics::DahlState state;
    for (std::size_t i = 1; i < run.ticks.size(); ++i) {
      const twin::PhantomTouch& truth = run.ticks[i].truth;
      const Vec3 drag = haptics::dragOf(known.friction.law, trueStep(run.ticks, i), truth.n,
                                        truth.contact ? truth.f_n : 0, kPhantomTick, &state),
                 f_t = frictionOf(truth);
      if (truth.contact) error.add(drag + f_t, f_t);
    }
  }
  return error.value();
}

double lawError() {
  const haptics::HuntCrossley truth{900, 600, 1.35};
  std::vector<calibration::PressSample> samples;
  for (const LedTip& tip : {twin::pressing(Vec3::Zero(), kDeep, kSeen),
                            twin::tapping(Vec3::Zero(), kDeep, kSeen + 1)}) {
    for (double t = kPhantomTick; t < tip.duration(); t += kPhantomTick) {
      const double x = -tip.at(t).z(), rate = (x + tip.at(t - kPhantomTick).z()) / kPhantomTick;
      samples.push_back({x, rate, haptics::forceOf(truth, x, rate)});
    }
  }
  const haptics::HuntCrossley found = calibration::identifySoftContact(samples).law;
  return std::max({std::abs(found.k / truth.k - 1), std::abs(found.b / truth.b - 1),
                   std::abs(found.m / truth.m - 1)});
}

StiffnessFigures stiffnessFigures(const KnownPhantom& known, const TouchRun& run, double factor) {
  StiffnessFigures figures;
  RelativeRms error;
  haptics::StiffnessModulationState state;
  for (const PhantomTick& tick : run.ticks) {
    const double true_stiffness = tick.truth.x > 0 ? tick.truth.f_n / tick.truth.x : 0;
    haptics::StiffnessModulation law = feelingOf(known, kLeastFelt);
    law.target.constant = factor * true_stiffness;  // a field over the surface and the depth
    const haptics::Modulated now =
        haptics::modulateStiffness(law, tick.f_r, tick.dp, kPhantomTick, &state);
    if (!judged(tick)) continue;
    const Vec3 wanted = -(factor * tick.truth.f_n * tick.truth.n + frictionOf(tick.truth)),
               hand = -(tick.truth.f + now.f_d);
    error.add(hand - wanted, wanted);
    figures.largest_N = std::max(figures.largest_N, now.f_d.norm());
    figures.largest_share = std::max(figures.largest_share, now.f_d.norm() / tick.truth.f.norm());
  }
  figures.error = error.value();
  return figures;
}

double frictionModulationError(const KnownPhantom& known, const twin::PhantomTable& phantom,
                               const std::vector<TouchRun>& runs) {
  const haptics::FrictionModulation law{feelingOf(known, kLeastFelt), kOtherSurface};
  RelativeRms error;
  for (const TouchRun& run : runs) {
    haptics::FrictionModulationState state;
    twin::PhantomTwin other(phantom, otherSilicone());
    for (const PhantomTick& tick : run.ticks) {
      const haptics::Modulated now =
          haptics::modulateFriction(law, tick.f_r, tick.dp, kPhantomTick, &state);
      const Vec3 wanted = frictionOf(other.step(tick.true_tip, kPhantomTick)),
                 f = tick.truth.f + now.f_d, felt = f - f.dot(tick.truth.n) * tick.truth.n;
      if (judged(tick)) error.add(felt - wanted, wanted);
    }
  }
  return error.value();
}

namespace {

constexpr double kThick = 0.06;  // m
constexpr double kInAir = 2;     // s before they touch
constexpr double
    kFirm = 3e-3,
    kDeepest = 7e-3;  // m that both tools press, so that nothing slips, to begin with and at most

double pushOf(const twin::PhantomTable& side, double x) { return side.at(0, x).f_up; }

/// Depths at both sides whose sum is known and whose forces differ by what hangs along the line:
/// bisection.
std::array<double, 2> settledDepths(const twin::PhantomTable& side, double sum, double along) {
  double low = 0, high = sum;
  for (int i = 0; i < 60; ++i) {
    const double first = 0.5 * (low + high);
    (pushOf(side, first) - pushOf(side, sum - first) < along ? low : high) = first;
  }
  return {low, sum - low};
}

/// Two tools and the object between them, and what truly is at a time.
struct Held {
  std::array<Vec3, 2> p, f_r;  ///< m; N, the object's reaction
  double mean = 0;             ///< m of depth, of both
  bool judged = false;
};

/// From the air to touch together; lifted once they hold firmly; then squeezed to and fro.
Held heldAt(double t, const twin::PhantomTable& side, const Vec3& l, const Vec3& weight) {
  Held held;
  held.mean = t < 1 ? kFirm * t : kFirm + (kDeepest - kFirm) * 0.5 * (1 - std::cos(2 * (t - 1)));
  const Vec3 half = 0.5 * (kThick - 2 * held.mean) * l;
  held.p = {half, -half};
  held.f_r = {Vec3::Zero(), Vec3::Zero()};
  held.judged = t >= 1.5;
  if (held.mean <= 0) return held;
  const Vec3 hangs = std::clamp((t - 1) / 0.5, 0.0, 1.0) * weight,
             across = 0.5 * (hangs - hangs.dot(l) * l);
  const std::array<double, 2> x = settledDepths(side, 2 * held.mean, hangs.dot(l));
  // Outward push, and half of the weight across the line.
  held.f_r = {pushOf(side, x[0]) * l + across, -pushOf(side, x[1]) * l + across};
  return held;
}

}  // namespace

double squeezeError(const twin::PhantomTable& side, const calibration::SoftContact& known,
                    const SqueezeCase& squeeze, Noise noise) {
  const Vec3 l(std::cos(squeeze.tilt), 0,
               std::sin(squeeze.tilt));  // from the second tool to the first, the higher one
  const Vec3 weight(0, 0, -squeeze.mass * kGravity);
  const std::size_t a = squeeze.swapped ? 1 : 0;
  std::array<TouchRecorder, 2> tools{TouchRecorder(noise, kFresh), TouchRecorder(noise, kSeen)};
  haptics::SqueezeState state;
  haptics::SqueezeModulation law;
  law.real = known.law;
  law.x0 = known.x0;
  RelativeRms error;
  for (double t = -kInAir; t < 4; t += kPhantomTick) {
    const Held held = heldAt(t, side, l, weight);
    std::array<Vec3, 2> p, f_r;
    for (std::size_t i = 0; i < 2; ++i) {
      const PhantomTick felt = tools[i].record(held.p[i], {.f = held.f_r[i]});
      p[i ^ a] = felt.tip;
      f_r[i ^ a] = felt.f_r;
    }
    law.target.constant = held.mean > 0 ? squeeze.factor * pushOf(side, held.mean) / held.mean : 1;
    const haptics::Squeezed now = haptics::modulateSqueeze(law, f_r, p, &state);
    if (!held.judged) continue;
    for (std::size_t i = 0; i < 2; ++i) {
      const Vec3 u = i == 0 ? l : Vec3(-l),
                 wanted = law.target.constant * held.mean * u + 0.5 * weight;
      error.add(held.f_r[i] + now.f_d[i ^ a] - wanted, wanted);
    }
  }
  return error.value();
}

}  // namespace palpa::bench

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "apps/calibrate/results.h"

namespace palpa::calibrate {
namespace {

double rateAt(const FeltSamples& felt, std::size_t i) {
  return i > 0 ? (felt.samples[i - 1].p_P.z() - felt.samples[i].p_P.z()) / felt.dt : 0;
}

FeltSamples part(const FeltSamples& felt, std::size_t from, std::size_t to) {
  const auto at = [&](std::size_t i) {
    return felt.samples.begin() + static_cast<std::ptrdiff_t>(i);
  };
  return {felt.dt, {at(from), at(to)}};
}

std::size_t threeQuarters(const FeltSamples& felt) { return felt.samples.size() * 3 / 4; }

}  // namespace

std::vector<calibration::PressSample> pressesOf(const FeltSamples& felt) {
  std::vector<calibration::PressSample> presses;
  for (std::size_t i = 0; i < felt.samples.size(); ++i)
    presses.push_back({-felt.samples[i].p_P.z(), rateAt(felt, i), felt.samples[i].f_P.z()});
  return presses;
}

std::vector<calibration::SlideSample> slidesOf(const FeltSamples& felt) {
  std::vector<calibration::SlideSample> slides;
  for (const FeltSample& s : felt.samples)
    slides.push_back({s.p_P, Vec3::UnitZ(), s.f_P.z(), -Vec3(s.f_P.x(), s.f_P.y(), 0)});
  return slides;
}

std::vector<calibration::LumpSample> lumpTouchesOf(const FeltSamples& felt) {
  std::vector<calibration::LumpSample> touches;
  for (std::size_t i = 0; i < felt.samples.size(); ++i) {
    const FeltSample& s = felt.samples[i];
    touches.push_back({s.p_P, Vec3::UnitZ(), s.f_P, -s.p_P.z(), rateAt(felt, i),
                       s.lump_P.value_or(Vec3::Zero())});
  }
  return touches;
}

FeltSamples toFit(const FeltSamples& felt) { return part(felt, 0, threeQuarters(felt)); }
FeltSamples toJudge(const FeltSamples& felt) {
  return part(felt, threeQuarters(felt), felt.samples.size());
}

namespace {

constexpr int kMaterialGoodFor_days = 180;
constexpr double kFeltOff_percent =
    7;  // what fingers can just tell of a force between 2.5 and 10 N
constexpr double kLeastFelt_N = 0.1;
constexpr std::size_t kShownPresses = 400;
constexpr double kSlowPress = 0.01;  // m/s

/// Root mean square of what the law does not explain over that of the force, in contact, in
/// percent.
double offBy(const calibration::SoftContact& found,
             const std::vector<calibration::PressSample>& presses) {
  double off = 0, all = 0;
  for (const calibration::PressSample& s : presses) {
    if (s.f < kLeastFelt_N) continue;
    off += std::pow(s.f - haptics::forceOf(found.law, s.x - found.x0, s.rate), 2);
    all += s.f * s.f;
  }
  return all > 0 ? 100 * std::sqrt(off / all) : 100;
}

MeasuredPlot forceOverDepth(const calibration::SoftContact& found,
                            const std::vector<calibration::PressSample>& presses) {
  MeasuredPlot plot{"Force over depth", "depth, mm", "N", {}};
  double deepest = 0;
  const std::size_t every = std::max<std::size_t>(1, presses.size() / kShownPresses);
  for (std::size_t i = 0; i < presses.size(); i += every) {
    if (presses[i].f < kLeastFelt_N || presses[i].x < 0) continue;
    plot.dots.push_back({1e3 * presses[i].x, presses[i].f, false});
    deepest = std::max(deepest, presses[i].x);
  }
  for (double x = std::max(found.x0, 0.0); x < deepest; x += deepest / 60)
    plot.predicted.push_back(
        {1e3 * x, haptics::forceOf(found.law, x - found.x0, kSlowPress), false});
  return plot;
}

}  // namespace

Result materialResult(const FeltSamples& felt, const Origin& origin) {
  const std::vector<calibration::PressSample> fitted = pressesOf(toFit(felt)),
                                              judged = pressesOf(toJudge(felt));
  const calibration::SoftContact found = calibration::identifySoftContact(fitted);
  Result r;
  r.title = "Softness of the sample";
  r.file = begun(origin, station::CalibrationKind::material, kMaterialGoodFor_days);
  r.file.parameters = {{"k_N_per_m_to_the_m", {found.law.k}},
                       {"b_Ns_per_m_to_the_m_plus_1", {found.law.b}},
                       {"m", {found.law.m}},
                       {"x0_m", {found.x0}}};
  r.file.coordinates = {"k_N_per_m_to_the_m", "b_Ns_per_m_to_the_m_plus_1", "m", "x0_m"};
  r.file.covariance = found.covariance;
  r.file.residuals = {"N", found.rms, {}, {}};
  r.file.checks = {
      {"force not explained in presses not used", offBy(found, judged), kFeltOff_percent, "%"}};
  r.file.data.samples = static_cast<int>(felt.samples.size());
  r.file.data.used = static_cast<int>(fitted.size()) - found.fit.outliers();
  r.file.verdict = verdictOf(r.file.checks);
  const auto force = [&](double depth) {
    return quantity(haptics::forceOf(found.law, depth, kSlowPress), "N");
  };
  r.sentences = {"Pressed slowly, it takes " + force(3e-3) + " to go 3 mm deep, " + force(6e-3) +
                 " for 6 mm."};
  if (!found.advice.empty()) r.advice.push_back(found.advice);
  r.advice.push_back(
      "Redo it for every sample: silicone of one recipe differs, and grows harder over months.");
  r.plots.push_back(forceOverDepth(found, judged));
  return r;
}

namespace {

constexpr int kFrictionGoodFor_days = 90;
constexpr double kRubbedOff_percent = 7, kLeastRubbed_N = 0.1, kNotTouched_N = 0.02;
constexpr int kLeastUntouched = 100;
constexpr std::size_t kShownSlides = 500;

/// Mean square of what the sensor shows across the normal where nothing is touched, N^2: hands
/// tremble, encoders step.
double noiseOf(const std::vector<calibration::SlideSample>& slides) {
  double squares = 0;
  int untouched = 0;
  for (const calibration::SlideSample& s : slides) {
    if (s.f_n > kNotTouched_N) continue;
    squares += s.drag.squaredNorm();
    ++untouched;
  }
  return untouched > kLeastUntouched ? squares / untouched : 0;
}

/// The law run over the whole recording, for what drags now depends on the way before; what it
/// predicts along x from `from` on, and how much it errs there beyond the noise, in percent of the
/// rms drag.
struct Prediction {
  std::vector<double> drag;
  double off_percent = 0;
};
Prediction predict(const haptics::Dahl& law, const std::vector<calibration::SlideSample>& slides,
                   std::size_t from, double dt) {
  Prediction told;
  haptics::DahlState state;
  const double noise = noiseOf(slides);
  double off = 0, all = 0;
  for (std::size_t i = 0; i < slides.size(); ++i) {
    const Vec3 dp = i > 0 ? Vec3(slides[i].p - slides[i - 1].p) : Vec3(Vec3::Zero());
    const Vec3 drag =
        haptics::dragOf(law, dp, slides[i].n, std::max(slides[i].f_n, 0.0), dt, &state);
    if (i < from) continue;
    told.drag.push_back(drag.x());
    if (slides[i].f_n < kLeastRubbed_N) continue;
    off += (drag - slides[i].drag).squaredNorm() - noise;
    all += slides[i].drag.squaredNorm();
  }
  told.off_percent = all > 0 ? 100 * std::sqrt(std::max(off, 0.0) / all) : 100;
  return told;
}

/// How far it has slid, against how hard it was dragged: sizes, for an axis that begins at zero.
MeasuredPlot dragOverTime(const std::vector<calibration::SlideSample>& slides,
                          const Prediction& told, double dt) {
  MeasuredPlot plot{"Friction while stroking", "s", "N", {}};
  const std::size_t every = std::max<std::size_t>(1, slides.size() / kShownSlides);
  for (std::size_t i = 0; i < slides.size(); i += every) {
    const double t = dt * static_cast<double>(i);
    plot.dots.push_back({t, std::abs(slides[i].drag.x()), false});
    plot.predicted.push_back({t, std::abs(told.drag[i]), false});
  }
  return plot;
}

}  // namespace

Result frictionResult(const FeltSamples& felt, const Origin& origin) {
  const std::vector<calibration::SlideSample> fitted = slidesOf(toFit(felt)),
                                              judged = slidesOf(toJudge(felt));
  const calibration::SurfaceFriction found = calibration::identifySurfaceFriction(fitted, felt.dt);
  const Prediction told = predict(found.law, slidesOf(felt), fitted.size(), felt.dt);
  Result r;
  r.title = "Friction of the sample";
  r.file = begun(origin, station::CalibrationKind::friction, kFrictionGoodFor_days);
  r.file.parameters = {
      {"mu", {found.law.mu}}, {"sigma_N_per_m", {found.law.sigma}}, {"B_Ns_per_m", {found.law.B}}};
  r.file.coordinates = {"mu", "sigma_N_per_m", "B_Ns_per_m"};
  r.file.covariance = found.covariance;
  r.file.residuals = {"N", found.rms, {}, {}};
  r.file.checks = {
      {"friction not explained in strokes not used", told.off_percent, kRubbedOff_percent, "%"}};
  r.file.data.samples = static_cast<int>(felt.samples.size());
  r.file.data.used = static_cast<int>(fitted.size()) - found.fit.outliers();
  r.file.verdict = verdictOf(r.file.checks);
  r.sentences = {"It rubs with " + quantity(found.law.mu, "") +
                 " of what presses on it, and begins to slide after " +
                 quantity(1e3 * found.law.mu / found.law.sigma, "mm") + " where 1 N presses."};
  if (!found.advice.empty()) r.advice.push_back(found.advice);
  r.advice.push_back("Powder and gel change it: redo it with what will be on the sample.");
  r.plots.push_back(dragOverTime(judged, told, felt.dt));
  return r;
}

}  // namespace palpa::calibrate

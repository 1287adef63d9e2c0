#include <algorithm>
#include <cmath>

#include "apps/calibrate/results.h"

namespace palpa::calibrate {
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
/// foretells along x from `from` on, and how much it errs there beyond the noise, in percent of the
/// rms drag.
struct Foretold {
  std::vector<double> drag;
  double off_percent = 0;
};
Foretold foretell(const haptics::Dahl& law, const std::vector<calibration::SlideSample>& slides,
                  std::size_t from, double dt) {
  Foretold told;
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
Plot dragOverTime(const std::vector<calibration::SlideSample>& slides, const Foretold& told,
                  double dt) {
  Plot plot{"Friction while stroking", "s", "N", {}};
  const std::size_t every = std::max<std::size_t>(1, slides.size() / kShownSlides);
  for (std::size_t i = 0; i < slides.size(); i += every) {
    const double t = dt * static_cast<double>(i);
    plot.dots.push_back({t, std::abs(slides[i].drag.x()), false});
    plot.foretold.push_back({t, std::abs(told.drag[i]), false});
  }
  return plot;
}

}  // namespace

Result frictionResult(const FeltSamples& felt, const Origin& origin) {
  const std::vector<calibration::SlideSample> fitted = slidesOf(toFit(felt)),
                                              judged = slidesOf(toJudge(felt));
  const calibration::SurfaceFriction found = calibration::identifySurfaceFriction(fitted, felt.dt);
  const Foretold told = foretell(found.law, slidesOf(felt), fitted.size(), felt.dt);
  Result r;
  r.title = "Friction of the sample";
  r.file = begun(origin, "friction", kFrictionGoodFor_days);
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

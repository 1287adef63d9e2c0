#include <cmath>

#include "apps/calibrate/results.h"
#include "haptics/modulation/virtual_inclusion.h"

namespace palpa::calibrate {
namespace {

constexpr int kInclusionGoodFor_days = 365;
constexpr double kLumpOff_percent = 12;
constexpr double kLeastPressed_N = 0.1;
constexpr std::size_t kShownTouches = 500;

/// Presses of the sample with the lump as they would be rendered on the one without: how much that
/// errs, in percent of the force, and what not rendering would err.
struct Rendered {
  double off_percent = 0, unrendered_percent = 0;
  MeasuredPlot plot{"Presses beside the lump, at a place not used", "s", "N", {}};
};
Rendered render(const haptics::VirtualInclusion& lump, const calibration::SoftContact& without,
                const LumpSamples& samples, double tip_radius) {
  Rendered r;
  haptics::InclusionState state;
  double off = 0, none = 0, all = 0;
  const std::vector<calibration::LumpSample> touches = lumpTouchesOf(samples.check);
  const std::size_t every = std::max<std::size_t>(1, touches.size() / kShownTouches);
  for (std::size_t i = 0; i < touches.size(); ++i) {
    const calibration::LumpSample& s = touches[i];
    const Vec3 plain = haptics::forceOf(without.law, s.x - without.x0, s.rate) * s.n;
    const bool touching = s.x > without.x0;
    const haptics::InclusionAnswer answer = haptics::feelInclusion(
        lump, Vec3(0, 0, -samples.depth),
        {{{touching, s.p, s.n, std::max(s.x, 0.0), tip_radius}, {}}}, samples.check.dt, &state);
    const Vec3 both = plain + answer.f_T[0];
    if (i % every == 0) {
      const double t = samples.check.dt * static_cast<double>(i);
      r.plot.dots.push_back({t, std::max(s.f_r.z(), 0.0), false});
      r.plot.predicted.push_back({t, std::max(both.z(), 0.0), false});
    }
    if (s.f_r.norm() < kLeastPressed_N) continue;
    off += std::pow(both.z() - s.f_r.z(),
                    2);  // friction of a press that is not quite straight is no matter of the lump
    none += std::pow(plain.z() - s.f_r.z(), 2);
    all += s.f_r.z() * s.f_r.z();
  }
  r.off_percent = all > 0 ? 100 * std::sqrt(off / all) : 100;
  r.unrendered_percent = all > 0 ? 100 * std::sqrt(none / all) : 0;
  return r;
}

void addLaw(station::CalibrationFile& file, const std::string& name,
            const haptics::HuntCrossley& law) {
  file.parameters.push_back({name + "_k_N_per_m_to_the_m", {law.k}});
  file.parameters.push_back({name + "_b_Ns_per_m_to_the_m_plus_1", {law.b}});
  file.parameters.push_back({name + "_m", {law.m}});
}

}  // namespace

Result inclusionResult(const LumpSamples& samples, double tip_radius, const Origin& origin) {
  const calibration::SoftContact without =
      calibration::identifySoftContact(pressesOf(samples.without));
  const haptics::Dahl friction =
      samples.strokes.samples.empty()
          ? haptics::Dahl{}
          : calibration::identifySurfaceFriction(slidesOf(samples.strokes), samples.strokes.dt).law;
  std::vector<calibration::LumpSample> touches = lumpTouchesOf(samples.above);
  for (const FeltSamples& felt : samples.beside) {
    const std::vector<calibration::LumpSample> more = lumpTouchesOf(felt);
    touches.insert(touches.end(), more.begin(), more.end());
  }
  const calibration::LumpContact found = calibration::identifyLump(
      touches, without, friction, Vec3(0, 0, -samples.depth), tip_radius, samples.above.dt);
  const haptics::VirtualInclusion lump{found.l0, found.H_T, found.G};
  Rendered judged = render(lump, without, samples, tip_radius);
  Result r;
  r.title = "The lump";
  r.file = begun(origin, station::CalibrationKind::inclusion, kInclusionGoodFor_days);
  addLaw(r.file, "H_T", found.H_T);
  addLaw(r.file, "G_x", found.G[0]);
  addLaw(r.file, "G_y", found.G[1]);
  addLaw(r.file, "G_z", found.G[2]);
  r.file.parameters.push_back({"l0_m", {found.l0}});
  r.file.parameters.push_back({"depth_m", {samples.depth}});
  r.file.parameters.push_back({"contrast_percent", {judged.unrendered_percent}});
  r.file.covariance.resize(0, 0);
  r.file.residuals = {"1", found.relative_rms, {}, {}};
  r.file.checks = {{"force not explained in presses at a place not used", judged.off_percent,
                    kLumpOff_percent, "%"}};
  r.file.data.samples = r.file.data.used =
      static_cast<int>(touches.size() + samples.without.samples.size());
  r.file.verdict = verdictOf(r.file.checks);
  r.sentences = {"Beside the lump, a press is felt " + quantity(judged.unrendered_percent, "%") +
                 " other than without it; with the lump rendered it errs by " +
                 quantity(judged.off_percent, "%") + "; fingers tell about 7 %."};
  if (!found.advice.empty()) r.advice.push_back(found.advice);
  r.plots.push_back(std::move(judged.plot));
  return r;
}

}  // namespace palpa::calibrate

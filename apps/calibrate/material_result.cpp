#include <algorithm>
#include <cmath>

#include "apps/calibrate/results.h"

namespace palpa::calibrate {
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

Plot forceOverDepth(const calibration::SoftContact& found,
                    const std::vector<calibration::PressSample>& presses) {
  Plot plot{"Force over depth", "depth, mm", "N", {}};
  double deepest = 0;
  const std::size_t every = std::max<std::size_t>(1, presses.size() / kShownPresses);
  for (std::size_t i = 0; i < presses.size(); i += every) {
    if (presses[i].f < kLeastFelt_N || presses[i].x < 0) continue;
    plot.dots.push_back({1e3 * presses[i].x, presses[i].f, false});
    deepest = std::max(deepest, presses[i].x);
  }
  for (double x = std::max(found.x0, 0.0); x < deepest; x += deepest / 60)
    plot.foretold.push_back(
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
  r.file = begun(origin, "material", kMaterialGoodFor_days);
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

}  // namespace palpa::calibrate

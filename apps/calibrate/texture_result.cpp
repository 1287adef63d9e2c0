#include <algorithm>
#include <cmath>

#include "anatomy/base/error.h"
#include "apps/calibrate/recorded.h"
#include "apps/calibrate/results.h"
#include "calibration/touch/third_octave.h"

namespace palpa::calibrate {
namespace {

constexpr int kTextureGoodFor_days = 365;
/// A third octave of 10 s scatters by 0.6 dB at 20 Hz, and people notice 1 to 2 dB of a vibration.
constexpr double kTextureOff_dB = 1.5;
constexpr double kLeastChecked_s = 5;

std::vector<double> shakingOf(const calibration::TextureStroke& stroke) {
  std::vector<double> shaking;
  for (const calibration::TextureSample& s : stroke) shaking.push_back(s.shake);
  return shaking;
}

/// Rendered at the forces and speeds of strokes that were not used.
struct TextureJudgement {
  double rms_dB = 0, worst_dB = 0, worst_Hz = 0;
  MeasuredPlot plot{"Third octaves of a stroke not used, in dB above 0.1 mN rms", "Hz", "dB", {}};
};
double aboveTenthMillinewton(double power) { return 10 * std::log10(std::max(power / 1e-8, 1.0)); }

TextureJudgement judgeTexture(const haptics::TextureLaw& law, const TextureSamples& samples) {
  TextureJudgement judged;
  double squares = 0;
  int bands = 0;
  for (const calibration::TextureStroke& stroke : samples.check) {
    if (samples.dt * static_cast<double>(stroke.size()) < kLeastChecked_s) continue;
    const auto recorded = calibration::thirdOctavePowers(shakingOf(stroke), 1 / samples.dt),
               rendered = calibration::thirdOctavePowers(
                   calibration::renderedTexture(law, stroke, samples.dt), 1 / samples.dt);
    const auto off = calibration::levelDifference(rendered, recorded);
    for (std::size_t i = 0; i < off.size(); ++i) {
      squares += off[i] * off[i];
      if (bands < calibration::kThirdOctaves) {
        const double number = static_cast<double>(i + 1);
        const double centre_Hz = calibration::thirdOctaveCentre(static_cast<int>(i));
        if (i % 3 == 0)
          judged.plot.marks.emplace_back(number, std::to_string(std::lround(centre_Hz)));
        judged.plot.dots.push_back({number, aboveTenthMillinewton(recorded[i]), false});
        judged.plot.predicted.push_back({number, aboveTenthMillinewton(rendered[i]), false});
      }
      ++bands;
      if (std::abs(off[i]) <= std::abs(judged.worst_dB)) continue;
      judged.worst_dB = off[i];
      judged.worst_Hz = calibration::thirdOctaveCentre(static_cast<int>(i));
    }
  }
  if (bands == 0)
    throw Error("no stroke to check by is 5 s long", "texture identification",
                "Record strokes at other forces and speeds, and give them with --check");
  judged.rms_dB = std::sqrt(squares / bands);
  return judged;
}

void addTexture(station::CalibrationFile& file, const calibration::TextureModel& found) {
  const haptics::TextureLaw& law = found.law;
  std::vector<double> forces, speeds, rms, reflection;
  for (std::size_t f = 0; f < law.forces; ++f) forces.push_back(std::exp(law.ln_force[f]));
  for (std::size_t v = 0; v < law.speeds; ++v) speeds.push_back(std::exp(law.ln_speed[v]));
  for (std::size_t f = 0; f < law.forces; ++f)
    for (std::size_t v = 0; v < law.speeds; ++v) {
      const haptics::TextureNode& node = law.nodes[f][v];
      rms.push_back(std::exp(node.ln_rms));
      for (std::size_t i = 0; i < law.order; ++i) reflection.push_back(node.reflection[i]);
    }
  file.parameters = {{"forces_N", forces},
                     {"speeds_m_per_s", speeds},
                     {"order", {static_cast<double>(law.order)}},
                     {"leaky_sum_rms_N", rms},
                     {"reflection", reflection}};
}

double strongestOf(const haptics::TextureLaw& law) {
  double most = 0;
  for (std::size_t f = 0; f < law.forces; ++f)
    for (std::size_t v = 0; v < law.speeds; ++v)
      most = std::max(most, haptics::textureRms(law.nodes[f][v]));
  return most;
}

}  // namespace

Result textureResult(const TextureSamples& samples, const Origin& origin) {
  const calibration::TextureModel found =
      calibration::identifyTexture(samples.strokes, samples.dt, samples.grid);
  TextureJudgement judged = judgeTexture(found.law, samples);
  Result r;
  r.title = "The texture";
  r.file = begun(origin, station::CalibrationKind::texture, kTextureGoodFor_days);
  addTexture(r.file, found);
  r.file.parameters.push_back({"tool_mass_kg", {samples.tool_mass}});
  r.file.parameters.push_back({"strongest_rms_N", {strongestOf(found.law)}});
  r.file.covariance.resize(0, 0);
  r.file.residuals = {"dB", found.level_sd_dB, {}, {}};
  r.file.checks = {
      {"third octaves of strokes not used, rms over bands", judged.rms_dB, kTextureOff_dB, "dB"}};
  std::size_t count = 0;
  for (const calibration::TextureStroke& stroke : samples.strokes) count += stroke.size();
  r.file.data.samples = static_cast<int>(count);
  for (const double seconds : found.seconds)
    r.file.data.used += static_cast<int>(seconds / samples.dt);
  r.file.verdict = verdictOf(r.file.checks);
  r.sentences = {
      "It shakes the tool with up to " + quantity(strongestOf(found.law), "N") + " rms; " +
          std::to_string(found.law.order) + " poles at each force and speed describe it.",
      "Between the forces and speeds that were used, third octaves are off by " +
          quantity(judged.rms_dB, "dB") + " (rms), at worst by " + quantity(judged.worst_dB, "dB") +
          " at " + quantity(judged.worst_Hz, "Hz") + "; a node's level is known to " +
          quantity(found.level_sd_dB, "dB") + ", its lowest third octave to " +
          quantity(found.lowest_band_sd_dB, "dB") + "."};
  if (!found.advice.empty()) r.advice.push_back(found.advice);
  r.advice.emplace_back("It is of one tool: a heavier one, or another tip, is shaken otherwise.");
  r.plots.push_back(std::move(judged.plot));
  return r;
}

std::vector<calibration::TextureStroke> readTextureStrokes(const std::filesystem::path& file,
                                                           double tool_mass, double* dt) {
  const SampleTable table(file);
  if (table.rows() < 2)
    throw Error("holds fewer than two samples", file.string(), "Record for longer");
  *dt = 1e-4 * std::round(1e4 * (table.number(1, "t_s") - table.number(0, "t_s")));
  if (!(*dt > 0)) throw Error("has times that do not rise", file.string(), "Give t_s in seconds");
  const bool in_mm = table.has("speed_mm_per_s");
  std::vector<calibration::TextureStroke> strokes(1);
  for (std::size_t i = 0; i < table.rows(); ++i) {
    const double step = i > 0 ? table.number(i, "t_s") - table.number(i - 1, "t_s") : *dt;
    if (std::abs(step - *dt) > 0.5 * *dt) strokes.emplace_back();  // a gap: another stroke begins
    const double speed =
        in_mm ? 1e-3 * table.number(i, "speed_mm_per_s") : table.number(i, "speed_m_per_s");
    strokes.back().push_back({table.number(i, "force_N"), std::abs(speed),
                              tool_mass * table.number(i, "acceleration_m_per_s2")});
  }
  return strokes;
}

}  // namespace palpa::calibrate

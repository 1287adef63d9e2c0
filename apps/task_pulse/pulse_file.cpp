#include "apps/task_pulse/pulse_file.h"

#include <algorithm>
#include <cmath>

#include <nlohmann/json.hpp>

#include "anatomy/base/error.h"
#include "anatomy/base/file_schema.h"
#include "anatomy/base/json_text.h"
#include "anatomy/base/units.h"
#include "apps/training/engine.h"

namespace palpa::task_pulse {
namespace {

using assess::PulseRhythm;
using haptics::PulseBump;
using haptics::PulseWave;

constexpr std::array<const char*, haptics::kMostVessels> kVessels{"radial", "carotid", "femoral"};
constexpr std::array<PulseRhythm, 3> kRhythms{PulseRhythm::regular, PulseRhythm::premature,
                                              PulseRhythm::irregular};
constexpr double kMs = 1e-3;

PulseBump bumpIn(const JsonFile& file, const std::string& place) {
  constexpr double kLongest_ms = 700;  // four beats hold all that still goes on
  const std::vector<double> v = file.numbers(place);
  if (v.size() != 4 || !(v[0] >= 0 && v[0] < v[1] && v[1] < v[2] && v[2] <= kLongest_ms) ||
      !(v[3] > 0 && v[3] <= 2))
    file.refuse(place,
                "must hold four numbers: rising milliseconds of start, peak and end, 0 to 700, and "
                "a height, above 0 to 2");
  return {kMs * v[0], kMs * v[1], kMs * v[2], v[3]};
}

/// Its largest value becomes 1.
PulseWave waveIn(const JsonFile& file, const std::string& artery) {
  PulseWave wave;
  wave.bumps = {bumpIn(file, artery + "/ejection"), bumpIn(file, artery + "/reflection"),
                bumpIn(file, artery + "/valve")};
  double largest = 0;
  for (int ms = 0; ms < 700; ++ms) largest = std::max(largest, haptics::pulseWave(wave, kMs * ms));
  for (PulseBump& bump : wave.bumps) bump.height /= largest;
  return wave;
}

ArteryFigures arteryIn(const JsonFile& file, const char* name) {
  const std::string at = std::string("arteries/") + name + '/';
  ArteryFigures a;
  a.name = name;
  a.spread = kMm * file.number(at + "spread_mm", 0, 30);
  a.turned_sd = kDegree * file.number(at + "turned_sd_deg", 0, 30);
  a.half_length = kMm * file.number(at + "half_length_mm", 1, 100);
  a.depth = kMm * file.number(at + "depth_mm", 0, 40);
  a.depth_sd = kMm * file.number(at + "depth_sd_mm", 0, 20);
  a.least_depth = kMm * file.number(at + "least_depth_mm", 0, 40);
  a.most_depth = kMm * file.number(at + "most_depth_mm", 0, 40);
  if (a.least_depth > a.most_depth)
    file.refuse(at + "least_depth_mm", "must not be above most_depth_mm");
  a.strength_N = file.number(at + "strength_N", 0.01, 2);
  a.best_N = file.number(at + "best_N", 0.1, 5);
  return a;
}

RhythmFigures rhythmIn(const JsonFile& file, PulseRhythm rhythm) {
  const std::string at = "rhythms/" + assess::nameOf(rhythm) + '/';
  RhythmFigures r{file.number(at + "share", 0, 1), file.number(at + "slowest_per_min", 30, 200),
                  file.number(at + "fastest_per_min", 30, 200)};
  if (r.slowest > r.fastest)
    file.refuse(at + "slowest_per_min", "must not be above fastest_per_min");
  return r;
}

HeartFigures heartIn(const JsonFile& file) {
  HeartFigures h;
  h.sdnn_s = kMs * file.number("heart/sdnn_ms", 0, 200);
  h.sdnn_at_s = kMs * file.number("heart/sdnn_at_ms", 300, 2000);
  h.breath_share = file.number("heart/breath_share", 0, 1);
  h.breath_s = file.number("heart/breath_s", 1, 15);
  h.breath_strength = file.number("heart/breath_strength", 0, 0.5);
  h.fewest_between = file.integer("heart/fewest_between", 1, 50);
  h.most_between = file.integer("heart/most_between", 1, 50);
  if (h.fewest_between > h.most_between)
    file.refuse("heart/fewest_between", "must not be above most_between");
  h.coupling = file.number("heart/coupling", 0.45, 0.8);
  h.coupling_sd = file.number("heart/coupling_sd", 0, 0.2);
  h.potentiation = file.number("heart/potentiation", 0, 1);
  h.fibrillation_cv = file.number("heart/fibrillation_cv", 0, 0.5);
  h.shortest_s = kMs * file.number("heart/shortest_ms", 250, 400);
  h.relaxes_s = kMs * file.number("heart/relaxes_ms", 0, 400);
  h.fills_s = kMs * file.number("heart/fills_ms", 10, 1000);
  h.opens_at = file.number("heart/opens_at", 0, 0.9);
  return h;
}

/// The patients' spread: `least` to `most` times the usual.
void spreadIn(const JsonFile& file, const std::string& place, double* least, double* most) {
  *least = file.number(place + "/least", 0.1, 5);
  *most = file.number(place + "/most", 0.1, 5);
  if (*least > *most) file.refuse(place + "/least", "must not be above most");
}

}  // namespace

assess::PulseRules rulesIn(const JsonFile& file) {
  assess::PulseRules rules;
  rules.found_within_m = kMm * file.number("scoring/found_within_mm", 0.5, 50);
  rules.count_within = file.number("scoring/count_within_per_min", 0, 30);
  rules.most_pressed_pct = file.number("scoring/most_shut_pct", 0, 100);
  rules.count_s = file.number("end/count_s", 5, 120);
  rules.time_limit_s = file.number("end/time_limit_s", 10, 3600);
  rules.touch_N = file.number("force/touch_N", 0.02, 5);
  rules.too_hard_N = file.number("force/too_hard_N", 0.1, 50);
  return rules;
}

PulseSettings readPulse(const std::filesystem::path& path) {
  const JsonFile file(path);
  training::needEngine(file, training::Engine::pulse);
  needKind(file, "task_pulse", 1);
  PulseSettings s;
  s.id = file.text("id");
  s.title = file.text("title");
  s.brief = station::briefOf(file);
  s.library = station::readLumps(path.parent_path() / file.text("lumps"));
  s.size =
      kMm * Vec3(file.number("phantom/across_mm", 10, 500), file.number("phantom/away_mm", 10, 500),
                 file.number("phantom/high_mm", 5, 300));
  for (std::size_t i = 0; i < kVessels.size(); ++i) {
    s.arteries[i] = arteryIn(file, kVessels[i]);
    s.law.waves[i] = waveIn(file, std::string("arteries/") + kVessels[i]);
  }
  s.law.contact_radius = kMm * file.number("touch/contact_radius_mm", 1, 20);
  s.law.closed_at = file.number("touch/closed_at", 1.1, 5);
  s.law.light_N = file.number("touch/light_N", 0.01, 1);
  s.law.press_tau = file.number("touch/press_tau_s", 0.01, 5);
  s.law.largest_N = file.number("touch/largest_N", 0.1, 3);
  double shares = 0;
  for (std::size_t i = 0; i < kRhythms.size(); ++i) {
    s.rhythms[i] = rhythmIn(file, kRhythms[i]);
    shares += s.rhythms[i].share;
  }
  if (std::abs(shares - 1) > 1e-9) file.refuse("rhythms", "must have shares that add up to 1");
  s.heart = heartIn(file);
  spreadIn(file, "patients/strength", &s.weakest, &s.strongest);
  spreadIn(file, "patients/pressure", &s.softest, &s.hardest);
  s.rules = rulesIn(file);
  s.taxonomy = station::taxonomyOf(file);
  s.source = file.json().dump();
  return s;
}

namespace {

std::size_t drawnRhythm(const PulseSettings& settings, double u) {
  std::size_t i = 0;
  for (; i + 1 < settings.rhythms.size() && u >= settings.rhythms[i].share; ++i)
    u -= settings.rhythms[i].share;
  return i;
}

}  // namespace

std::vector<PulseCase> casesOf(const PulseSettings& settings, std::uint64_t seed, int count) {
  RandomStream random(seed, "pulse.cases");
  std::vector<PulseCase> all;
  const int first = static_cast<int>(random.uniform() * haptics::kMostVessels);
  for (int n = 0; n < count; ++n) {
    const auto v = static_cast<std::size_t>((first + n) % haptics::kMostVessels);
    const ArteryFigures& figures = settings.arteries[v];
    PulseCase one;
    one.name = figures.name;
    one.artery.vessel = static_cast<std::uint32_t>(v + 1);
    one.artery.p_P = {random.uniform(-figures.spread, figures.spread), 0, 0};
    const double turned = random.normal(0, figures.turned_sd);
    one.artery.a_P = {-pinned::sin(turned), pinned::cos(turned), 0};
    one.artery.half_length = figures.half_length;
    one.artery.depth = std::clamp(random.normal(figures.depth, figures.depth_sd),
                                  figures.least_depth, figures.most_depth);
    one.artery.strength_N =
        figures.strength_N * random.uniform(settings.weakest, settings.strongest);
    one.artery.best_N = figures.best_N * random.uniform(settings.softest, settings.hardest);
    const std::size_t rhythm = drawnRhythm(settings, random.uniform());
    one.rhythm = kRhythms[rhythm];
    one.rate_per_min =
        random.uniform(settings.rhythms[rhythm].slowest, settings.rhythms[rhythm].fastest);
    one.heart_seed = random.bits() >> 12;  // a whole number in JSON, too
    all.push_back(one);
  }
  return all;
}

double besideArtery(const haptics::PulsingArtery& artery, const Vec3& p_P) {
  const Vec3 a = unpack(artery.a_P), from = p_P - unpack(artery.p_P);
  Vec3 off = from - std::clamp(from.dot(a), -artery.half_length, artery.half_length) * a;
  off.z() = 0;
  return off.norm();
}

std::string caseText(const PulseCase& one) {
  return nlohmann::json{{"artery", one.name},
                        {"vessel", one.artery.vessel},
                        {"p_P_m", one.artery.p_P},
                        {"a_P", one.artery.a_P},
                        {"half_length_m", one.artery.half_length},
                        {"depth_m", one.artery.depth},
                        {"strength_N", one.artery.strength_N},
                        {"best_N", one.artery.best_N},
                        {"rhythm", assess::nameOf(one.rhythm)},
                        {"rate_per_min", one.rate_per_min},
                        {"heart_seed", one.heart_seed}}
      .dump();
}

PulseCase caseIn(const std::string& text) {
  std::string why;
  try {
    const nlohmann::json said = parseJson(text);
    PulseCase one;
    one.name = said.at("artery").get<std::string>();
    one.artery.vessel = said.at("vessel").get<std::uint32_t>();
    one.artery.p_P = said.at("p_P_m").get<Packed3>();
    one.artery.a_P = said.at("a_P").get<Packed3>();
    one.artery.half_length = said.at("half_length_m").get<double>();
    one.artery.depth = said.at("depth_m").get<double>();
    one.artery.strength_N = said.at("strength_N").get<double>();
    one.artery.best_N = said.at("best_N").get<double>();
    one.rate_per_min = said.at("rate_per_min").get<double>();
    one.heart_seed = said.at("heart_seed").get<std::uint64_t>();
    const auto rhythm = assess::rhythmNamed(said.at("rhythm").get<std::string>());
    if (rhythm) {
      one.rhythm = *rhythm;
      return one;
    }
    why = "it names no rhythm";
  } catch (const nlohmann::json::exception& e) {
    why = whyNoJson(text, e);
  }
  throw Error("does not describe an artery (" + why + ")", "event \"case\"",
              "Restore the file from a backup");
}

}  // namespace palpa::task_pulse

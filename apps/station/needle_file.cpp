#include "apps/station/needle_file.h"

#include <string>
#include <vector>

#include "apps/station/json_file.h"

namespace palpa::station {
namespace {

constexpr double kPerMm = 1e3;  // 1/mm -> 1/m, N/mm -> N/m

Tissue tissueFromName(const JsonFile& file, const std::string& text) {
  for (int i = 0; i < kTissueCount; ++i)
    if (text == name(static_cast<Tissue>(i))) return static_cast<Tissue>(i);
  file.refuse("layers/" + text, "is not a tissue that is known");
}

haptics::Relaxation readRelaxation(const JsonFile& file, const std::string& at) {
  haptics::Relaxation relaxation;
  for (std::size_t i = 0; i < haptics::Relaxation::kTerms; ++i) {
    const std::string term = std::to_string(i + 1);
    relaxation.g[i] = file.number(at + "/relaxation_share_" + term, 0, 0.5);
    relaxation.tau[i] = 1e-3 * file.number(at + "/relaxation_tau_" + term + "_ms", 1, 60'000);
  }
  return relaxation;
}

void readSkin(const JsonFile& file, haptics::SkinLaw& skin) {
  skin.K_min = kPerMm * file.number("skin/K_min_N_per_mm", 0, 10);
  skin.K_0 = kPerMm * file.number("skin/K_0_N_per_mm", 0, 10);
  skin.m = kPerMm * file.number("skin/m_per_mm", 0, 10);
  skin.u_0 = 1e-3 * file.number("skin/u_0_mm", 0, 10);
  skin.release_tau = 1e-3 * file.number("skin/release_tau_ms", 1, 1000);
  skin.relaxation = readRelaxation(file, "skin");
  skin.friction = file.number("skin/friction", 0, 2);
  skin.shear = kPerMm * file.number("skin/shear_N_per_mm", 0, 10);
}

/// The names in a group of the file: an object of objects.
std::vector<std::string> partsOf(const JsonFile& file, const std::string& group) {
  if (!file.has(group) || !file.json()[group].is_object()) file.refuse(group, "is missing");
  std::vector<std::string> names;
  for (const auto& [part, ignored] : file.json()[group].items()) names.push_back(part);
  return names;
}

void readLayers(const JsonFile& file, haptics::NeedleMaterials& m) {
  for (const std::string& part : partsOf(file, "layers")) tissueFromName(file, part);
  for (int i = 0; i < kTissueCount; ++i) {
    if (static_cast<Tissue>(i) == Tissue::air) continue;
    const std::string at = std::string("layers/") + name(static_cast<Tissue>(i)) + "/";
    haptics::LayerLaw& layer = m.layers[i];
    layer.viscosity = file.number(at + "viscosity_Ns_per_m", 0, 100);
    layer.cutting = file.number(at + "cutting_N", 0, 20);
    layer.friction = kPerMm * file.number(at + "friction_N_per_mm", 0, 1);
  }
}

void readWalls(const JsonFile& file, haptics::NeedleMaterials& m) {
  for (const std::string& part : partsOf(file, "walls"))
    if (organFromName(part.c_str()) == Organ::none)
      file.refuse("walls/" + part, "is not an organ that is known");
  for (const Organ organ : {Organ::fascia, Organ::vein, Organ::artery, Organ::lung}) {
    const std::string at = std::string("walls/") + name(organ);
    m.walls[static_cast<int>(organ)] = {
        kPerMm * file.number(at + "/stiffness_N_per_mm", 0.001, 100),
        file.number(at + "/peak_N", 0, 20), file.number(at + "/peak_spread", 0, 1),
        readRelaxation(file, at)};
  }
}

}  // namespace

NeedleFile readNeedleFile(const std::filesystem::path& path) {
  const JsonFile file(path);
  file.needVersion(1);
  NeedleFile needle;
  haptics::NeedleMaterials& m = needle.materials;
  readSkin(file, m.skin);
  needle.puncture_low_N = file.number("skin/puncture_low_N", 0.01, 30);
  needle.puncture_high_N = file.number("skin/puncture_high_N", 0.01, 30);
  if (needle.puncture_high_N < needle.puncture_low_N)
    file.refuse("skin/puncture_high_N", "is below puncture_low_N");
  m.lateral_stiffness = kPerMm * file.number("hold/lateral_N_per_mm", 0, 10);
  m.lateral_per_depth = 1e6 * file.number("hold/lateral_per_depth_N_per_mm2", 0, 1);
  m.needle_radius = 0.5e-3 * file.number("needle/outer_diameter_mm", 0.1, 10);
  m.needle_length = 1e-3 * file.number("needle/length_mm", 5, 300);
  readLayers(file, m);
  readWalls(file, m);
  return needle;
}

}  // namespace palpa::station

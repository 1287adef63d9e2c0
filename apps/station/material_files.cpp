#include "apps/station/material_files.h"

#include <algorithm>
#include <string>
#include <vector>

#include "anatomy/base/error.h"
#include "anatomy/base/file_schema.h"
#include "anatomy/base/json_file.h"
#include "apps/station/calibration_file.h"

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
  needKind(file, "needle_material", 1);
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

namespace {

struct PowerRange {
  double least, most;
};
constexpr PowerRange kSurfacePower{1, 2}, kBedPower{0.5, 3};

/// A calibration that passed.
CalibrationFile calibrationAt(const JsonFile& list, const std::string& field, CalibrationKind kind,
                              const std::filesystem::path& folder) {
  const std::filesystem::path path = folder / list.text(field);
  CalibrationFile file = readCalibration(path);
  if (file.kind != kind)
    throw Error(
        "is a calibration of \"" + nameOf(file.kind) + "\", not of \"" + nameOf(kind) + "\"",
        path.string(), "See " + list.name() + ", " + field);
  if (!file.passed())
    throw Error("did not pass: " + file.verdict, path.string(),
                "Identify it again: palpa calibrate " + nameOf(kind));
  return file;
}

/// `name` "" or "H_T_".
haptics::HuntCrossley lawAt(const CalibrationFile& file, const std::string& name,
                            const PowerRange& power, const std::string& path) {
  const haptics::HuntCrossley law{file.at(name + "k_N_per_m_to_the_m", 1)[0],
                                  file.at(name + "b_Ns_per_m_to_the_m_plus_1", 1)[0],
                                  file.at(name + "m", 1)[0]};
  const auto refuse = [&](const std::string& what, double value) {
    throw Error("has " + name + what + " = " + std::to_string(value), path,
                "No soft material behaves like that: identify it again");
  };
  if (law.k < 0) refuse("k below zero,", law.k);
  if (law.b < 0) refuse("b below zero,", law.b);
  if (law.m < power.least || law.m > power.most)
    refuse("m that is not within " + std::to_string(power.least).substr(0, 3) + " to " +
               std::to_string(power.most).substr(0, 3) + ",",
           law.m);
  return law;
}

void setSoftness(LumpLibrary& library, const CalibrationFile& file, const std::string& path) {
  library.surface = lawAt(file, "", kSurfacePower, path);
  library.x0 = file.at("x0_m", 1)[0];
}

void setFriction(LumpLibrary& library, const CalibrationFile& file, const std::string& path) {
  library.friction = {file.at("mu", 1)[0], file.at("sigma_N_per_m", 1)[0],
                      file.at("B_Ns_per_m", 1)[0]};
  const haptics::Dahl& law = library.friction;
  if (!(law.mu >= 0 && law.sigma > 0 && law.B >= 0))
    throw Error("has mu or B below zero, or no sigma", path,
                "No surface rubs like that: identify it again");
}

/// A word for one of two grades, from 1.
int gradeAt(const JsonFile& kind, const std::string& field, const std::string& one,
            const std::string& two) {
  const std::string word = kind.text(field);
  if (word != one && word != two)
    kind.refuse(field, "is \"" + word + "\"; known: " + one + ", " + two);
  return word == one ? 1 : 2;
}

LumpKind kindAt(const JsonFile& entry, const std::filesystem::path& folder, bool* simulated) {
  const CalibrationFile file =
      calibrationAt(entry, "identified", CalibrationKind::inclusion, folder);
  const std::string path = (folder / entry.text("identified")).string();
  *simulated = *simulated || file.simulated;
  LumpKind kind;
  kind.name = entry.text("name");
  kind.law.H_T = lawAt(file, "H_T_", kSurfacePower, path);
  kind.law.G = {lawAt(file, "G_x_", kBedPower, path), lawAt(file, "G_y_", kBedPower, path),
                lawAt(file, "G_z_", kBedPower, path)};
  kind.law.l0 = file.at("l0_m", 1)[0];
  kind.depth = file.at("depth_m", 1)[0];
  kind.contrast = 0.01 * file.at("contrast_percent", 1)[0];
  kind.diameter = 1e-3 * entry.number("diameter_mm", 1, 100);
  kind.hardness = gradeAt(entry, "hardness", "soft", "hard");
  kind.mobility = gradeAt(entry, "mobility", "fixed", "mobile");
  if (kind.law.l0 <= 0 || kind.depth <= 0) throw Error("has no depth", path, "Identify it again");
  return kind;
}

}  // namespace

LumpLibrary readLumps(const std::filesystem::path& path) {
  const JsonFile file(path);
  needKind(file, "lumps", 1);
  const std::filesystem::path folder = path.parent_path();
  LumpLibrary library;
  const CalibrationFile surface = calibrationAt(file, "surface", CalibrationKind::material, folder),
                        friction =
                            calibrationAt(file, "friction", CalibrationKind::friction, folder);
  setSoftness(library, surface, (folder / file.text("surface")).string());
  setFriction(library, friction, (folder / file.text("friction")).string());
  library.of_surface = "the library of lumps";
  library.tip_radius = 1e-3 * file.number("tip_radius_mm", 1, 30);
  library.simulated = surface.simulated || friction.simulated;
  if (file.has("texture")) library.texture = readTexture(folder / file.text("texture"));
  for (const JsonFile& entry : file.entries("kinds"))
    library.kinds.push_back(kindAt(entry, folder, &library.simulated));
  if (library.kinds.empty() || library.kinds.size() > haptics::kMostLumpKinds)
    file.refuse("kinds", "must hold 1 to " + std::to_string(haptics::kMostLumpKinds) + " lumps");
  return library;
}

LumpLibrary onStation(LumpLibrary library, const std::vector<AppliedCalibration>& calibrations) {
  std::string shipped = library.of_surface;
  const auto own = [&](CalibrationKind kind, void (*set)(LumpLibrary&, const CalibrationFile&,
                                                         const std::string&)) -> std::string {
    const AppliedCalibration* found = calibrationOf(calibrations, kind);
    if (!found) return shipped;
    set(library, found->file, found->path.string());
    library.simulated = library.simulated || found->file.simulated;
    return "this station's calibration of " + found->file.date.substr(0, 10);
  };
  const std::string softness = own(CalibrationKind::material, setSoftness),
                    friction = own(CalibrationKind::friction, setFriction);
  library.of_surface =
      softness == friction ? softness : "softness: " + softness + "; friction: " + friction;
  return library;
}

std::vector<std::string> surfacesIn(const std::filesystem::path& path) {
  const JsonFile file(path);
  needKind(file, "surfaces", 1);
  std::vector<std::string> names;
  for (const JsonFile& entry : file.entries("surfaces")) names.push_back(entry.text("name"));
  return names;
}

LumpLibrary withSurface(LumpLibrary library, const std::filesystem::path& path,
                        const std::string& name) {
  const JsonFile file(path);
  needKind(file, "surfaces", 1);
  const std::filesystem::path folder = path.parent_path();
  for (const JsonFile& entry : file.entries("surfaces")) {
    if (entry.text("name") != name) continue;
    const CalibrationFile softness =
                              calibrationAt(entry, "material", CalibrationKind::material, folder),
                          friction =
                              calibrationAt(entry, "friction", CalibrationKind::friction, folder);
    setSoftness(library, softness, (folder / entry.text("material")).string());
    setFriction(library, friction, (folder / entry.text("friction")).string());
    library.simulated = library.simulated || softness.simulated || friction.simulated;
    library.of_surface = "\"" + name + "\" as it was identified";
  }
  return library;
}

haptics::TouchAugmentation touchOf(const LumpLibrary& library) {
  haptics::TouchAugmentation touch;
  touch.surface.contact.real = library.surface;
  touch.surface.contact.x0 = library.x0;
  touch.surface.contact.friction = library.friction;
  touch.surface.wanted = library.friction;
  touch.texture = library.texture;
  touch.tip_radius = library.tip_radius;
  if (library.map) touch.map = learntMap(*library.map, touch.surface.contact);
  for (std::size_t i = 0; i < library.kinds.size(); ++i) touch.kinds[i] = library.kinds[i].law;
  return touch;
}

}  // namespace palpa::station

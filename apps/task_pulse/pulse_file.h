#pragma once

#include <array>
#include <filesystem>
#include <string>
#include <vector>

#include "apps/assess/pulse/pulse_trial.h"
#include "apps/station/material_files.h"
#include "apps/station/task_sections.h"
#include "apps/task_pulse/heart.h"
#include "haptics/modulation/pulse.h"

namespace palpa::task_pulse {

/// Of one artery: where it usually lies, and how it feels. Its usual line is y of P through the
/// middle of the phantom's top.
struct ArteryFigures {
  std::string name;                                                 ///< "radial", ...
  double spread = 0, turned_sd = 0, half_length = 0;                ///< m to either side, rad, m
  double depth = 0, depth_sd = 0, least_depth = 0, most_depth = 0;  ///< m
  double strength_N = 0;  ///< of an ordinary beat right below the surface
  double best_N = 0;      ///< pressed so hard it is felt best
};

/// How fast hearts of a rhythm beat, and how many have it.
struct RhythmFigures {
  double share = 0, slowest = 60, fastest = 100;  ///< beats a minute
};

/// A pulse task as its file says it (assets/tasks/pulse.json).
struct PulseSettings {
  std::string id, title, brief;
  station::LumpLibrary library;      ///< its surface is what is pressed
  Vec3 size = Vec3(0.1, 0.1, 0.05);  ///< m, as it is shown
  haptics::PulseLaw law;
  std::array<ArteryFigures, haptics::kMostVessels> arteries;
  std::array<RhythmFigures, 3> rhythms;  ///< by PulseRhythm
  HeartFigures heart;
  /// Times the artery's: strength of a patient's pulse, and the pressure at which it is felt best
  double weakest = 0.7, strongest = 1.5, softest = 0.8, hardest = 1.2;
  assess::PulseRules rules;
  station::Taxonomy taxonomy;
  std::string source;  ///< the file's text, for the evidence
};

/// Throws UsageError naming file and field, Error for a library that cannot be used.
PulseSettings readPulse(const std::filesystem::path& file);
/// What a recorded task says of how its trials are judged, and of its law.
assess::PulseRules rulesIn(const JsonFile& file);

/// A patient of a trial.
struct PulseCase {
  haptics::PulsingArtery artery;  ///< without beats
  std::string name;               ///< the artery's
  assess::PulseRhythm rhythm = assess::PulseRhythm::regular;
  double rate_per_min = 70;
  std::uint64_t heart_seed = 1;
};
/// So many, the same for the same seed: arteries in turn, each patient's rest drawn.
std::vector<PulseCase> casesOf(const PulseSettings& settings, std::uint64_t seed, int count);

/// From an artery's line to a place on the surface, m, across z of P.
double besideArtery(const haptics::PulsingArtery& artery, const Vec3& p_P);

/// A case as its event in the record says it, and read again. Throws Error for words that are none.
std::string caseText(const PulseCase& one);
PulseCase caseIn(const std::string& text);

}  // namespace palpa::task_pulse

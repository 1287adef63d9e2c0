#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "anatomy/base/random.h"
#include "anatomy/parametric/body_part.h"
#include "apps/assess/palpation/palpation_assessment.h"
#include "apps/station/material_files.h"
#include "apps/station/task_sections.h"

namespace palpa::task_palpation {

/// How cases are drawn: how many lumps, where, of which kinds.
struct CaseRules {
  std::vector<double> lumps;       ///< probability of 0, 1, 2, ... lumps
  std::vector<std::size_t> kinds;  ///< of the library, from 0; each equally likely
  double apart = 0, margin = 0;    ///< m, between lumps' middles; from the area's edge
};

/// How a search is judged.
struct Scoring {
  assess::PalpationRules rules;
  assess::PalpationStandard standard;
};
/// Of a task's text alone, without its lumps. Throws UsageError naming the field.
Scoring scoringOf(const JsonFile& task);

/// Of a lump in a case: computed; cast in the phantom, and felt; cast in it, and taken away.
enum class LumpIs : std::uint8_t { computed, cast, taken };

/// A lump at a place: P, m, along the top: below which point of it, and how deep along the normal.
struct LumpInCase {
  std::size_t kind = 0;  ///< of the library, from 0
  Vec3 p_P = Vec3::Zero();
  LumpIs is = LumpIs::computed;
};
using Case = std::vector<LumpInCase>;

/// A lump that lies in the phantom itself: in some cases it is felt, in the others taken away, so
/// that nobody knows beforehand whether it is there.
struct RealLump {
  LumpInCase lump;
  double taken_in = 0.5;  ///< share of the cases
  double share = 1;       ///< of it that is taken; less where the device bears no more
};

/// A palpation task as its file says it (assets/tasks/palpation_*.json). Another phantom, other
/// lumps, other rules need a file, not code.
struct PalpationSettings {
  std::string id, title, brief;
  /// M, of the phantom: across, away from the trainee, high; its top: scoring.rules.area.top
  Vec3 size = Vec3(0.1, 0.1, 0.05);
  std::optional<anatomy::BodyPart> seen_as;  ///< in the large view
  station::LumpLibrary library;
  CaseRules cases;
  Scoring scoring;
  /// Normal anatomy, in pieces, in every case: a library lump at each point of its line (named and
  /// judged by scoring.rules.normal)
  Case anatomy;
  std::optional<RealLump> real;
  /// That deep palpation takes on a patient; where the device gives less, the screen says "scaled
  /// force". 0: nobody has measured it there
  double clinical_force_N = 0;
  double time_limit_s = 300;
  station::Taxonomy taxonomy;
  station::NamedPlan augmentations;  ///< empty: the task has no parts
  std::string source;                ///< the file's text, for the evidence
};

/// Throws UsageError naming file and field, Error for a library that cannot be used or a lump that
/// would stick out of the phantom.
PalpationSettings readPalpation(const std::filesystem::path& file);

/// The same for the same seed.
Case drawCase(const PalpationSettings& settings, std::uint64_t seed);
/// So many lumps, drawn by the rules. Throws Error where they find no room.
Case placeLumps(const PalpationSettings& settings, std::size_t count, RandomStream& random);
/// Those that are felt.
std::vector<assess::CaseLump> lumpsOf(const Case& in_case, const station::LumpLibrary& library);
/// What the loop adds, and, `share` of it, what it takes away. Together they are no more than
/// haptics::kMostLumps. `top`: below which they lie.
haptics::PlacedLumps placed(const Case& in_case, const Case& anatomy, double share = 1,
                            const TopShape& top = {});
bool takesAway(const Case& in_case);
/// Without force feedback a real lump is felt in every case.
Case withoutForce(Case in_case);

}  // namespace palpa::task_palpation

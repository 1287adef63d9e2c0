#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "anatomy/geometry/pose.h"
#include "apps/assess/palpation/coverage_map.h"
#include "apps/assess/palpation/search_pattern.h"

namespace palpa::assess {

/// Something that belongs there and is felt in every case, such as the edge of a liver: a line
/// along the top, as broad as `width`. P, m. It is no lump, and is not to be marked.
struct NormalAnatomy {
  std::string name;
  std::vector<Vec3> line_P;
  double width = 0;
};

/// m along the top from the middle of the line; infinite where it has no points.
double fromLine(const NormalAnatomy& anatomy, const Vec3& p_P);

/// What a place lies on, to within `reach` of its breadth; nullptr: on nothing of it.
const NormalAnatomy* anatomyAt(const std::vector<NormalAnatomy>& all, const Vec3& p_P,
                               double reach);

struct PalpationRules {
  SearchArea area;
  PressureLevels levels{0.3, 0.7, 1.2};  ///< N
  double reach = 6e-3;                   ///< m about the tip's middle that a press tells of
  double touch = 0.1;                    ///< N
  double too_hard = 2.5;                 ///< N
  double found_within = 15e-3;           ///< m, of a lump's middle
  std::vector<NormalAnatomy> normal;     ///< what is felt besides lumps
};

/// What became of one lump of the case.
struct LumpVerdict {
  int mark = -1;          ///< the mark that found it, from 0; -1: missed
  double error = 0;       ///< m, between mark and lump along the top
  double size_error = 0;  ///< m, graded less true; 0 where it was not graded
  bool hardness_right = false, mobility_right = false;
};

struct PalpationScore {
  std::vector<LumpVerdict> lumps;
  int found = 0, missed = 0;
  int false_alarms = 0;  ///< marks that are no lump's
  int repeated = 0;      ///< marks of a lump that had been found
  /// Quarters of the area with no lump within `found_within`; those among them that a false alarm
  /// calls ill
  int clear_quadrants = 0, wrong_quadrants = 0;
  int ill_quadrants = 0, hit_quadrants = 0;        ///< with a lump in them; with one that was found
  std::array<double, kPressureLevels> coverage{};  ///< share felt at each level or deeper
  double twice = 0;                                ///< share felt again
  SearchedPattern pattern;
  double peak = 0, mean = 0;           ///< N, while touching
  double too_light = 0, too_hard = 0;  ///< share of the time of touching
  double seconds = 0;
  int presses = 0;
  /// mean peak of palpating presses over that of searching ones; 0: one of them is missing
  double closer_force = 0;
  int of_normal = 0;  ///< false alarms that lie on normal anatomy

  double sensitivity() const {
    return found + missed > 0 ? static_cast<double>(found) / (found + missed) : 1;
  }
  double specificity() const {
    return clear_quadrants > 0 ? 1 - static_cast<double>(wrong_quadrants) / clear_quadrants : 1;
  }
};

/// Marks are given to the lumps they are nearest to, the nearest pair first, each lump one mark.
PalpationScore scorePalpation(const PalpationRules& rules, const std::vector<CaseLump>& lumps,
                              PalpationSamples samples, const std::vector<LumpMark>& marks);

/// What became of a mark: it found a lump, it said again what had been said, or there was nothing.
enum class MarkMeaning { found, repeated, false_alarm };

/// Of mark `mark` (from 0) of a search that has been scored. The counts of the score are the counts
/// of these.
MarkMeaning meaningOf(std::size_t mark, const PalpationRules& rules, const PalpationScore& score,
                      const std::vector<CaseLump>& lumps, const std::vector<LumpMark>& marks);

}  // namespace palpa::assess

#pragma once

#include <array>
#include <span>
#include <string>
#include <vector>

#include "apps/assess/palpation/search_area.h"

/// What a palpation is judged by: everything in the frame P of the thing that is felt (origin in
/// the middle of its top, x to the right, y away from the trainee, z up), metres, newtons. On a
/// curved top places lie along it: x and y of the nearest point of the top, z how far over it.
namespace palpa::assess {

/// One tick of the record, thinned to about 100 Hz.
struct PalpationSample {
  double t_s = 0;
  Vec3 p_P = Vec3::Zero();  ///< the tip's lowest point
  double f_n = 0;           ///< how hard it is pressed
  int tool = 0;             ///< 0: the first; 1: another finger's
};
using PalpationSamples = std::span<const PalpationSample>;
/// Those of one of two tools.
std::vector<PalpationSample> ofTool(PalpationSamples samples, int tool);

/// "Here is one": where the trainee said so, and how it was graded (0: not graded).
struct LumpMark {
  double t_s = 0;
  Vec3 p_P = Vec3::Zero();
  double diameter = 0;             ///< m
  int hardness = 0, mobility = 0;  ///< 1 soft, 2 hard; 1 fixed, 2 mobile
};

/// A lump of the case. Known to who judges, not to who is judged.
struct CaseLump {
  Vec3 p_P = Vec3::Zero();
  double diameter = 0;  ///< m
  int hardness = 0, mobility = 0;
};

/// Light, medium, deep: from how many newtons on a press counts as such.
inline constexpr std::size_t kPressureLevels = 3;
using PressureLevels = std::array<double, kPressureLevels>;

}  // namespace palpa::assess

#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "anatomy/geometry/pose.h"

namespace palpa::calibration {

/// The line that is taught on one body, in landmark coordinates L (medial, posterior, cephalad; the
/// same numbers on both sides), metres: in through the skin at the entry point along its normal,
/// then turned toward the middle of the vein.
struct TeachingLine {
  Vec3 entry_L = Vec3::Zero();
  Vec3 inward_L = Vec3::UnitY();  ///< unit, into the body along the skin's normal at the entry
  Vec3 target_L = Vec3::Zero();
};

/// Axes about the way that is left to the vein with the tip `depth` metres under the entry, as
/// columns in L: along the way; across it, inward; across both, cephalad. In these axes what is
/// taught is the same on every body, whatever its build. Throws Error where the way is shorter than
/// 5 mm or runs within 2 degrees of the normal.
Mat3 axesOf(const TeachingLine& line, double depth = 0);

/// One expert trial, in side-free landmark coordinates (medial, posterior, cephalad), metres.
struct ExpertTrial {
  TeachingLine line;                 ///< of the body that it was performed on
  Vec3 entry_L = Vec3::Zero();       ///< where the skin was punctured
  double depth = 0;                  ///< reached in phase 1, before the needle was turned
  Vec3 direction_L = Vec3::UnitX();  ///< unit, when phase 2's advance began
  Vec3 start_L = Vec3::Zero();       ///< of the tip, when phase 2's advance began ...
  Vec3 end_L = Vec3::Zero();         ///< ... and where it was in the vein last
  std::string expert;                ///< pseudonym
};

/// What is taught on one body, in L, metres: what a trial on that body is compared with. `*_sd` and
/// `*_acceptable`: see ExpertPath.
struct TaughtPath {
  Vec3 entry_L = Vec3::Zero();
  double entry_sd = 0, entry_acceptable = 0;
  double depth = 0, depth_acceptable = 0;
  Vec3 direction_L = Vec3::UnitX();
  double direction_sd = 0, direction_acceptable = 0;
  Vec3 line_from_L = Vec3::Zero(), line_to_L = Vec3::Zero();
  double line_acceptable = 0;
};

/// In which axes the vectors of an expert path are.
enum class PathAxes {
  /// L, of an average body: one path for every patient, as in Tzafestas et al. 2008. Files of
  /// version 1.
  landmarks,
  /// Of each body's own teaching line: places as distances from its entry point, the end from its
  /// vein, in axesOf(line); the direction in axesOf(line, depth)
  own_line
};

/// Mean and acceptable deviation of the expert path (after Tzafestas et al. 2008, section 3.1).
struct ExpertPath {
  PathAxes axes = PathAxes::own_line;
  bool simulated = false;
  int trials = 0;    ///< used
  int left_out = 0;  ///< outliers
  std::vector<std::string> experts;
  Vec3 entry = Vec3::Zero();
  double entry_sd = 0;             ///< rms distance from the mean / sqrt 2 (in the skin), m
  double depth = 0, depth_sd = 0;  ///< m
  Vec3 direction = Vec3::UnitX();
  double direction_sd = 0;          ///< rad, rms angle from the mean / sqrt 2
  Vec3 line_from = Vec3::Zero();    ///< optimal line of phase 2: where the tip starts ...
  Vec3 line_to = Vec3::Zero();      ///< ... and where it ends (mean end of the tip)
  double line_sd = 0;               ///< rms distance of start and end from that line / sqrt 2, m
  double direction_acceptable = 0;  ///< rad: PHASE_2 is 1000 here
  /// m; 0: not known, in files of version 1
  double entry_acceptable = 0, depth_acceptable = 0, line_acceptable = 0;
  std::string made_by;  ///< the command that remakes the file
  std::string source;   ///< the file's text, for the evidence; empty where there is none

  /// The path on a body with this line; of axes `landmarks` the same on every body. Throws Error as
  /// axesOf.
  TaughtPath onBody(const TeachingLine& line) const;
};

/// Fits the expert path about each trial's own teaching line. With the component-wise median as
/// centre and r a trial's distance from it, a trial is left out (and counted) when, in any of
/// entry, direction, start or end of the line,
///   r > 3 median(r)                      0.2 % of a two-dimensional normal distribution
/// or in depth |d - median| > 3 x 1.4826 median |d - median|     0.3 % of a normal one;
/// deviations below 0.5 mm or 0.5 degrees are never outliers. Of the rest: mean, spherical mean of
/// the directions. Acceptable deviations: 2 sd; of the direction at least 2 degrees, of the others
/// at least 1 mm. Throws Error, with words, when a trial is not finite or has no path; fewer than
/// `least` trials remain; more than a fifth, or more than half of one expert's trials, would be
/// left out (a different technique is no outlier); or the spread is so large that there is no
/// common path: sd of direction above 10 degrees, of entry or depth above 10 mm.
ExpertPath fitExpertPath(const std::vector<ExpertTrial>& trials, int least = 20);

/// JSON, millimetres and degrees inside, named so. Throws Error naming file and field when one is
/// missing, not finite or out of range, or when the file is from a newer version.
ExpertPath readExpertPath(const std::filesystem::path& file);
/// The same from the file's text, as a recording holds it; `where` instead of the file's name.
ExpertPath parseExpertPath(std::string_view text, const std::string& where);

/// Writes beside the file, then renames: never half a file. Throws Error.
void writeExpertPath(const ExpertPath& path, const std::filesystem::path& file);

}  // namespace palpa::calibration

#pragma once

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "anatomy/patient.h"
#include "anatomy/query/section.h"
#include "apps/assess/needle/trial_assessment.h"
#include "calibration/expert_path.h"

namespace palpa::assess {

/// Where an organ's name stands in a picture of it, (u, v), m: its middle.
struct OrganName {
  Organ organ = Organ::none;
  Eigen::Vector2d at{0, 0};
};

/// A plane through what a needle is aimed at, what it cuts there, and how much of it is shown.
struct NeedleView {
  const char *title = "", *across = "",
             *up = "";  ///< in words: whence it is seen, whither its axes
  anatomy::SectionPlane plane;
  Eigen::Vector2d low{0, 0}, high{0, 0};       ///< the corners that are shown, (u, v), m
  std::vector<anatomy::SectionLine> cut = {};  ///< no more than reaches into what is shown
  /// Each organ once, but the skin: in the widest place of the first of its lines, or below one
  /// that is too small.
  std::vector<OrganName> names = {};
};

/// Where a trial's needle went, as a teacher would draw it on the board: from in front, from the
/// side, and as the needle sees it.
struct NeedleViews {
  /// From in front, at the taught entry: up toward the head; the bones are cut at the depth
  /// of the clavicle's axis.
  NeedleView skin;
  /// Through the taught way to the vein and straight back from the entry: across along the way, up
  /// toward the front.
  NeedleView way;
  /// Square to the taught direction, at the vein, as whoever looks along the needle sees it: up
  /// toward the front.
  NeedleView vein;
  Vec3 entry_A = Vec3::Zero(), target_A = Vec3::Zero();  ///< taught; of the vein its middle line
  double entry_acceptable = 0;                           ///< m, by which experts vary; 0: not known
};

/// On this patient. Throws Error where a landmark is missing.
NeedleViews needleViewsOf(const anatomy::Patient& patient, const calibration::TaughtPath& path);

/// One pass of the needle through the skin.
struct NeedleTrack {
  Vec3 puncture_A = Vec3::Zero();
  std::vector<Vec3> tips_A;  ///< while inside
  TrialSample deepest;       ///< where the tip was deepest under the skin
};

/// So much of the needle is drawn behind its tip, m.
inline constexpr double kShownShaft = 0.075;

/// Every pass, in order; any sampling rate from about 20 Hz.
std::vector<NeedleTrack> needleTracks(const std::vector<TrialSample>& samples);

/// Where the needle's line meets a plane, (u, v), m: what it was aimed at. None where it runs
/// within 10 degrees of the plane, or away from it by more than 50 mm.
std::optional<Eigen::Vector2d> aimOf(const TrialSample& needle, const anatomy::SectionPlane& plane);

}  // namespace palpa::assess

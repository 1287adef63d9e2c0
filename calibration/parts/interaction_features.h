#pragma once

#include <Eigen/Core>
#include <vector>

#include "anatomy/geometry/pose.h"

/// What a hand did with a tool, as position, velocity and force over time tell it: the profiles by
/// which interactive procedures are recognised (interactive_procedures.h). Nothing is taken from
/// what the task knows (its parts, its phase, tissue, bone, floor): the same features are there of
/// any recording. Source of the idea: Edmunds and Pai, Perceptually augmented simulator design
/// (2012), section 5.
namespace palpa::calibration {

inline constexpr double kInteractionStep_s = 0.010;

/// Of one step of 10 ms: means over its ticks. In D, SI units.
struct ToolStep {
  Vec3 p_DT = Vec3::Zero();
  Vec3 axis_D = Vec3::UnitZ();  ///< unit: along the tool, toward its tip
  Vec3 f_D = Vec3::Zero();      ///< N, of the thing on the tool
  double shaking = 0;           ///< N, root mean square of the force above 20 Hz: no hand does it
  double buzzing = 0;           ///< N, above 80 Hz: textures under a tool that moves
  double contact = 0;           ///< share of the step, 0 to 1
  double plunger = 0;           ///< drawn share, 0 to 1
};

/// Logarithms are natural, of SI units. What lies below the least is alike (kLeast...): a hand's
/// tremor, what a fingertip does not tell.
enum InteractionFeature : int {
  kMoveSpeed,     ///< ln of the net speed over 200 ms: tremor (8 to 12 Hz) leaves little of itself
  kWalkSpeed,     ///< ln of the speed by steps of 20 ms, mean over 100 ms: with every jerk
  kStraightness,  ///< net way by way walked over 500 ms, 0 to 1
  kAlongTool,     ///< the net motion's share along the tool: 1 ahead, -1 back, 0 across or at rest
  kAlongForce,    ///< its share along the force: 1 yielding to it, -1 against it (pressing)
  kPushed,        ///< ln of the force, over 100 ms
  kPushedOnTool,  ///< the force's share along the tool: -1 it meets the tip, 0 from the side
  kForceRate,     ///< ln of the net change of the force's size a second, over 200 ms
  kTouching,      ///< share of 200 ms in contact
  kTrembling,     ///< ln of the force's shaking above 20 Hz, over 100 ms
  kBuzzing,       ///< ln of the force's shaking above 80 Hz, over the last 100 ms
  kReversals,     ///< times a second that the motion turned back, over 1 s
  kTurning,       ///< ln of the tool's turning, rad/s, net over 200 ms
  kPlunger,       ///< drawn share
  kWayIn,         ///< ln of the way along the tool since this contact began
  kWayAcross,     ///< ln of the way across it since then
  kInteractionFeatures
};

struct InteractionFeatureName {
  const char* name;   ///< in files, with its unit
  const char* words;  ///< for people
  double unit = 1;    ///< a unit, in SI
  bool logarithm = false;
  /// of the feature: narrower profiles say more of the hand that made them than of what was done
  double least_spread = 0;
};
const InteractionFeatureName& interactionFeatureName(int feature);

/// A row a step, a column a feature. Windows lie about the step, and end where the recording does.
/// A contact ends when nothing has been touched for 300 ms.
Eigen::MatrixXd interactionFeatures(const std::vector<ToolStep>& steps);

}  // namespace palpa::calibration

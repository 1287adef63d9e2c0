#pragma once

#include <vector>

#include "anatomy/geometry/pose.h"

namespace palpa::metrics {

/// One recorded tick of a tool: any rate, any frame that rests with the patient.
struct RawSample {
  double t_s = 0;             ///< rising
  Vec3 tip = Vec3::Zero();    ///< m
  Vec3 axis = Vec3::UnitZ();  ///< unit, along the tool toward the tip
  double inserted = 0;        ///< m of the tool's shaft in tissue; 0: outside
  double force = 0;           ///< N, magnitude
};

/// The same at an even rate: means over steps of 20 ms. A sensor's steps and noise would otherwise
/// add up to metres of path; what a hand does on purpose lies below 2 Hz (98.9 % of its power) and
/// stays as it is.
struct Motion {
  static constexpr double kStep_s = 0.02;
  std::vector<Vec3> tip, axis;
  std::vector<double> inserted, force;
  std::size_t size() const { return tip.size(); }
  double seconds() const { return static_cast<double>(size()) * kStep_s; }
};

/// A step without a sample repeats the one before it. Throws Error for samples that run backward or
/// are not finite.
Motion motionOf(const std::vector<RawSample>& samples);

/// m/s between neighbours, one less than the motion has steps; in rad/s of the axis.
std::vector<double> speedsOf(const Motion& motion);
std::vector<double> turningSpeedsOf(const Motion& motion);

double pathLength(const Motion& motion);  ///< m: sum of the tip's steps

/// Share by which the path is longer than the straight line from its first to its last point:
/// L / d - 1. Not a number where they are less than 10 mm apart: a tool that returns has no line to
/// compare with.
double pathInefficiency(const Motion& motion);

double meanSpeed(const Motion& motion);  ///< m/s: path length over time; not a number without time
double boundingBoxVolume(const Motion& motion);  ///< m^3, along the frame's axes
double rotationTotal(
    const Motion& motion);  ///< rad: sum of the axis' turns; turns about itself are not counted

/// A purposeful movement: the speed stays above the threshold, or below it, for longer than the
/// pause before the state changes. Definition and defaults as in Perk Tutor (PythonMetrics,
/// TranslationalActions and RotationalActions: 50 mm/s, 50 degrees/s, 0.2 s), which count
/// beginnings.
struct ActionRules {
  double speed = 0.050;           ///< m/s
  double turning_speed = 0.8727;  ///< rad/s: 50 degrees/s
  double settle_s = 0.2;
};
int translationalActions(const Motion& motion, const ActionRules& rules = {});
int rotationalActions(const Motion& motion, const ActionRules& rules = {});

/// Smoothness of the speed: minus the arc length of its amplitude spectrum, normalised to its value
/// at 0 Hz, from 0 to the last frequency up to 10 Hz at which it exceeds 0.05; the frequency axis
/// is scaled to that range. 0 would be smoothest; one minimum-jerk movement has about -1.4; does
/// not depend on size or duration. Not a number without motion. Source: Balasubramanian,
/// Melendez-Calderon, Roby-Brami, Burdet, J. NeuroEng. Rehabil. 12:112, 2015.
double spectralArcLength(const Motion& motion);

/// sqrt of the integral of the squared third derivative of the tip's position, in m/s^2.5. As Perk
/// Tutor's motion smoothness; lower is smoother. Grows with noise: compare only on one station.
double integratedJerk(const Motion& motion);

/// How force was used; "in contact": 0.05 N or more.
constexpr double kContactForce_N = 0.05;
double peakForce(const Motion& motion);  ///< N
double meanForce(const Motion& motion);  ///< N, in contact; not a number without contact
double overForceTime(const Motion& motion, double limit_N);  ///< s above the limit
double forceJerk(
    /// N/s: root mean square of the force's rate between neighbouring steps in contact; not a
    /// number without them
    const Motion& motion);

/// What the tool did inside. All 0 where it was never inserted.
double tissueTime(const Motion& motion);  ///< s with any of the shaft inside
/// M of the tip's path while inserted in both of two neighbouring steps
double tissuePath(const Motion& motion);

/// m^2 that the inserted part of the shaft sweeps over: for each step the quadrilateral from
/// (entry, tip) before to (entry, tip) after, as two triangles. A needle that goes straight in
/// sweeps nothing; one that fans about does. After Perk Tutor's tissue damage.
double tissueDamage(const Motion& motion);

/// Times the tool went in, from outside.
int insertions(const Motion& motion);

}  // namespace palpa::metrics

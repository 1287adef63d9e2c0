#pragma once

#include "apps/assess/metrics/motion.h"

namespace palpa::metrics {

double pathLength(const Motion& motion);  ///< m: sum of the tip's steps

/// Share by which the path is longer than the straight line from its first to its last point: L / d
/// - 1. Not a number where they are less than 10 mm apart: a tool that returns has no line to
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

}  // namespace palpa::metrics

#pragma once

#include <vector>

#include "anatomy/geometry/pose.h"
#include "calibration/robust_fit.h"

namespace palpa::calibration {

/// One static reading: the sensor's frame S in the device's base D; force and torque that it shows,
/// in S, N and N m.
struct StaticReading {
  Mat3 R_DS = Mat3::Identity();
  Vec3 f_S = Vec3::Zero(), m_S = Vec3::Zero();
};

/// What the sensor shows without being touched:
///   f_S = bias_f + weight * R_DS' down_D        m_S = bias_m + centre_S x (weight * R_DS' down_D)
struct ForceSensorCalibration {
  Vec3 bias_f = Vec3::Zero(), bias_m = Vec3::Zero();  ///< N, N m
  double mass = 0;                                    ///< kg, of what hangs on the sensor
  Vec3 centre_S = Vec3::Zero();                       ///< its centre of mass, m
  /// (bias_f, bias_m, mass, centre)
  Eigen::Matrix<double, 10, 10> covariance = Eigen::Matrix<double, 10, 10>::Zero();
  double rms_f = 0, rms_m = 0;  ///< N, N m, per coordinate
  /// what the forces look multiplied by: identity if all is well
  Mat3 cross_talk = Mat3::Identity();
  double cross_talk_sd = 0;       ///< of one of its entries
  bool cross_talk_found = false;  ///< an entry is off by more than 2 % and more than 4 sd
  Fit fit;
};

/// Linear start, then robust with spreads of their own for forces and torques. `down_D`: unit,
/// where weight pulls. Throws Error for fewer than 6 readings, orientations that do not tell mass
/// and bias apart (turned about the vertical only), a tool without weight, a negative mass (down is
/// up, or the poses are the other way round), and invalid figures.
ForceSensorCalibration calibrateForceSensor(const std::vector<StaticReading>& readings,
                                            const Vec3& down_D);

}  // namespace palpa::calibration

#pragma once

#include <array>
#include <vector>

#include "calibration/touch/contact_laws.h"
#include "calibration/touch/object_map.h"

/// What a soft thing is like under one press, once what it loses while it is held is taken off.
namespace palpa::calibration {

/// Quasi-linear viscoelasticity (Fung, Biomechanics, 1993, 7.6), E the force of a press that is
/// infinitely slow:
///     f = E + sum q_i,   dq_i/dt = share_i dE/dt - q_i / time_i
/// The times are not found but fixed, a decade apart (a Prony series of the usual kind): a soft
/// thing's relaxation goes on over decades, and shares of given times are told well.
struct Relaxation {
  static constexpr std::array<double, 3> kTimes{0.03, 0.3, 3};  ///< s
  std::array<double, 3> share{};                                ///< of E, 0 or more
};
/// f for E at even times, `dt` apart, from rest.
std::vector<double> relaxed(const Relaxation& law, const std::vector<double>& E, double dt);

/// One press and release at one place at even times: E = f_d ((x - x0) / d)^m.
struct ElasticPress {
  double f_d = 0, m = 1, x0 = 0;  ///< N at the depth d; 1; m
  double depth = 3e-3;            ///< d, m
  double sd = 0;                  ///< of ln f_d
  double rms = 0;                 ///< N, of what is left
  double deepest = 0;             ///< m, of x - x0
};
/// Robust least squares, by the given relaxation. Throws Error, in plain words, for presses that
/// are too short, too light, or tell no shape, and figures that are none.
ElasticPress identifyElastic(const std::vector<PressSample>& press, double dt,
                             const Relaxation& relaxation, double depth = 3e-3);
/// Secant stiffness f_d / d there.
TouchedPlace stiffnessOf(const ElasticPress& press, const Eigen::Vector2d& at);

struct FoundRelaxation {
  Relaxation law;
  /// Of ln f_d, the same in every press that is identified by this law: what is not known of the
  /// shares, as it moves f_d. A map's interval must have it on top.
  double shared_sd = 0;
};
/// The shares that leave least of all presses together, each with its own place and shape. Presses
/// that are held for a while tell it; some at several speeds. Throws Error for fewer than 3.
FoundRelaxation identifyRelaxation(const std::vector<std::vector<PressSample>>& presses, double dt);

}  // namespace palpa::calibration

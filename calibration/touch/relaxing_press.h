#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "calibration/touch/contact_laws.h"
#include "calibration/touch/object_map.h"

/// What a soft thing is like under a round tool that presses it here and there, once what it loses
/// while it is held is taken off.
namespace palpa::calibration {

/// Quasi-linear viscoelasticity (Fung, Biomechanics, 1993, 7.6), E the force of a press that is
/// infinitely slow:
///     f = E + sum q_i,   dq_i/dt = share_i dE/dt - q_i / time_i
/// The times are not found but fixed, half a decade apart (a Prony series of the usual kind): a
/// soft thing's relaxation goes on over decades, and shares of given times are told well.
struct Relaxation {
  static constexpr std::array<double, 5> kTimes{0.02, 0.063, 0.2, 0.63, 2};  ///< s
  std::array<double, 5> share{};                                             ///< of E, 0 or more
};
/// f for E at even times, `dt` apart, from rest.
std::vector<double> relaxed(const Relaxation& law, const std::vector<double>& E, double dt);

/// One place:  E = f_d u^1.5 exp(b (u - 1) + c (u - 1)^2 + e (u - 1)^3),  u = (x - x0) / d.
/// A round tool on a smooth thing begins as Hertz has it (Johnson, Contact Mechanics, 1985, 4.2);
/// layers and what lies below make it stiffer or softer with depth, gradually.
struct ElasticPress {
  double f_d = 0, b = 0, c = 0, x0 = 0;  ///< N at the depth d; 1; 1; m
  double depth = 3e-3;                   ///< d, m
  double sd = 0;                         ///< of ln f_d, by what is this press's own
  double rms = 0;                        ///< N, of what is left
};
/// Secant stiffness f_d / d there.
TouchedPlace stiffnessOf(const ElasticPress& press, const Eigen::Vector2d& at);

/// At even times: a press along the normal at one place, from before it touches.
struct Press {
  Eigen::Vector2d at = Eigen::Vector2d::Zero();  ///< m, along the surface
  std::vector<PressSample> samples;
};

/// Where contact begins decides how deep a press is said to be, and one press alone tells it badly.
/// So all presses are found together: they share the relaxation, e, and a surface, x0 = s0 + s . p
/// but for a deviation of each whose spread is found, too.
struct PressedThing {
  Relaxation relaxation;
  Eigen::Vector3d surface = Eigen::Vector3d::Zero();  ///< m, m/m, m/m: x0 at p
  double uneven = 0;                                  ///< m, standard deviation from it
  double bend = 0;                                    ///< e
  double offset_N = 0;                                ///< what the sensor shows in the air
  /// Of ln f_d, the same in every press: by what is not known of what they share, and by a place
  /// that the device's steps shift alike. A map's interval must have it on top.
  double shared_sd = 0;
  std::vector<std::optional<ElasticPress>> presses;  ///< none: it tells nothing
  std::string why;                                   ///< not; of the last such
};
/// Least squares with each press's own figures free to follow the shared ones (Golub and Pereyra
/// 1973), the deviations' spread by expectation and maximization (Dempster, Laird and Rubin 1977).
/// Presses that are held for a while tell the relaxation; some at several speeds. Throws Error, in
/// plain words, for fewer than 3 presses that are long and heavy enough, and for invalid
/// figures.
PressedThing identifyPresses(const std::vector<Press>& presses, double dt, double depth = 3e-3);

}  // namespace palpa::calibration

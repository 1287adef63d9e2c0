#pragma once

#include <numbers>

/// Units that files and screens use, in SI: a value in millimetres times kMm is in metres.
namespace palpa {

inline constexpr double kMm = 1e-3;                        ///< m
inline constexpr double kDegree = std::numbers::pi / 180;  ///< rad
inline constexpr double kGravity = 9.80665;                ///< m/s^2, standard (3rd CGPM, 1901)

}  // namespace palpa

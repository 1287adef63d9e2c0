#pragma once

#include <array>
#include <cstdint>
#include <type_traits>

#include "anatomy/geometry/pose.h"

/// What shakes a tool that slides over a rough surface, from strokes that were recorded (`palpa
/// calibrate texture`): autoregressive models over force and speed (after Romano & Kuchenbecker
/// 2012; Culbertson, Unwin & Kuchenbecker 2014).
namespace palpa::haptics {

inline constexpr int kMostTextureOrder = 48, kMostTextureSpeeds = 8, kMostTextureForces = 4;
/// s: the models are of forces at this step, and are rendered at no other
inline constexpr double kTexturePeriod = 1e-3;
/// r of the force w = y - r y_before. A tool's acceleration has next to nothing at low frequencies,
/// which poles alone describe badly; its leaky sum y is flatter. [chosen: 17 Hz, the lowest that
/// is felt of a texture]
inline constexpr double kTextureLeak = 0.9;
/// m/s: a hand that holds still trembles about as fast as this (100 um rms at 10 Hz)
inline constexpr double kTextureStill = 5e-3;

/// Of one steady force and speed.
struct TextureNode {
  double ln_rms = 0;  ///< of y, ln N
  /// k_1, k_2, ... of y, each within -1 to 1
  std::array<double, kMostTextureOrder> reflection{};
};

/// Nodes lie where a row of forces crosses a row of speeds, both rising. No speeds: no texture.
struct TextureLaw {
  std::uint32_t speeds = 0, forces = 0, order = 0, reserved = 0;
  std::array<double, kMostTextureSpeeds> ln_speed{};  ///< ln m/s
  std::array<double, kMostTextureForces> ln_force{};  ///< ln N, of the normal force
  std::array<std::array<TextureNode, kMostTextureSpeeds>, kMostTextureForces> nodes{};
  double largest = 0;  ///< N, of the force; see `largestTexture`
};
static_assert(std::is_trivially_copyable_v<TextureLaw>);

struct TextureState {
  std::array<double, kMostTextureOrder> backward{};  ///< b_0, b_1, ... of the last tick
  double slow_f_n = 0;                               ///< N
  Packed3 slow_v{};                                  ///< m/s
  std::uint32_t noise = 0;                           ///< shift register; 0: at its beginning
  std::uint32_t reserved = 0;
};
static_assert(std::is_trivially_copyable_v<TextureState>);

/// The next tick's force along the outward normal, N, of a tool that is pressed on with f_n (N) and
/// slid by `slid` (m) in this tick, of `dt` (s).
///     F, v: f_n and slid / dt through a low-pass of 20 ms; |v| is the speed
///     k_i, ln rms: bilinear between the four nodes around (ln F, ln v), beyond them as at the edge
///     f_p = e: +1 or -1, white, of a shift register of 13 bits, the same in every trial
///     f_i-1 = c_i f_i - k_i b_i-1,   b_i = k_i f_i + c_i b_i-1,   c_i = (1 - k_i^2)^(1/2)
///     y = b_0 = f_0             a normalised lattice (Gray & Markel 1975): y has the variance 1
///                               and stays bounded, however k_i change in between
///     w = rms (y - r y_before), at most `largest`
/// Reflection coefficients between those of two stable filters are those of a stable one. Below the
/// first speed the force falls evenly to nothing at 5 mm/s, below the first force to nothing at
/// none. It asks for no motion: a source. Along the normal, whatever the recording's direction was:
/// people do not tell the direction of a vibration (Landin et al. 2010), what lies along the motion
/// would be taken for friction, and would push the hand. Zero and nothing remembered but the
/// register where f_n <= 0 or a figure is invalid. No allocation, no exception.
double textureForce(const TextureLaw& law, double f_n, const Vec3& slid, double dt,
                    TextureState* state) noexcept;

/// The largest texture that a limiter of `slew` N/s lets through whatever else is felt, N: it may
/// change its sign within a tick, and a tenth is kept for everything else,
///     0.9 slew T / 2
constexpr double largestTexture(double slew) noexcept { return 0.45 * slew * kTexturePeriod; }

/// Rms of w of one node, N: of its y the first correlation is -k_1.
///     rms^2 (1 + r^2 + 2 r k_1)
double textureRms(const TextureNode& node) noexcept;

}  // namespace palpa::haptics

#pragma once

#include <array>
#include <filesystem>
#include <string>
#include <vector>

#include "apps/twin/phantom/rough_surface.h"
#include "calibration/touch/third_octave.h"
#include "haptics/materials/texture.h"

namespace palpa::bench {

/// Shipped textures and the simulated surface that each was recorded on.
struct ShippedTexture {
  twin::RoughSurface surface;
  haptics::TextureLaw law;  ///< bounded as on the virtual bench
};
std::vector<ShippedTexture> shippedTextures(const twin::RoughBench& rough);

/// Third octaves of what the tick commands, and of what the fingers on a simulated device get of
/// it, less those of a fresh recording at the same force and speed, dB; 10 s each.
struct TextureFigures {
  std::array<double, calibration::kThirdOctaves> commanded_dB{}, hand_dB{};
  double largest_N = 0;  ///< of the commands
  double limited = 0;    ///< share of the ticks in which the limiter changed the force
};
TextureFigures textureFigures(const ShippedTexture& texture, const twin::RoughTool& tool,
                              const twin::RoughStroke& stroke);

/// The largest of them, with its sign.
double worstOf(const std::array<double, calibration::kThirdOctaves>& levels_dB);

}  // namespace palpa::bench

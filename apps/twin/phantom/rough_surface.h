#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

namespace palpa::twin {

/// A rough surface as a height profile along a stroke. Random roughness of the spectrum
///     S(q) ~ 1 / ((1 + (q/q_0)^2) (1 + (q/8 q_0)^2))           q: 1/m
/// and, where there are ribs, one raised cosine after the other, each of its own length and height.
struct RoughSurface {
  std::string name;
  double rms = 0, corner = 1000;                          ///< m; q_0, 1/m
  double rib_period = 0, rib_height = 0, rib_spread = 0;  ///< m, m; share, standard deviation
  double stiffness = 1e7;  ///< K, N/m^1.5, of tip and surface together (Hertz)
  double loss = 10;        ///< c, s/m
};

/// A tool that is drawn over it: a round tip, an accelerometer along the normal. Hands above 20 Hz
/// are little else than a damper.
struct RoughTool {
  double radius = 1e-3;      ///< m, of the tip
  double mass = 0.05;        ///< kg, of what the tip moves
  double damping = 6;        ///< N s/m, of the fingers
  double noise_m_s2 = 0.03;  ///< of a sample, standard deviation
};

struct RoughBench {
  RoughTool tool;
  std::vector<RoughSurface> surfaces;
};
/// assets/phantoms/textures/surfaces.json. Throws UsageError.
RoughBench readRoughBench(const std::filesystem::path& file);

/// A long straight stroke, as on a slowly turning disc, by a hand that means to keep force and
/// speed and strays from both by up to `stray`.
struct RoughStroke {
  double force = 1, speed = 0.1, seconds = 10;  ///< N, m/s
  double stray = 0.05;                          ///< share
  std::uint64_t seed = 1;
};

/// What was recorded of it, at 1 kHz through a filter that removes what is above 500 Hz.
struct RoughRecording {
  double dt = 1e-3;
  std::vector<double> f_n, speed, acceleration;  ///< N, m/s, m/s^2 along the normal
};

/// The tip follows the profile's upper envelope by a circle of its radius, z(s), through a contact
/// that may be lost (Hunt & Crossley 1975), at 20 kHz:
///     m y'' = f_c - F - B y',   f_c = K d^1.5 (1 + c d'),   d = z - y;   none for d <= 0
RoughRecording strokeRough(const RoughSurface& surface, const RoughTool& tool,
                           const RoughStroke& stroke);

}  // namespace palpa::twin

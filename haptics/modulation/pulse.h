#pragma once

#include <array>
#include <cstdint>
#include <type_traits>

#include "haptics/flight_record.h"

/// A pulse that is not there, felt through a real surface.
namespace palpa::haptics {

/// A smooth rise and fall: 0 until `start`, 1 at `peak`, 0 from `end` on, s after the beat's start;
///     b(t) = (1 - u^2)^3,   u = (peak - t) / (peak - start) before the peak, likewise after it
/// (1 - u^2)^3 is near a normal curve with a third of that width as its standard deviation; it
/// ends.
struct PulseBump {
  double start_s = 0, peak_s = 0, end_s = 0;
  double height = 0;
};

/// The force of a beat over time, 1 at its largest: what the heart ejects, what comes back from
/// further down, and what follows the closing valve. Carotid and radial pulses are sums of three
/// normal curves to 1.3 % of their height (Liu, Zheng, Murray, Liu, Biomed. Signal Process. Control
/// 8, 2013).
struct PulseWave {
  std::array<PulseBump, 3> bumps;
};

/// What a session knows of pulses; the arteries themselves are in the commands.
struct PulseLaw {
  std::array<PulseWave, kMostVessels> waves;
  double contact_radius = 0.004;  ///< m, over which a tip takes up what presses from below
  /// Times the best force: the artery is closed. Half of the pulse is left where the pressure
  /// outside it is the systolic one, 1.29 times the mean (oscillometry's ratio; Babbs, BioMed. Eng.
  /// OnLine 11, 2012): 1 + 2 (1.29 - 1)
  double closed_at = 1.58;
  double light_N = 0.2;    ///< below this the touch itself comes and goes
  double press_tau = 0.3;  ///< s, of the mean pressure that opens and closes the artery
  double largest_N = 0.8;  ///< of the pulse
};
static_assert(std::is_trivially_copyable_v<PulseLaw>);

struct PulseState {
  double pressed_N = 0;  ///< mean of late
};

/// A tool on the surface; frame P.
struct PulseTouch {
  bool contact = false;
  Vec3 p_C = Vec3::Zero(), u_n = Vec3::UnitZ();  ///< m, the point that touches; outward
  double f_n = 0;                                ///< N, the real surface's, along u_n
};

/// t seconds after the beat's start.
double pulseWave(const PulseWave& wave, double t) noexcept;

/// How much of a beat is felt d beside the artery's line, m, with its middle line z below the
/// surface: what a line load at the depth w presses on a plane (Flamant; Johnson, Contact
/// Mechanics, 1985, 2.3), w^2 = z^2 + r^2 with the tip's r, taken to zero at 4 w:
///     g(d) = r/w (1 - (d / 4w)^2)^2 / (1 + (d/w)^2)^2
/// Deeper is weaker and wider.
double pulseAcross(double d, double z, double r) noexcept;

/// How much of a beat is felt when pressed u times as hard as is best: smooth from 0 at u = 0 to 1
/// at u = 1, the pressure outside being the mean one inside (Mauck, Smith, Geddes, Bourland, J.
/// Biomech. Eng. 102, 1980), to 0 at u = `closed`.
double pulsePressed(double u, double closed) noexcept;

/// The pulse's force on the tool, N in P, `now_ns` session time:
///     f = S g(d) h(F / F_best) c(f_n) sum over beats (s w(t - t_beat)) u_n
/// S strength, s that of a beat; h pulsePressed of F, f_n through a low-pass: the mean pressure
/// decides, and the pulse does not pinch itself off by moving the tool; c smooth from 0 at f_n = 0
/// to 1 at `light_N`. It heeds no motion: it is a source. Zero without contact and for invalid
/// figures; at most `largest_N`. No allocation, no exception.
Vec3 feelPulse(const PulseLaw& law, const PulsingArtery& artery, const PulseTouch& touch,
               std::int64_t now_ns, double dt, PulseState* state) noexcept;

}  // namespace palpa::haptics

#pragma once

#include <cstdint>
#include <vector>

#include "anatomy/query/local_geometry_builder.h"

namespace palpa::bench {

/// Who presses the emergency stop.
enum class StopSource : std::uint8_t {
  key,     ///< any thread of the program, as the space bar's and the pedal's do
  signal,  ///< another program, through the thread that looks for signals every 5 ms
  console  ///< a console, through the stop's own socket
};
/// Which part of the session hangs in a call meanwhile.
enum class HungPart : std::uint8_t { none, scene, task, recorder, camera };

inline constexpr StopSource kStopSources[] = {StopSource::key, StopSource::signal,
                                              StopSource::console};
inline constexpr HungPart kHungParts[] = {HungPart::none, HungPart::scene, HungPart::task,
                                          HungPart::recorder, HungPart::camera};
const char* nameOf(StopSource source);
const char* nameOf(HungPart part);

/// From the press to the device's first command of zero force, ms, for each of `presses` presses in
/// a session in real time that holds a probe 1 mm in the torso's skin; before each the hung part
/// hangs and there is force, after each somebody re-arms. Throws Error where a stop is not obeyed
/// within seconds, or nothing can be pressed against.
std::vector<double> timeStops(const anatomy::LocalGeometryBuilder& builder, StopSource source,
                              HungPart hung, int presses);

}  // namespace palpa::bench

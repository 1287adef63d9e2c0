#pragma once

namespace palpa::anatomy {

/// How skin, fat and muscle together go with the vein's depth, mm. All [chosen]: the vein lies in
/// loose tissue behind the muscle, and from person to person the layers vary less at the entry,
/// where the muscle thins out, than at the window.
inline double softAtWindow(double vein_depth) { return 0.92 * vein_depth - 2; }
inline double softAtEntry(double at_window) { return 6.5 + 0.58 * at_window; }

}  // namespace palpa::anatomy

#pragma once

#include "apps/bench/contact_study.h"
#include "haptics/materials/hunt_crossley.h"

namespace palpa::bench {

/// An object of simulated silicone between two tools, lifted free of its support and squeezed: its
/// weight hangs on both, and where the line between them is tilted the lower tool presses deeper.
struct SqueezeCase {
  double mass = 0;       ///< kg
  double tilt = 0;       ///< rad, of the line between the tools against the horizontal
  double factor = 1;     ///< of the true stiffness
  bool swapped = false;  ///< the tools' numbers
};
/// The hands' forces against k~ x on both, k~ = factor f_true(x)/x at the mean depth, with the true
/// weight: rms over rms.
double squeezeError(const twin::PhantomTable& side, const haptics::HuntCrossley& known,
                    const SqueezeCase& squeeze);

}  // namespace palpa::bench

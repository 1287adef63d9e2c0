#pragma once

#include "anatomy/parametric/parametric_patient.h"
#include "anatomy/parametric/vessels.h"

namespace palpa::anatomy {

/// Everything that decides whether a draw can be a patient, before any costly mesh is made.
struct Solution {
  Build build;
  Clavicle clavicle;
  BodySurface skin;
  TaughtLine line;
  Vec3 window,
      window_skin;  ///< the vein's centre and the skin over it at the infraclavicular window
  Vessels vessels;
};

/// Checks the parameters against their documented ranges, finds the taught line and places the vein
/// so that the depth of its front wall at the window, along the skin's normal, is the one asked for
/// (within 0.02 mm of the fields). Throws Error with the violated constraint.
Solution solve(const PatientParameters& parameters);

}  // namespace palpa::anatomy

#pragma once

#include "anatomy/patient.h"

namespace palpa::scene {

/// What the views are framed on.
struct Region {
  Vec3 focus_A = Vec3::Zero();         ///< between entry point and vein target
  Vec3 centre_A = Vec3::Zero();        ///< middle of the fixed views
  double width = 0.2;                  ///< metres across the fixed views
  Vec3 whole_centre_A = Vec3::Zero();  ///< sphere about the whole patient
  double whole_radius = 0.3;
  double whole_half = 0.3;             ///< half of the patient's longest side
};

/// From the landmarks and the clavicle of the punctured side; a patient without them is framed
/// whole.
Region regionOf(const anatomy::Patient& patient);

}  // namespace palpa::scene

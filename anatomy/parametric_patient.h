#pragma once

#include "anatomy/patient.h"

namespace palpa::anatomy {

/// The infraclavicular region, drawn from the reference figures in assets/patients/reference.json.
/// Every length is metres. Defaults are the means; the file states source and range.
struct PatientParameters {
  Side side = Side::right;
  std::uint64_t seed = 0;  ///< 0: the reference patient exactly; others draw from the spreads
  double vein_depth =
      0.020;  ///< skin to the vein's front wall at the target, along the skin normal
  double vein_diameter = 0.009;
  double pleura_distance = 0.006;   ///< vein's back wall to the pleura
  double clavicle_length = 0.1494;  ///< chord, sternal to acromial end
  double clavicle_thickness = 0.012;
  SoftLayers layers;
};

/// Builds the closed surfaces and landmarks. Throws Error when the parameters cannot be a patient
/// (outside their documented range, or structures would intersect).
Patient buildPatient(const PatientParameters& parameters);

/// Reads means, spreads, ranges from a reference file and draws with `seed` (0: the means).
PatientParameters drawParameters(const std::string& reference_json, Side side, std::uint64_t seed);

}  // namespace palpa::anatomy

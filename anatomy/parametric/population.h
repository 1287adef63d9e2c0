#pragma once

#include <string>

namespace palpa::anatomy {

/// A normal quantity with the ends of its range cut off. SI units; a share is of 1.
struct Spread {
  double mean, sd, low, high;
};

/// Adult upper chests: what assets/patients/reference.json states, with unit and source, of each
/// figure.
struct Population {
  Spread height_women, height_men;
  Spread bmi;  ///< kg/m^2
  Spread vein_depth, vein_diameter, pleura_distance, clavicle_length, clavicle_thickness,
      skin_thickness;
  Spread fat_share_women, fat_share_men;  ///< of fat and muscle at the entry
  double vein_depth_with_bmi, fat_share_with_bmi, clavicle_length_with_height;  ///< correlations
};

/// Throws Error for a file that cannot be read or is not such a reference, naming the entry.
Population readPopulation(const std::string& reference_json);

}  // namespace palpa::anatomy

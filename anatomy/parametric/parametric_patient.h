#pragma once

#include <optional>

#include "anatomy/parametric/population.h"
#include "anatomy/patient.h"

namespace palpa::anatomy {

enum class Sex { female, male };

/// How much of the body: head and trunk to below the seventh rib, or what a training phantom is:
/// neck to the fourth rib.
enum class Extent { torso, bust };

/// A person's upper body, drawn from the reference figures in assets/patients/reference.json.
/// Every length is metres. Defaults are the means; the file states source and range.
struct PatientParameters {
  Side side = Side::right;
  std::uint64_t seed = 0;  ///< 0: the means of such a person exactly; others draw from the spreads
  Extent extent = Extent::torso;
  Sex sex = Sex::male;
  double height = 1.70;
  double bmi = 25;  ///< kg/m^2
  /// Skin to the vein's front wall at the infraclavicular window (below the middle of the clavicle,
  /// where ultrasound sees the vein beside the bone), along the skin normal
  double vein_depth = 0.020;
  double vein_diameter = 0.009;     ///< at the target, as the next
  double pleura_distance = 0.006;   ///< vein's back wall to the pleura
  double clavicle_length = 0.1494;  ///< chord, sternal to acromial end
  double clavicle_thickness = 0.012;
  SoftLayers layers;  ///< at the entry point
};

/// Builds the closed surfaces and landmarks. Throws Error when the parameters cannot be a patient
/// (outside their documented range, or structures would intersect).
Patient buildPatient(const PatientParameters& parameters);

/// Whom to draw: what is not stated is drawn from the population.
struct Person {
  std::optional<Sex> sex;
  std::optional<double> height;  ///< metres
  std::optional<double> bmi;     ///< kg/m^2
};

/// Draws with `seed`. Seed 0: the means of such a person, and of the population where the person is
/// not stated. Clavicle and height, vein depth and body mass go together as the population's
/// correlations say, so that many drawn without statements have its means and spreads. Throws Error
/// for a person outside the ranges.
PatientParameters drawParameters(const Population& population, Side side, std::uint64_t seed,
                                 const Person& person = {});

}  // namespace palpa::anatomy

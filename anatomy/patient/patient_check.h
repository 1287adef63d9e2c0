#pragma once

#include <string>
#include <vector>

#include "anatomy/patient.h"
#include "anatomy/query/surface_query.h"

namespace palpa::anatomy {

/// One measurement on a patient's meshes against what the taught manoeuvre needs.
struct PatientFinding {
  std::string name;
  double value;
  std::string unit;
  bool ok;
  std::string wanted;  ///< in words, e.g. "10 to 30"
};

/// Measures the patient as it is, however it was made: line from entry to vein target (angle to the
/// skin, way, clearance from the clavicle, what it crosses first), vein (depth, diameter, distance
/// to pleura and artery), structures that must not meet, closed surfaces. Needs the landmarks
/// entry_point and vein_target and the organs of the reference patient; throws Error without.
std::vector<PatientFinding> checkPatient(const Patient& patient);

/// Why no score can be given on this patient, as a clause: the line from its entry point to its
/// vein's target is not the one that is taught (the findings about it in checkPatient), or its
/// clavicle rises or falls toward the shoulder as with a raised or hanging arm (by more than 40
/// degrees [chosen]), so that what is taught by the clavicle would lead elsewhere. Empty: it can.
std::string whyNotScored(const Patient& patient, const SurfaceQuery& query);

/// Landmarks and organs that the needle task cannot do without and the patient lacks, by name;
/// empty for a fit patient.
std::vector<std::string> missingForNeedle(const Patient& patient);

/// Throws Error, in one line with everything that is missing; `where`: its file.
void requireForNeedle(const Patient& patient, const std::string& where);

}  // namespace palpa::anatomy

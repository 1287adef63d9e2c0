#pragma once

#include <filesystem>

#include "anatomy/patient.h"

namespace palpa::anatomy {

/// glTF binary (Y up, metres). `extras` of the root carry unit, side, layers, landmarks, licence,
/// those of each node its organ. Written beside the target, then renamed. Throws Error.
void writePatient(const Patient& patient, const std::filesystem::path& file);

/// Reads and checks: indices in range, finite vertices, known organs, needed landmarks.
Patient readPatient(const std::filesystem::path& file);

/// Whether a glTF binary file says that it holds a patient of this program. Throws Error when it is no glTF at all.
bool isPatientFile(const std::filesystem::path& file);

}  // namespace palpa::anatomy

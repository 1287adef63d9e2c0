#pragma once

#include <filesystem>

#include "anatomy/patient.h"

namespace palpa::anatomy {

/// Points and normals as they are read from a file, which keeps floats. A patient that is built
/// ends with this, so that it and what is read of its file are the same, bit for bit: a trial
/// judged again from its record meets the same surfaces.
void roundAsInFile(Patient& patient);

/// glTF binary (Y up, metres). `extras` of the root carry unit, side, layers, landmarks, licence,
/// source, those of each node its organ, tissue, licence and source. Written beside the target,
/// then renamed. Throws Error.
void writePatient(const Patient& patient, const std::filesystem::path& file);

/// Reads and checks: indices in range, finite vertices, known organs. What a task needs besides is
/// asked by `requireForNeedle` (patient_check.h): a patient may be there to be looked at.
Patient readPatient(const std::filesystem::path& file);

/// Whether a glTF binary file says that it holds a patient of this program. Throws Error when it is
/// no glTF at all.
bool isPatientFile(const std::filesystem::path& file);

}  // namespace palpa::anatomy

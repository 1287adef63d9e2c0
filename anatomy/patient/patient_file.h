#pragma once

#include <filesystem>
#include <string>
#include <string_view>

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
/// The bytes of that file, without one. Throws Error; `where` begins its message.
std::string glbOf(const Patient& patient, const std::string& where);

/// Reads and checks: indices in range, finite vertices, known organs. What a task needs besides is
/// asked by `requireForNeedle` (patient_check.h): a patient may be there to be looked at. Throws
/// Error.
Patient readPatient(const std::filesystem::path& file);
/// The same from the file's bytes, as a recording holds them; `where` begins every message.
Patient patientOfGlb(std::string_view bytes, const std::string& where);

/// Whether a glTF binary file says that it holds a patient of this program. Throws Error when it is
/// no glTF at all.
bool isPatientFile(const std::filesystem::path& file);

}  // namespace palpa::anatomy

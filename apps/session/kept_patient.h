#pragma once

#include "anatomy/parametric/parametric_patient.h"

namespace palpa::session {

/// The patient that `anatomy::buildPatient` makes of these parameters, the same to the bit. Where
/// $PALPA_CACHE names a folder, a patient that an earlier run built is read from there instead, and
/// one that is built is kept there: a second less for every session. The kept file's name is the
/// SHA-256 of this very program (its place, size and age) and of the parameters; its first line is
/// that of the rest, so what is damaged is built anew. Throws Error as `buildPatient` does; a
/// folder that cannot be read or written is no error. Nothing is ever removed from the folder, so
/// that programs can share it; it may be emptied at any time.
anatomy::Patient keptPatient(const anatomy::PatientParameters& parameters);

}  // namespace palpa::session

#pragma once

#include "anatomy/volume/ct_patient.h"

namespace palpa::anatomy {

/// Adds the landmarks of the taught manoeuvre to ct->patient (still in S) and the sentences that belong to them: ends and
/// thirds of the clavicle's axis, the notch on the skin over the manubrium's upper border, the entry on the skin 1 cm
/// below the bone, and the target on the vein's line that is nearest in direction to the posterior-superior angle of the sternal end among those
/// reached without meeting bone, artery or lung. Seeds "suprasternal_notch", "entry_point", "vein_target" overrule.
void markLandmarks(const Clavicle3& clavicle, const Vein& vein, const Seeds& seeds, CtPatient* ct);

}  // namespace palpa::anatomy

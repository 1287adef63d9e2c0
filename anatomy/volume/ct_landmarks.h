#pragma once

#include "anatomy/volume/ct_patient.h"

namespace palpa::anatomy {

/// Adds the landmarks of the taught manoeuvre to ct->patient (still in S) and the sentences that
/// belong to them: ends and thirds of the clavicle's axis, the notch on the skin over the
/// manubrium's upper border, the entry on the skin 1 cm below the bone, and the target: the place
/// on the vein's line to which the way from the entry lies flattest on the skin among those that
/// lead medially and cephalad, keep 1 mm from bone and meet the vein first. Its angle, clearance
/// and depth are said; where it is steeper than 30 degrees, so is the nearest entry from which it
/// would not be. Seeds "suprasternal_notch", "entry_point", "vein_target" overrule.
void markLandmarks(const Clavicle3& clavicle, const Vein& vein, const Seeds& seeds, CtPatient* ct);

}  // namespace palpa::anatomy

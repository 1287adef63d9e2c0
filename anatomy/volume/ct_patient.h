#pragma once

#include <optional>

#include "anatomy/patient.h"
#include "anatomy/volume/label_surface.h"

namespace palpa::anatomy {

struct CtOptions {
  std::string name = "CT";
  Seeds seeds;               ///< given by a person; what is missing is proposed
  std::optional<Side> side;  ///< punctured; by default the side of the contrast
  std::optional<double> bone_level, dense_level;  ///< in the volume's values
  SoftLayers layers;  ///< over what the data show; estimates, where the volume is clipped
};

/// A patient, what it was made from, and what is to be said about it.
struct CtPatient {
  Patient patient;
  Scan scan;
  std::vector<LabelledOrgan> labels;
  Seeds seeds;  ///< S, metres: used ones, proposed or given
  /// plain sentences: what leaves the volume, what is estimated, what may be turned
  std::vector<std::string> remarks;
  Vec3 origin_S = Vec3::Zero();  ///< of A
};

/// Segments, meshes, finds landmarks. Deterministic. Throws Error when there is no bone, no
/// clavicle on the punctured side, or no contrast-filled vein and no seed for it.
CtPatient buildCtPatient(const Volume& volume, const CtOptions& options,
                         const StepProgress& progress = {});

/// Adds the landmarks of the taught manoeuvre to ct->patient (still in S) and the sentences that
/// belong to them: ends and thirds of the clavicle's axis, the notch on the skin over the
/// manubrium's upper border, the entry on the skin 1 cm below the bone, and the target: the place
/// on the vein's line to which the way from the entry lies flattest on the skin among those that
/// lead medially and cephalad, keep 1 mm from bone and meet the vein first. Its angle, clearance
/// and depth are said; where it is steeper than 30 degrees, so is the nearest entry from which it
/// would not be. Seeds "suprasternal_notch", "entry_point", "vein_target" overrule.
void markLandmarks(const Clavicle3& clavicle, const Vein& vein, const Seeds& seeds, CtPatient* ct);

/// The brightest of the scan seen from in front, from the patient's left and from below, as
/// radiologists hang them (patient's right on the left), 1 mm a pixel, with the outlines of
/// `labels` and crosses at `marks`.
RgbPicture projections(const Scan& scan, const std::vector<const LabelledOrgan*>& labels,
                       const Seeds& marks);

}  // namespace palpa::anatomy

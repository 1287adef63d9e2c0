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
  std::vector<std::string>
      remarks;  ///< plain sentences: what leaves the volume, what is estimated, what may be turned
  Vec3 origin_S = Vec3::Zero();  ///< of A
};

/// Segments, meshes, finds landmarks. Deterministic. Throws Error when there is no bone, no
/// clavicle on the punctured side, or no contrast-filled vein and no seed for it.
CtPatient buildCtPatient(const Volume& volume, const CtOptions& options,
                         const StepProgress& progress = {});

}  // namespace palpa::anatomy

#pragma once

#include "anatomy/volume/clavicles.h"
#include "anatomy/volume/vein.h"

namespace palpa::anatomy {

/// A labelled part of the scan that becomes a surface.
struct LabelledOrgan {
  std::string id;
  Organ organ = Organ::none;
  Mask mask;
  bool estimated = false;     ///< not seen in the data, made from what surrounds it
  double smoothing = 1.2e-3;  ///< metres, of the surface
  double cell = 2e-3;         ///< metres, of its mesh
};

/// Lungs: air inside the body. Of a clipped volume the large cavities in it that hold no soft
/// tissue and lie beside the mediastinum (the soft tissue by the midline, its fat closed over by 18
/// mm): an estimate, and called so. The two largest, right and left of the midline.
std::vector<LabelledOrgan> findLungs(const Scan& scan, double midline_x);

/// Sternum and ribs: bone outside of the closed lungs, not farther than 14 mm from them, and no
/// pool of contrast (heart); the sternum is what is nearer to the strip by the midline than to the
/// bones beside it. Without lungs nothing is found.
std::vector<LabelledOrgan> findThoraxBones(const Scan& scan,
                                           const std::vector<LabelledOrgan>& lungs,
                                           const Mask& taken, double midline_x, double front_y,
                                           double top_z);

}  // namespace palpa::anatomy

#pragma once

#include <optional>

#include "anatomy/patient.h"
#include "anatomy/volume/scan.h"

namespace palpa::anatomy {

/// One clavicle among all bone. Bones that touch at a low threshold part at a higher one; a
/// clavicle is the piece of the lowest threshold that has its shape: 50 to 190 mm long, a rod of 4
/// to 10 mm rms, in front of the spine and to one side.
struct Clavicle3 {
  Mask mask;  ///< filled: marrow included
  /// from the sternal end to the acromial end or to where the volume ends
  std::vector<Vec3> axis_S;
  double length = 0;           ///< along the axis, inside the volume
  bool leaves_volume = false;  ///< at its acromial end
  Vec3 seed_S = Vec3::Zero();  ///< a place in it that finds it again
};

/// Both sides where found. `taken`: voxels of vessels, which are no bone. A seed ("clavicle_right",
/// "clavicle_left") asks for the piece that it lies in or within 8 mm of, of any shape.
struct Clavicles {
  std::optional<Clavicle3> right, left;
};
Clavicles findClavicles(const Scan& scan, const Mask& taken, const Seeds& seeds);

/// A contrast-filled vein as a tube: the cheapest way through bright, even voxels between a seed in
/// the superior vena cava
/// ("vein_svc") and one at the armpit ("vein_axilla"), its radius along the way, and the bright
/// voxels about it.
struct Vein {
  Side side = Side::right;
  std::vector<Vec3> line_S;    ///< axilla to superior vena cava
  std::vector<double> radius;  ///< of the largest ball in the lumen there, metres
  Mask mask;
  Mask contrast;  ///< all dense voxels that are too thick for cortex, with 5 mm about them: no bone
  Seeds seeds;    ///< the two that were used
};

/// Finds what no seed gives: the vena cava as the bright upright tube by the midline, the armpit's
/// end as the dense piece that lies farthest out on the side with more of it. Empty when there is
/// no dense contrast.
std::optional<Vein> findVein(const Scan& scan, const Seeds& seeds);

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

/// Pieces of ribs put together and named. A piece is a rod round its lung, from the spine forward;
/// rods whose ends face each other over at most 30 mm are one rib, and the gap is bridged. Ribs
/// that begin at the spine are counted there from above ("rib_1_left": the first that was found),
/// others are "rib_piece_1_left". Crumbs are dropped.
void addRibs(const Scan& scan, const Mask& ribs, const std::vector<LabelledOrgan>& lungs,
             double midline_x, std::vector<LabelledOrgan>* organs);

/// Where the skin lies: the body's border, or, in a volume clipped to soft tissue, an estimate:
/// `parts` (bones, vein, lungs) and the soft tissue, closed by 7 mm, so that the hollow below the
/// clavicle stays; the layers over it are still to be added.
Mask skinMask(const Scan& scan, const std::vector<LabelledOrgan>& parts);

}  // namespace palpa::anatomy

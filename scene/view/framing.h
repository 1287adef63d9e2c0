#pragma once

#include "anatomy/patient.h"
#include "scene/panels.h"
#include "scene/scene_state.h"

namespace palpa::scene {

/// What the views are framed on.
struct Region {
  Vec3 focus_A = Vec3::Zero();         ///< between entry point and vein target
  Vec3 centre_A = Vec3::Zero();        ///< middle of the fixed views
  double width = 0.2;                  ///< metres across the fixed views
  Vec3 whole_centre_A = Vec3::Zero();  ///< sphere about the whole patient
  double whole_radius = 0.3;
  double whole_half = 0.3;  ///< half of the patient's longest side
  double height = 0;  ///< metres down the fixed views that are to be seen as well; 0: as it comes
  double work_radius = 0.13;  ///< about `work_centre_A`: where hands, tool and eyes are
  Vec3 work_centre_A = Vec3::Zero();
  bool only_skin = false;  ///< nothing lies under it: the skin itself is to be seen
  bool on_table = false;   ///< a thing on a table, looked at from its near edge
};

/// From the landmarks and the clavicle of the punctured side; a patient without them is framed
/// whole. Where there is no bone but a skin alone, all of it is framed, down as well as across.
Region regionOf(const anatomy::Patient& patient);

/// The part of a camera's picture in which a ball lies in the middle and fills most of the height:
/// pixels from the top left, as wide as `aspect` times its height, nothing beyond the picture, at
/// least half of its width. The whole picture where the ball would not be in it whole.
/// `before` stays while it does nearly as well: nobody can work in a picture that keeps moving.
Rect partWithWork(const Pinhole& camera, const Vec3& centre_C, double radius, double aspect,
                  const Rect& before);

enum class Plane { frontal, sagittal, axial };

/// How a parallel view looks at the patient: directions of the eye, and the letters at the edges
/// (patient's Right, Left, Superior, Inferior, Anterior, Posterior). The side view looks from the
/// side that is punctured.
struct Aspect {
  const char* caption;
  Vec3 ahead_A, up_A;
  const char *left, *right, *top, *bottom;
};
Aspect aspectOf(Plane plane, anatomy::Side side);

/// Of a thing that lies on a table (anatomy/parametric/phantoms.h), for who sits before it: from
/// above, from the front, from the right; up is up.
Aspect aspectOnTable(Plane plane);

}  // namespace palpa::scene

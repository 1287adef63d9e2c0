#include "scene/aspect.h"

namespace palpa::scene {

Aspect aspectOf(Plane plane, anatomy::Side side) {
  switch (plane) {
    case Plane::frontal:
      return {"FRONT", Vec3::UnitY(), Vec3::UnitZ(), "R", "L", "S", "I"};
    case Plane::axial:
      return {"TOP", -Vec3::UnitZ(), Vec3::UnitY(), "R", "L", "P", "A"};
    case Plane::sagittal:
      break;
  }
  if (side == anatomy::Side::right)
    return {"SIDE", Vec3::UnitX(), Vec3::UnitZ(), "P", "A", "S", "I"};
  return {"SIDE", -Vec3::UnitX(), Vec3::UnitZ(), "A", "P", "S", "I"};
}

}  // namespace palpa::scene

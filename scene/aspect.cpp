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

Aspect aspectOnTable(Plane plane) {
  switch (plane) {
    case Plane::frontal:
      return {"FROM ABOVE", Vec3::UnitY(), Vec3::UnitZ(), "left", "right", "far", "near"};
    case Plane::axial:
      return {"FRONT", Vec3::UnitZ(), -Vec3::UnitY(), "left", "right", "", ""};
    case Plane::sagittal:
      break;
  }
  return {"SIDE", -Vec3::UnitX(), -Vec3::UnitY(), "near", "far", "", ""};
}

}  // namespace palpa::scene

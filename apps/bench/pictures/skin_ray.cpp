#include "apps/bench/pictures/skin_ray.h"

#include <array>

namespace palpa::bench {

SkinRay::SkinRay(const anatomy::Patient& patient) : skin_(patient.organ(Organ::skin).mesh) {}

std::optional<double> SkinRay::along(const Vec3& from_A, const Vec3& way, double length) const {
  std::array<anatomy::TriangleTree::Crossing, 16> crossings;
  bool lost = false;
  const int count =
      skin_.cast(from_A, way, length, crossings.data(), static_cast<int>(crossings.size()), &lost);
  std::optional<double> first;
  for (int k = 0; k < count; ++k)
    if (const double s = crossings[static_cast<std::size_t>(k)].s; !first || s < *first) first = s;
  return first;
}

}  // namespace palpa::bench

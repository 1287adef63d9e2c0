#include "haptics/floor_contact.h"

#include <algorithm>

namespace palpa::haptics {

FloorTouch touchFloor(const SearchSurface& surface, const FloorGains& gains, double stiffest,
                      double unit, const Vec3& p_F, const Vec3& v_F) noexcept {
  FloorTouch touch;
  touch.p_U = p_F / unit;
  touch.v_F = v_F;
  touch.place = surface.place(touch.p_U.x(), touch.p_U.y());
  const Vec3 e = unit * (surface.closestFree(touch.p_U) - touch.p_U);
  touch.penetration = e.norm();
  if (touch.penetration <= 0) return touch;
  touch.touching = true;
  const Vec3 u = e / touch.penetration;
  const double push =
      std::min(gains.stiffness, stiffest) * touch.penetration - gains.damping * v_F.dot(u);
  touch.f_F = std::max(push, 0.0) * u;
  return touch;
}

std::uint8_t placeBits(const FloorTouch& touch) noexcept {
  const int bits = (touch.place.element + 1) | (touch.place.texture ? kPlaceTexture : 0) |
                   (touch.place.pit ? kPlacePit : 0) | (touch.touching ? kPlaceTouching : 0);
  return static_cast<std::uint8_t>(bits);
}

}  // namespace palpa::haptics

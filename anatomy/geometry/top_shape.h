#pragma once

#include <array>
#include <cstdint>
#include <type_traits>

#include "anatomy/geometry/pose.h"

/// The curved top of a thing that is felt from above, as a height over a plane: the haptic tick,
/// the bench, the hands, the score and the picture all ask the same shape.
namespace palpa {

/// A hill on a top, or a hollow where `high` is negative, or a ridge where it has no end:
///     high exp(-((u/wide_u)^2 + (v/wide_v)^2) / 2),   u = (p - at) . along, v across that
struct TopMound {
  double x = 0, y = 0;                  ///< m, its middle
  double high = 0;                      ///< m
  double wide_u = 0.01, wide_v = 0.01;  ///< m, standard deviations; 0: endless that way
  double along_x = 1, along_y = 0;      ///< unit, the way of u
  bool operator==(const TopMound&) const = default;
};

/// A top in P: x right, y away from who palpates, z up, the origin on it. Metres.
///     z(x, y) = arch + hollow y^2 / 2 + mounds, less the same at the origin
///     arch = (g + sqrt(g^2 + foot^2)) / 2
///     g    = arch_high (s - x^2 / (arch_half_x^2 s) - s y^2 / arch_half_y^2),   s = 1 + taper y
/// Half a paraboloid that runs out smoothly into the plane about it: a dome (breast, gland), a
/// gentle bulge (abdomen), with arch_half_y = 0 a vault along y (neck, forearm) that widens and
/// rises by `taper` along y. Everything has all derivatives, so a force along the normal has no
/// kink.
struct TopShape {
  static constexpr std::size_t kMostMounds = 6;
  double arch_high = 0;     ///< m; 0: none
  double arch_half_x = 1;   ///< m, where the paraboloid meets the plane
  double arch_half_y = 0;   ///< m; 0: endless
  double arch_foot = 0.01;  ///< m, how softly it runs out: half of this is its height there
  double taper = 0;         ///< 1/m
  double hollow = 0;        ///< 1/m, curvature along y; above 0: a saddle's
  double origin = 0;        ///< m, z at the origin before that is taken off; see `onOrigin`
  std::uint32_t mound_count = 0;
  std::uint32_t reserved = 0;
  std::array<TopMound, kMostMounds> mounds{};

  /// Nothing of it is curved: every question below has the plane's answer then, to the bit.
  bool flat() const noexcept { return arch_high == 0 && hollow == 0 && mound_count == 0; }
  bool operator==(const TopShape&) const = default;
};
static_assert(std::is_trivially_copyable_v<TopShape>);

/// The same with the origin on it.
TopShape onOrigin(TopShape top) noexcept;

/// Of a top at (x, y): height, slopes, second derivatives; m, 1, 1/m.
struct TopHeight {
  double z = 0, zx = 0, zy = 0, zxx = 0, zxy = 0, zyy = 0;
};
TopHeight heightOf(const TopShape& top, double x, double y) noexcept;
Vec3 normalOf(const TopShape& top, double x, double y) noexcept;  ///< outward, unit

/// Curvatures of the two principal directions, 1/m, the larger one first; above 0: it bulges.
std::array<double, 2> curvaturesOf(const TopShape& top, double x, double y) noexcept;

struct TopFoot {
  Vec3 p = Vec3::Zero(), n = Vec3::UnitZ();  ///< nearest point of the top; its normal, outward
  double over = 0;                           ///< m along the normal; negative inside
};

/// The point of the top nearest to `p`, by Newton's method from the point straight below, steps
/// halved until they come nearer, bounded: to a nanometre where `p` is nearer than the centre of
/// curvature. No allocation, no exception.
TopFoot nearestOn(const TopShape& top, const Vec3& p) noexcept;

/// Places along a top: x and y of the nearest point of it, and how far over it along the normal.
/// What is judged and searched is told so; on a flat top it is the point itself.
Vec3 alongTop(const TopShape& top, const Vec3& p) noexcept;
/// The point that lies there.
Vec3 fromTop(const TopShape& top, const Vec3& along) noexcept;

/// The least turn that takes z to the unit vector `n`, whose z is above -1.
Mat3 turnToNormal(const Vec3& n) noexcept;

}  // namespace palpa

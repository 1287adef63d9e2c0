#include "anatomy/geometry/top_shape.h"

#include <algorithm>
#include <cmath>

#include "anatomy/base/pinned_math.h"

namespace palpa {
namespace {

constexpr int kMostSteps = 20, kMostHalvings = 6;
constexpr double kClose = 1e-10, kLongestStep = 0.02;  // m

double inverseSquare(double wide) noexcept { return wide > 0 ? 1 / (wide * wide) : 0; }

/// Half the sum of g and its smoothed absolute value.
void addArch(const TopShape& top, double x, double y, TopHeight& h) noexcept {
  const double H = top.arch_high, a = inverseSquare(top.arch_half_x),
               b = inverseSquare(top.arch_half_y), t = top.taper, s = 1 + t * y, xx = x * x * a;
  const double g = H * (s - xx / s - s * y * y * b), gx = -2 * H * x * a / s,
               gy = H * (t + xx * t / (s * s) - t * y * y * b - 2 * s * y * b);
  const double gxx = -2 * H * a / s, gxy = 2 * H * x * a * t / (s * s),
               gyy = -2 * H * (xx * t * t / (s * s * s) + 2 * t * y * b + s * b);
  const double r = std::sqrt(g * g + top.arch_foot * top.arch_foot), m = 0.5 * (1 + g / r),
               mm = 0.5 * top.arch_foot * top.arch_foot / (r * r * r);
  h.z += 0.5 * (g + r);
  h.zx += m * gx;
  h.zy += m * gy;
  h.zxx += m * gxx + mm * gx * gx;
  h.zxy += m * gxy + mm * gx * gy;
  h.zyy += m * gyy + mm * gy * gy;
}

void addMound(const TopMound& mound, double x, double y, TopHeight& h) noexcept {
  const double dx = x - mound.x, dy = y - mound.y, c = mound.along_x, s = mound.along_y,
               u = c * dx + s * dy, v = c * dy - s * dx, a = inverseSquare(mound.wide_u),
               b = inverseSquare(mound.wide_v);
  const double z = mound.high * pinned::exp(-0.5 * (u * u * a + v * v * b)), zu = -u * a * z,
               zv = -v * b * z, zuu = (u * u * a - 1) * a * z, zuv = u * v * a * b * z,
               zvv = (v * v * b - 1) * b * z;
  h.z += z;
  h.zx += c * zu - s * zv;
  h.zy += s * zu + c * zv;
  h.zxx += c * c * zuu - 2 * c * s * zuv + s * s * zvv;
  h.zxy += c * s * (zuu - zvv) + (c * c - s * s) * zuv;
  h.zyy += s * s * zuu + 2 * c * s * zuv + c * c * zvv;
}

Vec3 upFrom(const TopHeight& h) noexcept { return Vec3(-h.zx, -h.zy, 1).normalized(); }

/// Newton's step toward the nearest point, where the surface stands `h` at (x, y).
Eigen::Vector2d stepToward(const Vec3& p, double x, double y, const TopHeight& h) noexcept {
  const double gap = h.z - p.z(), gx = x - p.x() + gap * h.zx, gy = y - p.y() + gap * h.zy;
  double xx = 1 + h.zx * h.zx + gap * h.zxx, yy = 1 + h.zy * h.zy + gap * h.zyy,
         xy = h.zx * h.zy + gap * h.zxy, det = xx * yy - xy * xy;
  if (!(xx > 0.1 && det > 0.1)) {  // near a centre of curvature: without the second derivatives
    xx = 1 + h.zx * h.zx, yy = 1 + h.zy * h.zy, xy = h.zx * h.zy;
    det = xx * yy - xy * xy;
  }
  Eigen::Vector2d step((xy * gy - yy * gx) / det, (xy * gx - xx * gy) / det);
  const double length = step.norm();
  if (length > kLongestStep) step *= kLongestStep / length;
  return step;
}

double squareTo(const Vec3& p, double x, double y, double z) noexcept {
  return (Vec3(x, y, z) - p).squaredNorm();
}

}  // namespace

TopHeight heightOf(const TopShape& top, double x, double y) noexcept {
  TopHeight h;
  if (top.flat()) return h;
  h.z = 0.5 * top.hollow * y * y - top.origin;
  h.zy = top.hollow * y;
  h.zyy = top.hollow;
  if (top.arch_high != 0) addArch(top, x, y, h);
  for (std::size_t i = 0; i < std::min<std::size_t>(top.mound_count, top.mounds.size()); ++i)
    addMound(top.mounds[i], x, y, h);
  return h;
}

TopShape onOrigin(TopShape top) noexcept {
  top.origin = 0;
  top.origin = heightOf(top, 0, 0).z;
  return top;
}

Vec3 normalOf(const TopShape& top, double x, double y) noexcept {
  return top.flat() ? Vec3(Vec3::UnitZ()) : upFrom(heightOf(top, x, y));
}

/// Of the shape operator: the second form against the first.
std::array<double, 2> curvaturesOf(const TopShape& top, double x, double y) noexcept {
  const TopHeight h = heightOf(top, x, y);
  const double E = 1 + h.zx * h.zx, F = h.zx * h.zy, G = 1 + h.zy * h.zy, w = std::sqrt(E + G - 1),
               det = E * G - F * F;
  const double mean = -(E * h.zyy - 2 * F * h.zxy + G * h.zxx) / (2 * w * det),
               gauss = (h.zxx * h.zyy - h.zxy * h.zxy) / (w * w * det),
               apart = std::sqrt(std::max(mean * mean - gauss, 0.0));
  return {mean + apart, mean - apart};
}

TopFoot nearestOn(const TopShape& top, const Vec3& p) noexcept {
  if (top.flat()) return {Vec3(p.x(), p.y(), 0), Vec3::UnitZ(), p.z()};
  double x = p.x(), y = p.y();
  TopHeight h = heightOf(top, x, y);
  double far = squareTo(p, x, y, h.z);
  for (int i = 0; i < kMostSteps; ++i) {
    Eigen::Vector2d step = stepToward(p, x, y, h);
    for (int k = 0; k < kMostHalvings; ++k, step *= 0.5) {
      const TopHeight there = heightOf(top, x + step.x(), y + step.y());
      const double now = squareTo(p, x + step.x(), y + step.y(), there.z);
      if (now > far) continue;
      x += step.x(), y += step.y();
      h = there;
      far = now;
      break;
    }
    if (!(step.squaredNorm() > kClose * kClose)) break;
  }
  TopFoot foot{Vec3(x, y, h.z), upFrom(h), 0};
  foot.over = (p - foot.p).dot(foot.n);
  return foot;
}

Vec3 alongTop(const TopShape& top, const Vec3& p) noexcept {
  const TopFoot foot = nearestOn(top, p);
  return {foot.p.x(), foot.p.y(), foot.over};
}

Vec3 fromTop(const TopShape& top, const Vec3& along) noexcept {
  if (top.flat()) return along;
  const TopHeight h = heightOf(top, along.x(), along.y());
  return Vec3(along.x(), along.y(), h.z) + along.z() * upFrom(h);
}

/// Rodrigues' rotation about z x n, whose sine and cosine are in n itself.
Mat3 turnToNormal(const Vec3& n) noexcept {
  const double x = n.x(), y = n.y(), z = n.z(), k = 1 / (1 + z);
  Mat3 R;
  R << 1 - k * x * x, -k * x * y, x,  //
      -k * x * y, 1 - k * y * y, y,   //
      -x, -y, z;
  return R;
}

}  // namespace palpa

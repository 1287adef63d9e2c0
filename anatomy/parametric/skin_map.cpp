#include "anatomy/parametric/skin_map.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace palpa::anatomy {
namespace {

constexpr double kAxis_y = 66;  // mm; within trunk, neck and head
constexpr float kNowhere = -1;

using Float3 = std::array<float, 3>;

class SkinRaster {
 public:
  SkinRaster(int width, int height)
      : map_{width, height, {}}, radius_(std::size_t(width) * height, kNowhere) {
    map_.points.resize(radius_.size());
  }

  void draw(const TriangleMesh& mesh, const std::array<std::uint32_t, 3>& corners) {
    std::array<Eigen::Vector2f, 3> uv;
    std::array<Eigen::Vector3f, 3> p;
    for (std::size_t k = 0; k < 3; ++k) {
      const auto& [u, v] = mesh.uvs[corners[k]];
      uv[k] = {u * static_cast<float>(map_.width) - 0.5f,
               v * static_cast<float>(map_.height) - 0.5f};
      p[k] = mesh.points[corners[k]].cast<float>();
    }
    const float area = cross(uv[1] - uv[0], uv[2] - uv[0]);
    if (std::abs(area) < 1e-9f) return;
    const auto [left, right] = span(uv, 0, map_.width);
    const auto [top, bottom] = span(uv, 1, map_.height);
    for (int y = top; y <= bottom; ++y)
      for (int x = left; x <= right; ++x) {
        const Eigen::Vector2f at(x, y);
        const float a = cross(uv[1] - at, uv[2] - at) / area,
                    b = cross(uv[2] - at, uv[0] - at) / area, c = 1 - a - b;
        if (std::min({a, b, c}) >= -1e-4f) put(x, y, a * p[0] + b * p[1] + c * p[2]);
      }
  }

  SkinMap filled() {
    int last = -1;
    for (int y = 0; y < map_.height; ++y)
      if (fillRow(y)) {
        for (int k = last + 1; last < 0 && k < y; ++k) copyRow(y, k);
        last = y;
      } else if (last >= 0) {
        copyRow(last, y);
      }
    return std::move(map_);
  }

 private:
  static float cross(const Eigen::Vector2f& a, const Eigen::Vector2f& b) {
    return a.x() * b.y() - a.y() * b.x();
  }
  static std::pair<int, int> span(const std::array<Eigen::Vector2f, 3>& uv, int axis, int size) {
    const auto [low, high] = std::minmax({uv[0][axis], uv[1][axis], uv[2][axis]});
    return {std::max(0, static_cast<int>(std::ceil(low))),
            std::min(size - 1, static_cast<int>(std::floor(high)))};
  }
  std::size_t index(int x, int y) const { return std::size_t(y) * map_.width + x; }

  void put(int x, int y, const Eigen::Vector3f& p) {
    const float radius = std::hypot(p.x(), p.y() - static_cast<float>(kAxis_y));
    const std::size_t i = index(x, y);
    if (radius <= radius_[i]) return;
    radius_[i] = radius;
    map_.points[i] = {std::abs(p.x()), p.y(), p.z()};
  }

  // Gaps get the neighbour on their left, those at the row's start the first that is there.
  bool fillRow(int y) {
    int first = 0;
    while (first < map_.width && radius_[index(first, y)] < 0) ++first;
    if (first == map_.width) return false;
    for (int x = 0; x < first; ++x) map_.points[index(x, y)] = map_.points[index(first, y)];
    for (int x = first + 1; x < map_.width; ++x)
      if (radius_[index(x, y)] < 0) map_.points[index(x, y)] = map_.points[index(x - 1, y)];
    return true;
  }
  void copyRow(int from, int to) {
    std::copy_n(map_.points.begin() + static_cast<std::ptrdiff_t>(index(0, from)), map_.width,
                map_.points.begin() + static_cast<std::ptrdiff_t>(index(0, to)));
  }

  SkinMap map_;
  std::vector<float> radius_;  // of what is drawn there; kNowhere: nothing
};

}  // namespace

void layPicture(TriangleMesh* skin_B_mm) {
  double top = -1e9, bottom = 1e9;
  for (const Vec3& p : skin_B_mm->points) {
    top = std::max(top, p.z());
    bottom = std::min(bottom, p.z());
  }
  skin_B_mm->uvs.clear();
  for (const Vec3& p : skin_B_mm->points) {
    const double u = std::atan2(std::abs(p.x()), kAxis_y - p.y()) / std::numbers::pi;
    skin_B_mm->uvs.push_back(
        {static_cast<float>(u), static_cast<float>((top - p.z()) / (top - bottom))});
  }
}

SkinMap mapOfSkin(const TriangleMesh& skin_B_mm, int width, int height) {
  SkinRaster raster(width, height);
  for (const auto& corners : skin_B_mm.triangles) {
    const bool plus = std::any_of(corners.begin(), corners.end(),
                                  [&](std::uint32_t c) { return skin_B_mm.points[c].x() >= 0; });
    if (plus) raster.draw(skin_B_mm, corners);  // the other side is its mirror image
  }
  return raster.filled();
}

}  // namespace palpa::anatomy

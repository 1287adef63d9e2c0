#include "anatomy/parametric/skin_texture.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "anatomy/base/random.h"
#include "anatomy/shapes/value_noise.h"

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

namespace {

constexpr int kPicture = 1024;
constexpr std::uint64_t kToneStream = 0x746f6e65;  // apart from what draws the body
constexpr float kNotAt = 40;  // y (mm) behind which nothing of the face or breast lies

using Tone = std::array<float, 3>;
// From very light to dark brown, sRGB; the second is what the plain skin was drawn in before.
constexpr std::array<Tone, 5> kTones{{{0.95f, 0.80f, 0.72f},
                                      {0.89f, 0.71f, 0.61f},
                                      {0.78f, 0.59f, 0.47f},
                                      {0.61f, 0.43f, 0.33f},
                                      {0.43f, 0.29f, 0.22f}}};
constexpr Tone kFlush{1.03f, 0.80f, 0.79f}, kAreola{0.80f, 0.60f, 0.57f},
    kLips{0.90f, 0.58f, 0.59f}, kHair{0.38f, 0.30f, 0.26f}, kLid{0.62f, 0.48f, 0.45f};

float ramp(float from, float to, float x) {
  const float t = std::clamp((x - from) / (to - from), 0.0f, 1.0f);
  return t * t * (3 - 2 * t);
}

float hill(float square, float wide) {
  return square > 9 * wide * wide ? 0 : std::exp(-0.5f * square / (wide * wide));
}

void tint(Tone* tone, const Tone& pigment, float share) {
  for (std::size_t k = 0; k < 3; ++k) (*tone)[k] *= 1 + share * (pigment[k] - 1);
}

/// All at points of the shapes' body (Build::unplace), mm.
class SkinPainter {
 public:
  SkinPainter(const Build& build, std::uint64_t seed)
      : build_(build),
        tone_(skinTone(seed)),
        wide_(seed + 1, 42),
        middle_(seed + 2, 15),
        fine_(seed + 3, 5),
        pores_(seed + 4, 1.3),
        hairs_(seed + 5, 1.0) {}

  Tone at(const std::array<float, 3>& p) const {
    const Vec3 there = build_.unplace({p[0], p[1], p[2]});
    const float x = static_cast<float>(there.x()), y = p[1], z = static_cast<float>(there.z());
    const float blotch = 0.6f * wide_(p) + 0.4f * middle_(p), small = fine_(p);
    Tone tone = tone_;
    tint(&tone, kFlush, 0.10f + 0.16f * blotch + 0.08f * small);
    const float shade = 1 + 0.022f * blotch + 0.018f * small + 0.035f * pores_(p);
    for (float& c : tone) c *= shade;
    if (y < kNotAt && z > 110) face(&tone, x, y, z, p, small);
    if (y < kNotAt && z < -60) areola(&tone, x, z, p, small);
    return tone;
  }

 private:
  void face(Tone* tone, float x, float y, float z, const std::array<float, 3>& p,
            float small) const {
    tint(tone, kFlush,
         0.42f * hill((x - 41) * (x - 41) + (z - 196) * (z - 196) * 1.4f, 15) +
             0.25f * hill(x * x + (z - 188) * (z - 188), 9));
    if (x < 24 && y < 12) lips(tone, x, z, small);
    // Brow: an arc over the socket, thinning outward.
    const float along = (x - 13) / 36, middle = 233.5f + 4.5f * std::sin(2.2f * along),
                half = 3.3f - 1.6f * along;
    if (along > -0.1f && along < 1.1f) {
      const float brow = ramp(-0.06f, 0.12f, along) * ramp(1.06f, 0.7f, along) *
                         ramp(half, 0.35f * half, std::abs(z - middle));
      tint(tone, kHair, brow * (0.55f + 0.25f * hairs_(p)));
    }
    const float across = (x - 31) / 12.5f, lid = 213.5f + 2.6f * across * across;
    if (std::abs(across) < 1)
      tint(tone, kLid,
           0.75f * ramp(1, 0.75f, std::abs(across)) * ramp(1.3f, 0.4f, std::abs(z - lid)));
  }

  void lips(Tone* tone, float x, float z, float small) const {
    const float away = 1 - (x / 22) * (x / 22);
    if (away <= 0) return;
    const float upper = 160 + 6.2f * away * (1 - 0.22f * hill(x * x, 2.5f)),
                lower = 160 - 7.6f * std::pow(away, 0.75f);
    const float inside = ramp(1.1f, -0.7f, z - upper) * ramp(-1.1f, 0.7f, z - lower);
    tint(tone, kLips, inside * (0.80f + 0.15f * small));
    tint(tone, kLid, 0.6f * ramp(0, 0.25f, away) * ramp(1.1f, 0.3f, std::abs(z - 160)));
  }

  void areola(Tone* tone, float x, float z, const std::array<float, 3>& p, float small) const {
    const float radius = build_.female ? 17.0f : 11.5f, nipple = build_.female ? 5.0f : 3.0f;
    const float dx = (x - (build_.female ? 90.0f : 92.0f)),
                dz = z - (build_.female ? -134.0f : -112.0f);
    const float distance = std::hypot(dx, dz);
    if (distance > 2 * radius) return;
    const float edge = radius * (1 + 0.06f * middle_(p) + 0.05f * small);
    tint(tone, kAreola, (0.60f + 0.14f * pores_(p)) * ramp(edge + 2.6f, edge - 2.6f, distance));
    tint(tone, kAreola, 0.50f * ramp(nipple + 1.0f, nipple - 1.0f, distance));
  }

  const Build& build_;
  Tone tone_;
  ValueNoise wide_, middle_, fine_, pores_, hairs_;
};

}  // namespace

std::array<float, 3> skinTone(std::uint64_t seed) {
  RandomStream random = RandomStream::ofSeed(seed ^ kToneStream);
  const double t = seed == 0 ? 1.0 : random.openUniform() * (kTones.size() - 1.0);
  const auto i = std::min(static_cast<std::size_t>(t), kTones.size() - 2);
  const float share = static_cast<float>(t - static_cast<double>(i));
  Tone tone;
  for (std::size_t k = 0; k < 3; ++k)
    tone[k] = kTones[i][k] + share * (kTones[i + 1][k] - kTones[i][k]);
  return tone;
}

RgbPicture paintSkin(const TriangleMesh& skin_B_mm, const Build& build, std::uint64_t seed) {
  const SkinMap map = mapOfSkin(skin_B_mm, kPicture, kPicture);
  const SkinPainter painter(build, seed);
  RgbPicture texture{map.width, map.height, {}};
  texture.rgb.reserve(3 * map.points.size());
  for (const std::array<float, 3>& p : map.points)
    for (const float c : painter.at(p))
      texture.rgb.push_back(
          static_cast<std::uint8_t>(std::lround(255 * std::clamp(c, 0.0f, 1.0f))));
  return texture;
}

}  // namespace palpa::anatomy

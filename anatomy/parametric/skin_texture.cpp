#include "anatomy/parametric/skin_texture.h"

#include <algorithm>
#include <cmath>

#include "anatomy/parametric/skin_map.h"
#include "anatomy/random_stream.h"
#include "anatomy/shapes/value_noise.h"

namespace palpa::anatomy {
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
  RandomStream random(seed ^ kToneStream);
  const double t = seed == 0 ? 1.0 : random.uniform() * (kTones.size() - 1.0);
  const auto i = std::min(static_cast<std::size_t>(t), kTones.size() - 2);
  const float share = static_cast<float>(t - static_cast<double>(i));
  Tone tone;
  for (std::size_t k = 0; k < 3; ++k)
    tone[k] = kTones[i][k] + share * (kTones[i + 1][k] - kTones[i][k]);
  return tone;
}

Texture paintSkin(const TriangleMesh& skin_B_mm, const Build& build, std::uint64_t seed) {
  const SkinMap map = mapOfSkin(skin_B_mm, kPicture, kPicture);
  const SkinPainter painter(build, seed);
  Texture texture{map.width, map.height, {}};
  texture.rgb.reserve(3 * map.points.size());
  for (const std::array<float, 3>& p : map.points)
    for (const float c : painter.at(p))
      texture.rgb.push_back(
          static_cast<std::uint8_t>(std::lround(255 * std::clamp(c, 0.0f, 1.0f))));
  return texture;
}

}  // namespace palpa::anatomy

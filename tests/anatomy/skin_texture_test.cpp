#include <gtest/gtest.h>

#include <map>

#include "anatomy/base/error.h"
#include "anatomy/parametric/skin_texture.h"
#include "anatomy/patient/gltf.h"
#include "anatomy/shapes/mesh_tools.h"
#include "test_shapes.h"

namespace palpa::anatomy {
namespace {

std::array<int, 3> pixelAt(const RgbPicture& texture, const std::array<float, 2>& uv) {
  const auto pick = [](float t, int size) {
    return std::min(size - 1, static_cast<int>(t * static_cast<float>(size)));
  };
  const std::size_t i =
      3 * (std::size_t(pick(uv[1], texture.height)) * texture.width + pick(uv[0], texture.width));
  return {texture.rgb[i], texture.rgb[i + 1], texture.rgb[i + 2]};
}

/// Mean colour of the skin's vertices within `reach` of a place on its front (x, z), m.
std::array<double, 3> meanNear(const OrganSurface& skin, double x, double z, double reach) {
  std::array<double, 3> sum{};
  int count = 0;
  for (std::size_t i = 0; i < skin.mesh.points.size(); ++i) {
    const Vec3& p = skin.mesh.points[i];
    if (p.y() > 0.03 || std::hypot(p.x() - x, p.z() - z) > reach) continue;
    const auto rgb = pixelAt(skin.texture, skin.mesh.uvs[i]);
    for (std::size_t k = 0; k < 3; ++k) sum[k] += rgb[k];
    ++count;
  }
  EXPECT_GT(count, 0) << x << " " << z;
  for (double& s : sum) s /= std::max(count, 1);
  return sum;
}

double luminance(const std::array<double, 3>& rgb) {
  return 0.3 * rgb[0] + 0.6 * rgb[1] + 0.1 * rgb[2];
}

TEST(SkinTexture, LiesOnAClosedMeshWithOneCoordinateAVertexAlikeOnBothSides) {
  const OrganSurface& skin = referencePatient().organ(Organ::skin);
  ASSERT_EQ(skin.mesh.uvs.size(), skin.mesh.points.size());
  ASSERT_EQ(skin.texture.rgb.size(), std::size_t{3} * skin.texture.width * skin.texture.height);
  EXPECT_TRUE(isClosed(skin.mesh));
  double front = 1, back = 0;
  for (std::size_t i = 0; i < skin.mesh.uvs.size(); ++i) {
    const auto& [u, v] = skin.mesh.uvs[i];
    ASSERT_TRUE(u >= 0 && u <= 1 && v >= 0 && v <= 1) << i;
    const Vec3& p = skin.mesh.points[i];
    // By the definition in skin_texture.h, computed another way: the cosine of the angle.
    ASSERT_NEAR(std::cos(std::numbers::pi * u), (0.066 - p.y()) / std::hypot(p.x(), 0.066 - p.y()),
                2e-5);
    if (p.y() < 0.0) front = std::min<double>(front, u);
    if (p.y() > 0.15) back = std::max<double>(back, u);
  }
  EXPECT_LT(front, 0.02);
  EXPECT_GT(back, 0.98);
  // No edge jumps across the picture, as it would at a seam, except at the crown and on the cut,
  // near the axis.
  for (const auto& t : skin.mesh.triangles)
    for (std::size_t k = 0; k < 3; ++k) {
      const Vec3& p = skin.mesh.points[t[k]];
      if (std::hypot(p.x(), p.y() - 0.066) < 0.03) continue;
      ASSERT_LT(std::abs(skin.mesh.uvs[t[k]][0] - skin.mesh.uvs[t[(k + 1) % 3]][0]), 0.15);
    }
}

TEST(SkinTexture, MapFindsTheVerticesAgain) {
  TriangleMesh skin =
      buildPatient(drawParameters(reference(), Side::left, 0)).organ(Organ::skin).mesh;
  for (Vec3& p : skin.points) p *= 1000;
  const SkinMap map = mapOfSkin(skin, 512, 512);
  int good = 0, all = 0;
  for (std::size_t i = 0; i < skin.points.size(); ++i) {
    const Vec3& p = skin.points[i];
    if (p.y() > 20 || p.z() < -150 || p.z() > 60 || std::abs(p.x()) > 90)
      continue;  // the chest's front
    const auto& q = map.points[static_cast<std::size_t>(skin.uvs[i][1] * 511) * 512 +
                               static_cast<std::size_t>(skin.uvs[i][0] * 511)];
    ++all;
    good += (Vec3(q[0], q[1], q[2]) - Vec3(std::abs(p.x()), p.y(), p.z())).norm() <
            5;  // mm; a texel is up to 1.5
  }
  EXPECT_GT(all, 500);
  EXPECT_GT(good, 0.97 * all);
}

TEST(SkinTexture, SameSeedSameBytesAnotherSeedAnotherTone) {
  TriangleMesh skin = sphereMesh(100, 12);
  layPicture(&skin);
  const RgbPicture one = paintSkin(skin, Build{}, 7), again = paintSkin(skin, Build{}, 7),
                   other = paintSkin(skin, Build{}, 8);
  EXPECT_EQ(one.rgb, again.rgb);
  EXPECT_NE(one.rgb, other.rgb);
  float darkest = 1, lightest = 0;
  for (std::uint64_t seed = 0; seed < 200; ++seed) {
    const auto tone = skinTone(seed);
    EXPECT_GT(tone[0], tone[1]);  // skin is reddish in every tone
    EXPECT_GT(tone[1], tone[2]);
    darkest = std::min(darkest, tone[0]);
    lightest = std::max(lightest, tone[0]);
  }
  EXPECT_LT(darkest, 0.5f);
  EXPECT_GT(lightest, 0.9f);
}

TEST(SkinTexture, AreolaeAreDarkerThanTheSkinRoundThemAndLipsAreRedder) {
  for (const Sex sex : {Sex::female, Sex::male}) {
    Person person;
    person.sex = sex;
    PatientParameters p = drawParameters(reference(), Side::right, 0, person);
    const Patient patient = buildPatient(p);
    const Build build = buildOf(p);
    const OrganSurface& skin = patient.organ(Organ::skin);
    const Vec3 nipple =
        1e-3 * build.place(sex == Sex::female ? Vec3(90, 0, -134) : Vec3(92, 0, -112));
    for (const double side : {-1.0, 1.0})
      EXPECT_LT(luminance(meanNear(skin, side * nipple.x(), nipple.z(), 0.006)),
                0.85 * luminance(meanNear(skin, side * nipple.x(), nipple.z() + 0.035, 0.006)));
    const Vec3 mouth = 1e-3 * build.place({0, 0, 160}), chin = 1e-3 * build.place({0, 0, 138});
    const auto lips = meanNear(skin, 0, mouth.z(), 0.006),
               skin_there = meanNear(skin, 0, chin.z(), 0.006);
    EXPECT_GT(lips[0] / lips[1], 1.15 * skin_there[0] / skin_there[1]);
  }
}

RgbPicture smallPicture() {
  RgbPicture texture{5, 3, {}};
  for (int i = 0; i < 45; ++i) texture.rgb.push_back(static_cast<std::uint8_t>(37 * i));
  return texture;
}

TEST(Picture, ComesBackFromPngAsItWas) {
  const RgbPicture written = smallPicture();
  const auto png = pngOf(written, "test");
  const RgbPicture read = textureOfPng(png.data(), png.size(), "test");
  EXPECT_EQ(read.width, 5);
  EXPECT_EQ(read.height, 3);
  EXPECT_EQ(read.rgb, written.rgb);
  RgbPicture wrong = written;
  wrong.rgb.pop_back();
  EXPECT_THROW(pngOf(wrong, "test"), Error);
}

TEST(Picture, ClaimsAreCheckedBeforeDecoding) {
  const auto png = pngOf(smallPicture(), "test");
  const auto changed = [&](std::size_t at, unsigned char to) {
    auto bytes = png;
    bytes[at] = to;
    return bytes;
  };
  for (const auto& bytes : {changed(0, 'x'), changed(16, 0x7f) /* 2 billion wide */,
                            changed(22, 0x7f) /* 32 515 high */, changed(24, 16)})
    EXPECT_THROW(textureOfPng(bytes.data(), bytes.size(), "test"), Error);
  for (std::size_t size = 0; size < png.size() - 12; ++size)
    EXPECT_THROW(textureOfPng(png.data(), size, "test"), Error) << size;
  auto padded = png;
  padded.resize(png.size() + (1 << 20));
  EXPECT_THROW(textureOfPng(padded.data(), padded.size(), "test"), Error);
}

}  // namespace
}  // namespace palpa::anatomy

#include <gtest/gtest.h>

#include <Eigen/Geometry>

#include "anatomy/base/error.h"
#include "anatomy/volume/volume.h"
#include "sample_volumes.h"

namespace palpa::anatomy {
namespace {

using namespace test;

const BytesBeside kNothing = [](const std::string&) { return std::string(); };

Mat3 oblique() {
  return Eigen::AngleAxisd(0.3, Vec3(1, 2, 3).normalized()).toRotationMatrix() *
         Vec3(0.7e-3, 0.9e-3, 2.5e-3).asDiagonal();
}

Volume numbered(const Mat3& steps = oblique()) {
  float next = -3;
  return sampled({5, 4, 3}, steps, {0.01, -0.02, 0.03}, [&](const Vec3&) { return next += 1; });
}

void expectSame(const Volume& a, const Volume& b) {
  EXPECT_EQ(a.size, b.size);
  EXPECT_EQ(a.values, b.values);
  EXPECT_LT((a.steps_S - b.steps_S).norm(),
            2e-8);  // six decimals of a cosine, single precision in NIfTI
  EXPECT_LT((a.origin_S - b.origin_S).norm(), 2e-8);
}

TEST(MetaImage, EveryTypeObliqueAndCompressed) {
  const Volume v = numbered();
  Volume positive = v;
  for (float& x : positive.values) x += 10;
  for (const bool packed : {false, true}) {
    expectSame(
        readMetaImage(asMha(v, "MET_CHAR", bytesOfVoxels<std::int8_t>(v), packed), "t", kNothing),
        v);
    expectSame(
        readMetaImage(asMha(positive, "MET_UCHAR", bytesOfVoxels<std::uint8_t>(positive), packed),
                      "t", kNothing),
        positive);
    expectSame(
        readMetaImage(asMha(v, "MET_SHORT", bytesOfVoxels<std::int16_t>(v), packed), "t", kNothing),
        v);
    expectSame(
        readMetaImage(asMha(v, "MET_SHORT", bytesOfVoxels<std::int16_t>(v, true), packed, true),
                      "t", kNothing),
        v);
    expectSame(
        readMetaImage(asMha(positive, "MET_USHORT", bytesOfVoxels<std::uint16_t>(positive), packed),
                      "t", kNothing),
        positive);
    expectSame(
        readMetaImage(asMha(v, "MET_INT", bytesOfVoxels<std::int32_t>(v), packed), "t", kNothing),
        v);
    expectSame(readMetaImage(asMha(v, "MET_FLOAT", bytesOfVoxels<float>(v), packed), "t", kNothing),
               v);
    expectSame(
        readMetaImage(asMha(v, "MET_DOUBLE", bytesOfVoxels<double>(v), packed), "t", kNothing), v);
  }
}

TEST(MetaImage, AnatomicalOrientationSaysWhereAxesComeFrom) {
  std::string file = asMha(numbered(), "MET_FLOAT", bytesOfVoxels<float>(numbered()), false);
  const std::size_t at = file.find("TransformMatrix"), end = file.find('\n', at);
  EXPECT_EQ(axesOf(readMetaImage(file.replace(at, end - at, "AnatomicalOrientation = RAI"), "t",
                                 kNothing)),
            "LPS");
  EXPECT_EQ(axesOf(readMetaImage(file.replace(file.find("= RAI"), 5, "= RPS"), "t", kNothing)),
            "LAI");
}

TEST(MetaImage, VoxelsBesideTheHeader) {
  const Volume v = numbered();
  std::string header = asMha(v, "MET_FLOAT", "", false);
  header.replace(header.find("LOCAL"), 5, "v.raw");
  std::string asked;
  expectSame(readMetaImage(header, "t",
                           [&](const std::string& name) {
                             asked = name;
                             return bytesOfVoxels<float>(v);
                           }),
             v);
  EXPECT_EQ(asked, "v.raw");
  header.replace(header.find("v.raw"), 5, "../v");
  EXPECT_THROW(readMetaImage(header, "t", kNothing), Error);
}

TEST(Nifti, SformQformScaleAndGzip) {
  const Volume v = numbered();
  const std::string file = asNifti(v, 16, 32, bytesOfVoxels<float>(v), true);
  expectSame(readNifti(file, "t"), v);
  expectSame(readNifti(deflated(file, true), "t"), v);
  expectSame(readNifti(asNifti(v, 4, 16, bytesOfVoxels<std::int16_t>(v), true), "t"), v);
  expectSame(readNifti(asNifti(v, 256, 8, bytesOfVoxels<std::int8_t>(v), true), "t"), v);
  // LPS steps of this turn are RAS steps R diag(s), R = diag(-1,-1,1) * turn * diag(1,1,1): a
  // rotation by half a turn about z first.
  const Mat3 turn = Vec3(-1, -1, 1).asDiagonal() * oblique();
  Eigen::Quaterniond q(Mat3(turn.colwise().normalized()));
  if (q.w() < 0) q.coeffs() *= -1;
  const double bcd[4] = {1, q.x(), q.y(), q.z()};
  expectSame(readNifti(asNifti(v, 16, 32, bytesOfVoxels<float>(v), false, bcd), "t"), v);
  std::string scaled = file;
  const float slope = 2, intercept = 7;
  std::memcpy(scaled.data() + 112, &slope, 4), std::memcpy(scaled.data() + 116, &intercept, 4);
  EXPECT_EQ(readNifti(scaled, "t").values[4], 2 * v.values[4] + 7);
}

TEST(Nifti, WithoutAFormItLiesInItsOwnWorld) {
  EXPECT_EQ(
      axesOf(readNifti(asNifti(numbered(), 16, 32, bytesOfVoxels<float>(numbered()), false), "t")),
      "RAS");
}

TEST(Axes, AllProperTurnsComeBackToTheSamePlaces) {
  const auto value = [](const Vec3& p) {
    return static_cast<float>(std::round(1e3 * p.x()) + 100 * std::round(1e3 * p.y()) +
                              1e4 * std::round(1e3 * p.z()));
  };
  int turns = 0;
  std::array<int, 3> order{0, 1, 2};
  do
    for (int signs = 0; signs < 8; ++signs) {
      Mat3 steps = Mat3::Zero();
      for (int a = 0; a < 3; ++a)
        steps(order[static_cast<std::size_t>(a)], a) = (signs >> a & 1 ? -1 : 1) * (a + 1) * 1e-3;
      if (steps.determinant() < 0) continue;
      ++turns;
      const Volume v = sampled({3, 4, 5}, steps, {0.005, 0.006, 0.007}, value),
                   along = alongBody(v);
      EXPECT_EQ(axesOf(along), "LPS");
      for (int k = 0; k < along.size[2]; ++k)
        for (int j = 0; j < along.size[1]; ++j)
          for (int i = 0; i < along.size[0]; ++i)
            ASSERT_EQ(along.at(i, j, k), value(along.pointToS(Vec3(i, j, k))));
    }
  while (std::next_permutation(order.begin(), order.end()));
  EXPECT_EQ(turns, 24);
}

TEST(Axes, AnOverrideOfTheOtherHandMustBeSaid) {
  Volume v = numbered();
  EXPECT_EQ(axesOf(v), "LPS");
  overrideAxes("LAI", false, &v);
  EXPECT_EQ(axesOf(v), "LAI");
  EXPECT_THROW(overrideAxes("RAI", false, &v), UsageError);
  overrideAxes("RAI", true, &v);
  EXPECT_EQ(axesOf(v), "RAI");
  for (const char* wrong : {"", "LP", "LLS", "LPX", "LPSS"})
    EXPECT_THROW(overrideAxes(wrong, true, &v), UsageError) << wrong;
}

TEST(Claims, NothingIsTakenForWhatIsNotThere) {
  const Volume v = numbered();
  for (const char* size :
       {"4096 4096 4096", "2000000000 2 2", "4000 4000 10", "-3 4 5", "1 1 1", "nan 2 2"})
    for (const bool packed : {false, true}) {
      std::string file = asMha(v, "MET_SHORT", bytesOfVoxels<std::int16_t>(v), packed);
      const std::size_t at = file.find("DimSize"), end = file.find('\n', at);
      file.replace(at, end - at, std::string("DimSize = ") + size);
      EXPECT_THROW(readMetaImage(file, "t", kNothing), Error) << size;
    }
  std::string bomb = asMha(v, "MET_UCHAR", std::string(1 << 22, '\0'),
                           true);  // inflates to far more than the header says
  EXPECT_THROW(readMetaImage(bomb, "t", kNothing), Error);
  for (const char* spacing : {"nan 1 1", "0 1 1", "1e30 1 1", "inf 1 1"}) {
    std::string file = asMha(v, "MET_SHORT", bytesOfVoxels<std::int16_t>(v), false);
    const std::size_t at = file.find("ElementSpacing"), end = file.find('\n', at);
    file.replace(at, end - at, std::string("ElementSpacing = ") + spacing);
    EXPECT_THROW(readMetaImage(file, "t", kNothing), Error) << spacing;
  }
  EXPECT_THROW(readMetaImage("", "t", kNothing), Error);
  EXPECT_THROW(readNifti("", "t"), Error);
}

}  // namespace
}  // namespace palpa::anatomy

#include "scene/view/anatomical_plate.h"

#include <gtest/gtest.h>

#include "anatomy/base/error.h"
#include "tests/scene/offscreen.h"

/// Plates to print.
namespace palpa::scene {
namespace {

constexpr double kBall = 0.05, kCore = 0.02;

/// A ball of skin about a vein: what a cut shows is known.
anatomy::Patient ballWithCore() {
  anatomy::Patient patient = test::spherePatient({0, 0, 0}, kBall);
  patient.organs.front().organ = Organ::skin;
  test::add(patient, "core", Organ::vein, test::sphere({0, 0, 0}, Vec3::Constant(kCore)));
  return patient;
}

Image plateOf(const anatomy::Patient& patient, std::optional<double> section, SkinStyle skin) {
  PlateWish wish;
  wish.section = section;
  wish.skin = skin;
  wish.width = 800;
  wish.height = 600;
  return anatomicalPlate(offscreen(), patient, wish);
}

bool isBlue(const Pixel& p) { return p.b > p.r + 40; }
bool isFat(const Pixel& p) { return p.r > 190 && p.r > p.b + 40 && p.g > p.b + 25; }

Blob blue(const Image& image) {
  return blobOf(image, [&](int u, int v) { return isBlue(at(image, u, v)); });
}

TEST(AnatomicalPlate, IsCutWhereOneSays) {
  const anatomy::Patient patient = ballWithCore();
  const Image whole = plateOf(patient, std::nullopt, SkinStyle::solid);
  EXPECT_EQ(blue(whole).count, 0) << "the skin hides it";
  const Image middle = plateOf(patient, 0.0, SkinStyle::solid);
  const Blob core = blue(middle);
  ASSERT_GT(core.count, 1000);
  const Blob fat = blobOf(middle, [&](int u, int v) {
    const Pixel p = at(middle, u, v);
    return isFat(p) || isBlue(p);
  });
  EXPECT_NEAR(double(core.right - core.left) / (fat.right - fat.left), kCore / kBall, 0.03);
  // A cut 16 mm further shows 2 sqrt(20^2 - 16^2) = 24 mm of the core.
  const Blob deeper = blue(plateOf(patient, 0.016, SkinStyle::solid));
  EXPECT_NEAR(double(deeper.right - deeper.left) / (core.right - core.left), 0.6, 0.05);
  EXPECT_EQ(blue(plateOf(patient, 0.03, SkinStyle::solid)).count, 0) << "beyond the core";
}

TEST(AnatomicalPlate, NamesWhatIsSeenAndHasAScale) {
  const Image plate = plateOf(ballWithCore(), std::nullopt, SkinStyle::hidden);
  const auto dark = [&](int left, int right, int top, int bottom) {
    return blobOf(plate, [&](int u, int v) {
      return u >= left && u < right && v >= top && v < bottom && luminance(at(plate, u, v)) < 0.1;
    });
  };
  // One kind is seen: its name stands in the right column, its line ends in the ball's middle.
  EXPECT_GT(dark(680, 800, 250, 350).count, 30);
  EXPECT_EQ(dark(0, 20, 100, 250).count, 0);
  const Blob bar = dark(600, 800, 581, 588);
  EXPECT_GT(bar.right - bar.left, 20);
  EXPECT_GT(luminance(at(plate, 5, 5)), 0.95) << "on white";
}

TEST(AnatomicalPlate, IsRefusedWhereItCannotBe) {
  PlateWish wish;
  wish.width = 10;
  EXPECT_THROW(anatomicalPlate(offscreen(), ballWithCore(), wish), UsageError);
  anatomy::Patient skin = test::spherePatient({0, 0, 0}, kBall);
  skin.organs.front().organ = Organ::skin;
  EXPECT_THROW(plateOf(skin, std::nullopt, SkinStyle::hidden), UsageError);
}

}  // namespace
}  // namespace palpa::scene

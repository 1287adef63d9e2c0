#include "scene/view/contact_sheet.h"

#include <gtest/gtest.h>

#include "tests/scene/offscreen.h"

namespace palpa::scene {
namespace {

constexpr int kSide = 600, kTile = kSide / 3;

/// Pixels of a tile that are not its background, without the margin where the words stand.
Blob drawn(const Image& sheet, int row, int column) {
  const Pixel background = at(sheet, column * kTile + kTile / 2, row * kTile + 3);
  return blobOf(sheet, [&](int u, int v) {
    const int x = u - column * kTile, y = v - row * kTile;
    return x > kTile / 8 && x < kTile * 7 / 8 && y > kTile / 8 && y < kTile * 7 / 8 &&
           difference(at(sheet, u, v), background) > 12;
  });
}

TEST(ContactSheet, ShowsThePatientThreeTimesFromThreeSides) {
  const anatomy::Patient patient = test::simplePatient();
  const Image sheet = contactSheet(offscreen(), patient, kSide, kSide);
  ASSERT_EQ(sheet.width, kSide);
  ASSERT_EQ(sheet.height, kSide);
  for (int column = 0; column < 3; ++column) {
    const Blob solid = drawn(sheet, 0, column), translucent = drawn(sheet, 1, column),
               organs = drawn(sheet, 2, column);
    EXPECT_GT(solid.count, 500) << column;
    EXPECT_GT(organs.count, 50) << column;
    EXPECT_LE(translucent.count, solid.count) << column;
  }
  // The same patient in the same scale: front and side are equally high, front and top equally
  // wide.
  EXPECT_NEAR(drawn(sheet, 0, 0).bottom - drawn(sheet, 0, 0).top,
              drawn(sheet, 0, 1).bottom - drawn(sheet, 0, 1).top, 2);
  EXPECT_NEAR(drawn(sheet, 0, 0).right - drawn(sheet, 0, 0).left,
              drawn(sheet, 0, 2).right - drawn(sheet, 0, 2).left, 2);
}

// A ball of 20 mm in a larger one: the third row shows it as large as the others show the whole.
TEST(ContactSheet, ThirdRowIsFramedOnWhatItShows) {
  anatomy::Patient patient = test::spherePatient({0, 0, 0}, 0.1);
  patient.organs.front().organ = Organ::skin;
  test::add(patient, "lump", Organ::inclusion,
            test::sphere({0.04, 0.02, -0.03}, Vec3::Constant(0.01)));
  const Image sheet = contactSheet(offscreen(), patient, kSide, kSide);
  for (int column = 0; column < 3; ++column) {
    const Pixel background = at(sheet, column * kTile + kTile / 2, 3);
    const auto wide = [&](int row) {
      int count = 0;  // along the tile's middle
      for (int u = column * kTile + 20; u < (column + 1) * kTile - 20; ++u)
        count += difference(at(sheet, u, row * kTile + kTile / 2 + 12), background) > 12;
      return count;
    };
    EXPECT_NEAR(wide(2), wide(0), 6) << column;
    EXPECT_GT(wide(2), kTile / 2) << column;
  }
}

TEST(ContactSheet, RefusesAPageThatCannotBe) {
  const anatomy::Patient patient = test::simplePatient();
  EXPECT_THROW(contactSheet(offscreen(), patient, 10, 600), UsageError);
  EXPECT_THROW(contactSheet(offscreen(), patient, 600, 100'000), UsageError);
}

}  // namespace
}  // namespace palpa::scene

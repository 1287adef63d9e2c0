#include <gtest/gtest.h>

#include <cmath>

#include "apps/headset/headset_view.h"
#include "tests/headset/worn.h"

/// What each eye is shown, against the geometry in OpenXR's own axes: the eyes at (-+0.032, 0, 0),
/// the ball 0.45 m ahead and 0.25 m below.
namespace palpa::headset {
namespace {

constexpr double kDegree = 3.14159265358979 / 180;
constexpr double kAhead = 0.45, kBelow = 0.25, kApart = 0.064, kBall = 0.03;

struct Seen {
  int count = 0;
  double u = 0, v = 0;
};

template <class Chosen>
Seen seenIn(const test::XrPicture& picture, Chosen chosen) {
  Seen seen;
  for (int v = 0; v < picture.height; ++v)
    for (int u = 0; u < picture.width; ++u)
      if (chosen(picture.at(u, v))) ++seen.count, seen.u += u, seen.v += v;
  seen.u /= std::max(seen.count, 1);
  seen.v /= std::max(seen.count, 1);
  return seen;
}

/// Where the ball's outline has its middle in a picture of that size, by the angles that the test
/// runtime gives.
Eigen::Vector2d expected(int eye, int width, int height, double apart = kApart) {
  const double left = std::tan((eye == 0 ? -48 : -40) * kDegree),
               right = std::tan((eye == 0 ? 40 : 48) * kDegree);
  const double up = std::tan(42 * kDegree), down = std::tan(-46 * kDegree);
  const double x = (eye == 0 ? 0.5 : -0.5) * apart, y = -kBelow,
               outline = kAhead / (kAhead * kAhead - kBall * kBall);
  return {width * (x * outline - left) / (right - left) - 0.5,
          height * (up - y * outline) / (up - down) - 0.5};
}

TEST(HeadsetPictures, BothEyesSeeTheBallWhereItIs) {
  // The patient lies before them however they are turned; also where only their turn is known.
  for (const char* eyes : {"640x600,640x600", "500x420,640x600", "640x600,640x600;turned=90",
                           "640x600,640x600;turned=-130", "640x600,640x600;turned=75;position=0"}) {
    Worn worn(std::string("blend=additive;eyes=") + eyes, kBall);
    ASSERT_EQ(worn.show(3), 3);
    for (int eye = 0; eye < 2; ++eye) {
      const test::XrPicture picture = worn.xr.picture(eye);
      const Seen ball =
          seenIn(picture, [](const unsigned char* p) { return p[0] + p[1] + p[2] > 30; });
      ASSERT_GT(ball.count, 500);
      const bool placed = std::string(eyes).find("position=0") == std::string::npos;
      const Eigen::Vector2d there =
          expected(eye, picture.width, picture.height,
                   placed ? kApart : 0.063);  // the mean of adults, where nothing is known
      EXPECT_NEAR(ball.u, there.x(), 0.3)
          << eyes << ", eye " << eye;  // the outline is in whole pixels
      EXPECT_NEAR(ball.v, there.y(), 0.3) << eyes << ", eye " << eye;
    }
    expectClean(worn.over(), eyes);
  }
}

/// The ball is a vein: where a presentation shows no anatomy, neither eye sees it.
TEST(HeadsetPictures, WhatLiesInsideIsShownOnlyWhereItMayBe) {
  for (const bool inside : {true, false}) {
    HeadsetViewSetup setup = unhurried();
    setup.inside = inside;
    Worn worn("blend=additive;eyes=640x600,640x600", kBall, std::move(setup));
    ASSERT_EQ(worn.show(3), 3);
    for (int eye = 0; eye < 2; ++eye) {
      const Seen ball = seenIn(worn.xr.picture(eye),
                               [](const unsigned char* p) { return p[0] + p[1] + p[2] > 30; });
      EXPECT_EQ(ball.count > 0, inside) << "eye " << eye;
    }
    expectClean(worn.over(), inside ? "inside" : "nothing");
  }
}

TEST(HeadsetPictures, AnyFormatSizeAndNumberOfPictures) {
  for (const char* plan : {"images=1", "images=5;formats=8058", "formats=1234,881A", "formats=8059",
                           "formats=8814", "formats=8C41,8C43", "formats=8059,8058;blend=alpha",
                           "formats=881A,8C43;eyes=300x200,220x260", "position=0", "rate=500"}) {
    Worn worn(plan);
    EXPECT_EQ(worn.show(8), 8) << plan;
    const test::XrReport report = worn.over();
    expectClean(report, plan);
    EXPECT_EQ(calls(report, "layers"), 8) << plan;
    EXPECT_EQ(calls(report, "xrAcquireSwapchainImage"), calls(report, "xrReleaseSwapchainImage"))
        << plan;
  }
}

/// A texture of linear colours holds the light that the encoded one stands for (IEC 61966-2-1).
TEST(HeadsetPictures, LinearTexturesHoldDecodedColours) {
  const auto shown = [](const char* format) {
    Worn worn(std::string("eyes=200x180,200x180;formats=") + format);
    worn.show(2);
    return worn.xr.picture(0);
  };
  const test::XrPicture encoded = shown("8C43"), linear = shown("8058");
  ASSERT_EQ(encoded.rgba.size(), linear.rgba.size());
  int bright = 0;
  for (std::size_t i = 0; i < encoded.rgba.size(); ++i) {
    if (i % 4 == 3) continue;
    const double c = encoded.rgba[i] / 255.0,
                 light = c <= 0.04045 ? c / 12.92 : std::pow((c + 0.055) / 1.055, 2.4);
    EXPECT_NEAR(linear.rgba[i], 255 * light, 1.5);
    bright += c > 0.4;
  }
  EXPECT_GT(bright, 100);
}

TEST(HeadsetPictures, WhatIsNotDrawnIsClear) {
  for (const char* blend : {"additive", "alpha"}) {
    Worn worn(std::string("eyes=200x180,200x180;blend=") + blend);
    worn.show(2);
    const test::XrPicture picture = worn.xr.picture(0);
    const Eigen::Vector2d ball = expected(0, 200, 180);
    const unsigned char *clear = picture.at(20, 20),
                        *drawn = picture.at(static_cast<int>(ball.x()), static_cast<int>(ball.y()));
    EXPECT_EQ(clear[0] + clear[1] + clear[2], 0) << blend;
    EXPECT_GT(drawn[0] + drawn[1] + drawn[2], 60) << blend;
    if (std::string(blend) == "additive") continue;
    EXPECT_EQ(clear[3], 0);
    EXPECT_EQ(drawn[3], 255);
  }
}

TEST(HeadsetPictures, WordsAreReadByBothEyesAMetreAhead) {
  Worn worn("eyes=640x600,640x600;blend=additive");
  scene::SceneState state = Worn::bare();
  worn.show(2, state);
  const test::XrPicture without[] = {worn.xr.picture(0), worn.xr.picture(1)};
  state.hud.phase = "Phase 1: puncture the skin";
  worn.show(2, state);
  Seen words[2];
  for (int eye = 0; eye < 2; ++eye) {
    const test::XrPicture with = worn.xr.picture(eye);
    words[eye] = seenIn(with, [&](const unsigned char* p) {
      return p[0] + p[1] + p[2] > 200 &&
             without[eye].rgba[static_cast<std::size_t>(p - with.rgba.data())] < 20;
    });
    EXPECT_GT(words[eye].count, 100);
  }
  const double f = 640 / (std::tan(48 * kDegree) + std::tan(40 * kDegree));
  const double at_infinity = f * (std::tan(48 * kDegree) - std::tan(40 * kDegree));
  EXPECT_NEAR(words[0].u - words[1].u, at_infinity + f * kApart / 1.0,
              1.5);  // each eye's words begin at a whole pixel
}

TEST(Placement, ThePatientLiesBeforeWhoeverLooksAnywhere) {
  for (const double turned : {0.0, 1.0, -2.5}) {
    for (const double nod : {0.0, -0.6, -1.5, 1.4}) {
      const Mat3 R =
          (Eigen::AngleAxisd(turned, Vec3::UnitZ()) * Eigen::AngleAxisd(nod, Vec3::UnitX()))
              .toRotationMatrix();
      Mat3 level;  // an eye that looks along +y, +z up
      level << Vec3::UnitX(), -Vec3::UnitZ(), Vec3::UnitY();
      std::array<ar::EyeView, 2> eyes;
      for (int i = 0; i < 2; ++i)
        eyes[static_cast<std::size_t>(i)].X_LE =
            makePose(R * level, Vec3(1, 2, 1.6) + R * Vec3((i - 0.5) * kApart, 0, 0));
      const Vec3 focus_W(0.1, -0.05, 0.08);
      const Pose X_LW = placeBefore(eyes, focus_W);
      const Vec3 ahead = Eigen::AngleAxisd(turned, Vec3::UnitZ()) * Vec3::UnitY();
      EXPECT_LT(
          (X_LW * focus_W - (Vec3(1, 2, 1.6) + kAhead * ahead - kBelow * Vec3::UnitZ())).norm(),
          1e-9)
          << turned << ' ' << nod;
      EXPECT_LT((X_LW.linear().col(2) - Vec3::UnitZ()).norm(), 1e-9);
      EXPECT_LT((X_LW.linear().col(1) - ahead).norm(), 1e-9);
    }
  }
}

}  // namespace
}  // namespace palpa::headset

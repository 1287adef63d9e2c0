#include <gtest/gtest.h>

#include "scene/actors/force_arrows.h"
#include "scene/actors/instrument.h"
#include "tests/scene/offscreen.h"

namespace palpa::scene {
namespace {

/// A sheet of skin in front of a ball of artery, seen straight on.
anatomy::Patient ballBehindSkin(bool with_ball) {
  anatomy::Patient patient;
  test::add(patient, "skin", Organ::skin, test::sheet(0.1, [](double, double) { return 0.0; }));
  if (with_ball)
    test::add(patient, "ball", Organ::artery, test::sphere({0, 0.04, 0}, Vec3::Constant(0.02)));
  return patient;
}

class ArFrame : public testing::Test {
 protected:
  Image frameOf(const anatomy::Patient& patient, const SceneState& state) {
    SceneView view(offscreen(), patient, {320, 240, FixedViews::none, true});
    view.show(state);
    return view.capture();
  }
  const Image dark_ = plain(320, 240, 20);
};

TEST_F(ArFrame, SolidSkinHidesTranslucentSkinShowsHiddenSkinIsGone) {
  SceneState state = straightOn(dark_);
  const auto centre = [&](bool with_ball, SkinStyle skin) {
    state.skin = skin;
    return at(frameOf(ballBehindSkin(with_ball), state), 160, 120);
  };
  EXPECT_LE(difference(centre(true, SkinStyle::solid), centre(false, SkinStyle::solid)), 1);
  const Pixel bare = centre(true, SkinStyle::hidden);
  EXPECT_GT(bare.r - bare.b, 80);  // the artery's orange
  const Pixel through = centre(true, SkinStyle::translucent);
  EXPECT_GT(difference(through, centre(false, SkinStyle::translucent)), 40);
  EXPECT_GT(difference(through, bare), 10);
}

class HeldTool : public ArFrame {
 protected:
  SceneState withTool(bool shown) {
    SceneState state = straightOn(dark_);
    state.X_AT = X_AT_;
    state.show_tool = shown;
    return state;
  }
  Eigen::Vector2d onScreen(const Vec3& p_T) {
    const SceneState state = straightOn(dark_);
    return project(state.camera, state.X_CA * (X_AT_ * p_T));
  }
  bool drawnAt(const Image& with, const Image& without, const Vec3& p_T) {
    const Eigen::Vector2d p = onScreen(p_T);
    for (int dv = -1; dv <= 1; ++dv) {
      for (int du = -1; du <= 1; ++du) {
        const int u = static_cast<int>(std::lround(p.x())) + du;
        const int v = static_cast<int>(std::lround(p.y())) + dv;
        if (difference(at(with, u, v), at(without, u, v)) > 10) return true;
      }
    }
    return false;
  }
  // In the plane y = 0, tip right of the middle, pointing right and up.
  const Pose X_AT_ = makePose(rotationWithZ(Vec3(0.8, 0, 0.6)), {0.03, 0, 0.02});
  const anatomy::Patient nobody_ = test::spherePatient({0, 0.5, 0}, 0.001);
};

TEST_F(HeldTool, NeedleIsDrawnWhereItsPoseSaysAndEndsAtTheTip) {
  const Image with = frameOf(nobody_, withTool(true)), without = frameOf(nobody_, withTool(false));
  for (const double z : {-0.005, -0.02, -0.04, -0.065, -0.10, -0.14})
    EXPECT_TRUE(drawnAt(with, without, {0, 0, z})) << z;
  for (const double z : {0.004, 0.010, 0.030}) EXPECT_FALSE(drawnAt(with, without, {0, 0, z})) << z;
  for (const double x : {-0.005, 0.005})  // beside the thin shaft there is nothing
    EXPECT_FALSE(drawnAt(with, without, {x, 0, -0.03})) << x;
}

TEST_F(HeldTool, ProbeIsAsWideAsAFingertipAndReplacesTheNeedle) {
  SceneState state = withTool(true);
  state.tool = Tool::probe;
  state.plunger = state.blood = 0.5;
  const Image with = frameOf(nobody_, state), without = frameOf(nobody_, withTool(false));
  for (const double z : {-0.002, -0.008, -0.05, -0.10})
    EXPECT_TRUE(drawnAt(with, without, {0, 0, z})) << z;
  EXPECT_FALSE(drawnAt(with, without, {0, 0, 0.005}));
  for (const double x : {-0.0065, 0.0065}) {
    EXPECT_TRUE(drawnAt(with, without, {x, 0, -0.008})) << "the half-sphere is 16 mm wide";
    EXPECT_FALSE(drawnAt(with, without, {1.7 * x, 0, -0.008})) << "and no wider";
    EXPECT_FALSE(drawnAt(with, without, {1.4 * x, 0, -0.05})) << "the shaft is thin";
  }
  const Blob red = blobOf(with, [&](int u, int v) {
    const Pixel p = at(with, u, v);
    return p.r > 1.5 * p.g && p.r > 40;
  });
  EXPECT_EQ(red.count, 0) << "a probe draws no blood";
}

TEST_F(ArFrame, PictureOnTheSkinIsDrawnByItsCoordinatesInItsOwnColours) {
  anatomy::Patient patient = ballBehindSkin(false);
  anatomy::OrganSurface& skin = patient.organs.front();
  for (const Vec3& p : skin.mesh.points)
    skin.mesh.uvs.push_back(
        {static_cast<float>(0.5 + p.x() / 0.2), static_cast<float>(0.5 - p.z() / 0.2)});
  // Rows from the top: red, green; blue, gray.
  skin.texture = {2, 2, {200, 20, 20, 20, 200, 20, 20, 20, 200, 120, 120, 120}};
  SceneState state = straightOn(dark_);
  state.skin = SkinStyle::solid;
  const Image frame = frameOf(patient, state);
  const auto seen = [&](double x, double z) {
    const Eigen::Vector2d p = project(state.camera, state.X_CA * Vec3(x, 0, z));
    return at(frame, static_cast<int>(p.x()), static_cast<int>(p.y()));
  };
  const Pixel red = seen(-0.08, 0.08), green = seen(0.08, 0.08), blue = seen(-0.08, -0.08),
              gray = seen(0.08, -0.08);
  EXPECT_GT(red.r, 4 * std::max(red.g, red.b));
  EXPECT_GT(green.g, 4 * std::max(green.r, green.b));
  EXPECT_GT(blue.b, 4 * std::max(blue.r, blue.g));
  EXPECT_LE(std::max({std::abs(gray.r - gray.g), std::abs(gray.g - gray.b)}), 2)
      << "white skin must not tint its picture";
}

/// Told apart by brightness alone, as by whoever sees no red.
TEST_F(HeldTool, AnArterysBloodIsBrightAndAirIsBubbles) {
  const auto seen = [&](Tissue of, double blood) {
    SceneState state = withTool(true);
    state.plunger = 0.6;
    state.blood = blood;
    state.blood_of = of;
    return frameOf(nobody_, state);
  };
  const Image empty = seen(Tissue::vein_lumen, 0), vein = seen(Tissue::vein_lumen, 0.5),
              artery = seen(Tissue::artery_lumen, 0.5), air = seen(Tissue::lung, 0);
  double dark = 0, bright = 0;
  long filled = 0, bubbles = 0;
  for (int v = 0; v < empty.height; ++v)
    for (int u = 0; u < empty.width; ++u) {
      const Pixel none = at(empty, u, v), a = at(vein, u, v), b = at(artery, u, v),
                  c = at(air, u, v);
      bubbles += c.r > none.r + 20 && c.g > none.g + 20 && c.b > none.b + 20;
      if (a.r == none.r && a.g == none.g) continue;
      ++filled;
      dark += 0.2126 * a.r + 0.7152 * a.g + 0.0722 * a.b;
      bright += 0.2126 * b.r + 0.7152 * b.g + 0.0722 * b.b;
    }
  ASSERT_GT(filled, 50);
  EXPECT_GT(bright, 1.3 * dark);
  EXPECT_GT(bubbles, 10);
}

TEST_F(HeldTool, BloodFillsTheSyringeOnlyAsFarAsThePlungerIsDrawn) {
  const auto red = [&](double plunger, double blood) {
    SceneState state = withTool(true);
    state.plunger = plunger;
    state.blood = blood;
    const Image frame = frameOf(nobody_, state);
    return blobOf(frame,
                  [&](int u, int v) {
                    const Pixel p = at(frame, u, v);
                    return p.r > 1.5 * p.g && p.r > 40 && p.r > 1.5 * p.b;
                  })
        .count;
  };
  EXPECT_EQ(red(0.5, 0), 0);
  EXPECT_EQ(red(0, 0.5), 0);
  const int quarter = red(0.5, 0.25), half = red(0.5, 0.5);
  EXPECT_GT(quarter, 50);
  EXPECT_NEAR(half, 2.0 * quarter, 0.25 * half);  // the ends of the column are not to scale
  EXPECT_EQ(red(0.5, 0.9), half);
}

TEST_F(HeldTool, ForceArrowPointsAlongTheForceThirtyMillimetresANewton) {
  SceneState state = withTool(false);
  const Image without = frameOf(nobody_, state);
  const Vec3 f_A = 1.5 * Vec3(-0.6, 0, 0.8);
  state.forces = {{ForceKind::reaction, Vec3(0.01, 0, -0.02), f_A}};
  SceneView view(offscreen(), nobody_, {320, 240, FixedViews::none, true});
  view.show(state);
  const Image with = view.capture();
  const Eigen::Vector2d base = project(state.camera, state.X_CA * state.forces[0].p_A);
  Eigen::Vector2d head = project(
      state.camera, state.X_CA * (state.forces[0].p_A + ForceArrows::kMetresPerNewton * f_A));
  constexpr double kShaft_px = 5 * 240 / 720.0;
  head += ForceArrows::kGap * kShaft_px * (head - base).normalized();
  Eigen::Vector2d farthest = base;
  for (int v = 0; v < 200; ++v) {  // the legend is below
    for (int u = 0; u < 320; ++u) {
      const Eigen::Vector2d p(u, v);
      if (difference(at(with, u, v), at(without, u, v)) > 10 &&
          (p - base).norm() > (farthest - base).norm())
        farthest = p;
    }
  }
  EXPECT_NEAR((farthest - head).norm(), 0, 2.5);  // the outline is about 1 px wide; pixel steps
}

TEST_F(HeldTool, DarkArrowHasALightOutlineAndALightArrowADarkOne) {
  const auto extremes = [&](ForceKind kind, std::uint8_t behind) {
    const Image picture = plain(320, 240, behind);
    SceneState state = straightOn(picture);
    state.forces = {{kind, Vec3::Zero(), Vec3(1, 0, 0)}};
    const Image frame = frameOf(nobody_, state);
    int low = 255, high = 0;
    for (const std::uint8_t value : frame.pixels) {
      low = std::min<int>(low, value);
      high = std::max<int>(high, value);
    }
    return std::pair(low, high);
  };
  EXPECT_GT(extremes(ForceKind::reaction, 20).second, 230);
  EXPECT_LT(extremes(ForceKind::device, 240).first, 40);
}

TEST_F(HeldTool, WithoutRegistrationNothingIsDrawnOnThePicture) {
  SceneState state = withTool(true);
  state.registered = false;
  state.forces = {{ForceKind::device, Vec3::Zero(), Vec3(1, 0, 0)}};
  state.trail_A = {Vec3::Zero(), Vec3(0.01, 0, 0)};
  EXPECT_EQ(frameOf(ballBehindSkin(true), state).pixels, dark_.pixels);
}

TEST_F(HeldTool, TrailIsALineAlongThePath) {
  SceneState state = withTool(false);
  const Image without = frameOf(nobody_, state);
  for (int i = 0; i <= 50; ++i) state.trail_A.push_back(Vec3(-0.05 + 0.002 * i, 0, 0.02));
  const Blob line = clearlyChanged(without, frameOf(nobody_, state));
  const Eigen::Vector2d a = project(state.camera, state.X_CA * state.trail_A.front());
  const Eigen::Vector2d b = project(state.camera, state.X_CA * state.trail_A.back());
  EXPECT_NEAR(line.left, a.x(), 1.5);
  EXPECT_NEAR(line.right, b.x(), 1.5);
  EXPECT_NEAR(line.v, a.y(), 1.0);
  EXPECT_LE(line.bottom - line.top, 3);
}

TEST_F(HeldTool, WeakAndBrokenForcesAreNotDrawn) {
  SceneState state = withTool(false);
  const Image without = frameOf(nobody_, state);
  state.forces = {{ForceKind::device, Vec3::Zero(), Vec3(0.01, 0, 0)},
                  {ForceKind::device, Vec3::Zero(), Vec3(std::nan(""), 0, 0)}};
  EXPECT_EQ(changed(without, frameOf(nobody_, state)).count, 0);
}

}  // namespace
}  // namespace palpa::scene

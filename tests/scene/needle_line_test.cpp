#include "scene/actors/needle_line.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "anatomy/parametric/phantoms.h"
#include "scene/actors/instrument.h"
#include "tests/scene/offscreen.h"

namespace palpa::scene {
namespace {

Pixel between(const Image& image, const Eigen::Vector2d& p) {
  const int u = int(std::floor(p.x())), v = int(std::floor(p.y()));
  const double a = p.x() - u, b = p.y() - v;
  const auto mix = [&](auto channel) {
    return int(std::lround(
        (1 - b) * ((1 - a) * at(image, u, v).*channel + a * at(image, u + 1, v).*channel) +
        b * ((1 - a) * at(image, u, v + 1).*channel + a * at(image, u + 1, v + 1).*channel)));
  };
  return {mix(&Pixel::r), mix(&Pixel::g), mix(&Pixel::b)};
}

/// As wide on the screen as 0.9 mm at 0.5 m before a camera of 650 px.
SceneState acrossThePicture(double angle, const Image& picture) {
  SceneState state;
  state.picture = &picture;
  state.registered = true;
  const double width_px = 0.0009 * 650 / 0.5, f = width_px / (2 * InstrumentSize().needle_radius);
  state.camera = {400, 300, 0.5 * f, 0.5 * f, 199.5, 149.5};
  state.X_CA = lookAt({0, -0.5, 0}, {0, 0, 0});
  const Vec3 forward(std::cos(angle), 0, std::sin(angle));
  state.X_AT = makePose(rotationWithZ(forward), 0.5 * InstrumentSize().needle_length * forward);
  return state;
}

/// The share of the needle's length along which it is three times as bright, or as dark, as what is
/// within four pixels of it, as WCAG reckons contrast.
double shareSeen(const Image& image, const SceneState& state) {
  const double length = InstrumentSize().needle_length;
  const auto on = [&](double behind) {
    return project(state.camera, state.X_CA * (state.X_AT * Vec3(0, 0, -behind)));
  };
  const Eigen::Vector2d along = (on(length) - on(0)).normalized(), across(-along.y(), along.x());
  int seen = 0;
  constexpr int kPlaces = 100;
  for (int i = 0; i < kPlaces; ++i) {
    const Eigen::Vector2d middle = on((i + 0.5) / kPlaces * length);
    double bright = 0, dark = 1;
    for (double d = -1; d <= 1; d += 0.5)
      bright = std::max(bright, luminance(between(image, middle + d * across)));
    for (const double side : {-1.0, 1.0})
      for (double d = 2; d <= 4; d += 0.5)
        dark = std::min(dark, luminance(between(image, middle + side * d * across)));
    if ((bright + 0.05) / (dark + 0.05) >= 3) ++seen;
  }
  return double(seen) / kPlaces;
}

const CameraLook& softCamera() {
  static const CameraLook look{.blur_px = 0.8,
                               .black = {0.08, 0.08, 0.08},
                               .white = {0.9, 0.9, 0.9},
                               .grain = {0.012, 0.012, 0.012, 0.012, 0.012}};
  return look;
}

class Angles : public testing::TestWithParam<int> {};
INSTANTIATE_TEST_SUITE_P(NeedleLine, Angles, testing::Range(0, 36));

TEST_P(Angles, ANeedleStandsOutAlongItsLength) {
  static const anatomy::Patient nobody = anatomy::phantomBlock({0.01, 0.01, 0.01}, "block");
  static SceneView view(offscreen(), nobody, {400, 300, FixedViews::none, true});
  const double angle = 2 * std::numbers::pi * (GetParam() + 0.37) / 36;
  for (const std::uint8_t level : {20, 90, 150, 235}) {
    const Image picture = plain(400, 300, level);
    SceneState state = acrossThePicture(angle, picture);
    state.skin = SkinStyle::hidden;
    state.look = softCamera();
    view.show(state);
    EXPECT_GE(shareSeen(view.capture(), state), 0.95) << "on " << int(level);
  }
}

/// Skin about a bone, in front of which the eye is; the needle enters from the left and goes on
/// behind the bone.
struct BehindABone {
  anatomy::Patient patient = [] {
    anatomy::Patient made;
    test::add(made, "skin", Organ::skin, test::sphere({0, 0, 0}, Vec3::Constant(0.045)));
    test::add(made, "bone", Organ::clavicle, test::sphere({0, -0.02, 0}, {0.02, 0.01, 0.02}));
    return made;
  }();
  SceneState state = [] {
    SceneState s;
    s.registered = true;
    s.camera = {400, 300, 1000, 1000, 199.5, 149.5};
    s.X_CA = lookAt({0, -0.5, 0}, {0, 0, 0});
    s.X_AT = makePose(rotationWithZ(Vec3::UnitX()), Vec3(0.018, 0.01, 0));
    return s;
  }();

  /// Columns before the bone in which the picture is another without the needle.
  std::vector<bool> columns(SkinStyle skin, bool inside) {
    ViewLayout layout{400, 300, FixedViews::none, true};
    layout.inside = inside;
    SceneView view(offscreen(), patient, layout);
    state.skin = skin;
    const auto picture = [&](bool needle) {
      state.show_tool = needle;
      view.show(state);
      return view.capture();
    };
    const Image with = picture(true), without = picture(false);
    std::vector<bool> changed;
    for (int u = 175; u < 235; ++u) {
      int most = 0;
      for (int v = 140; v < 160; ++v)
        most = std::max(most, difference(at(with, u, v), at(without, u, v)));
      changed.push_back(most > 40);
    }
    return changed;
  }
};

TEST(NeedleLine, IsDashedWhereABoneHidesIt) {
  const std::vector<bool> columns = BehindABone().columns(SkinStyle::translucent, true);
  int dashes = 0;
  for (std::size_t i = 1; i < columns.size(); ++i) dashes += columns[i] && !columns[i - 1];
  EXPECT_GE(dashes, 3);
  const auto drawn = std::count(columns.begin(), columns.end(), true);
  EXPECT_GT(drawn, 0.4 * double(columns.size()));
  EXPECT_LT(drawn, 0.9 * double(columns.size()));
}

TEST(NeedleLine, IsNotSeenUnderASolidSkin) {
  for (const bool inside : {true, false}) {
    const std::vector<bool> columns = BehindABone().columns(SkinStyle::solid, inside);
    EXPECT_EQ(std::count(columns.begin(), columns.end(), true), 0) << inside;
  }
}

}  // namespace
}  // namespace palpa::scene

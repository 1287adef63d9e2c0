#include <gtest/gtest.h>

#include <vtkRenderWindow.h>
#include <array>

#include "scene/panels.h"
#include "tests/scene/offscreen.h"

namespace palpa::scene {
namespace {

class FixedViewsBeside : public testing::Test {
 protected:
  enum Panel { front, side, top };
  Image frameAt(const Vec3& tip_A, bool shown = true) {
    state_.show_tool = shown;
    state_.X_AT = makePose(rotationWithZ(Vec3::UnitX()), tip_A);
    view_.show(state_);
    return view_.capture();
  }
  /// Bounds of the needle in a panel.
  Blob needle(Panel panel, const Vec3& tip_A) {
    const Image without = frameAt(tip_A, false), with = frameAt(tip_A);
    return blobOf(with, [&](int u, int v) {
      return u > 0.7 * 900 && v * 3 / 600 == panel &&
             difference(at(with, u, v), at(without, u, v)) > 2;
    });
  }
  const anatomy::Patient patient_ = test::simplePatient();
  SceneView view_{offscreen(), patient_, {900, 600, FixedViews::three, true}};
  SceneState state_;
  const Vec3 tip_A_{-0.05, 0.01, -0.01};
};

TEST_F(FixedViewsBeside, EachShowsMotionInItsPlaneAndNotAcrossIt) {
  const double step = 0.010;
  const auto motion = [&](Panel panel, const Vec3& d_A) {
    const Blob a = needle(panel, tip_A_), b = needle(panel, tip_A_ + d_A);
    return Eigen::Vector2i(b.right - a.right, b.top - a.top);
  };
  const Vec3 left(step, 0, 0), back(0, step, 0), up(0, 0, step);
  const int one = motion(front, left).x();
  EXPECT_GT(one, 5);
  EXPECT_EQ(motion(front, back), Eigen::Vector2i(0, 0));
  EXPECT_NEAR(motion(front, up).y(), -one, 1);
  EXPECT_NEAR(motion(side, back).x(), -one, 1);  // right side: anterior is on the right
  EXPECT_NEAR(motion(side, up).y(), -one, 1);
  EXPECT_NEAR(motion(top, left).x(), one, 1);
  EXPECT_NEAR(motion(top, back).y(), -one, 1);  // from above: posterior is up
  EXPECT_EQ(motion(top, up), Eigen::Vector2i(0, 0));
}

TEST_F(FixedViewsBeside, ShowTheAnatomyInItsColours) {
  const Image frame = frameAt(tip_A_, false);
  const auto count = [&](auto chosen) {
    return blobOf(frame, [&](int u, int v) { return u > 0.7 * 900 && chosen(at(frame, u, v)); })
        .count;
  };
  EXPECT_GT(count([](const Pixel& p) { return p.b > p.r + 60; }), 300);   // vein
  EXPECT_GT(count([](const Pixel& p) { return p.r > p.b + 100; }), 300);  // artery
}

TEST_F(FixedViewsBeside, FollowTheSizeOfTheWindow) {
  frameAt(tip_A_);
  offscreen().window()->SetSize(700, 500);
  const Image small = frameAt(tip_A_, false);
  EXPECT_EQ(small.width, 700);
  EXPECT_EQ(small.height, 500);
  const Blob vein = blobOf(small, [&](int u, int v) {
    return u > 0.7 * 700 && at(small, u, v).b > at(small, u, v).r + 60;
  });
  EXPECT_GT(vein.count, 150);
}

/// One at a time: each has the right half to itself, and shows the needle in its own plane.
TEST(FixedViewAtATime, IsTheOneThatWasChosen) {
  const anatomy::Patient patient = test::simplePatient();
  SceneView view(offscreen(), patient, {800, 400, FixedViews::one, true});
  SceneState state;
  std::vector<Image> frames;
  for (state.fixed_view = 0; state.fixed_view < kFixedViews; ++state.fixed_view) {
    view.show(state);
    frames.push_back(view.capture());
  }
  for (std::size_t i = 0; i < frames.size(); ++i) {
    const Blob other = changed(frames[i], frames[(i + 1) % frames.size()]);
    EXPECT_GT(other.count, 1000) << i;
    EXPECT_GT(other.left, 0.49 * 800) << i;
    const Blob vein = blobOf(frames[i], [&](int u, int v) {
      return u > 0.5 * 800 && at(frames[i], u, v).b > at(frames[i], u, v).r + 60;
    });
    EXPECT_GT(vein.count, 300) << i;
  }
}

/// Without what lies inside neither the fixed views nor the picture show a vessel, however the skin
/// looks.
TEST(NothingInside, IsShown) {
  const anatomy::Patient patient = test::simplePatient();
  for (const SkinStyle skin : {SkinStyle::solid, SkinStyle::translucent, SkinStyle::hidden}) {
    ViewLayout layout{900, 600, FixedViews::three, true};
    layout.inside = false;
    SceneView view(offscreen(), patient, layout);
    SceneState state;
    state.skin = skin;
    state.show_tool = false;
    view.show(state);
    const Image frame = view.capture();
    const Blob vessel = blobOf(frame, [&](int u, int v) {
      const Pixel p = at(frame, u, v);
      return p.b > p.r + 60 || p.r > p.b + 130;
    });
    EXPECT_EQ(vessel.count, 0) << static_cast<int>(skin);
  }
}

/// A needle under solid skin is not seen from the front.
TEST(NothingInside, NotEvenTheNeedle) {
  const anatomy::Patient patient = test::simplePatient();
  ViewLayout layout{900, 600, FixedViews::three, true};
  SceneState state;
  const auto pixelsThatMove = [&](bool inside) {
    layout.inside = inside;
    SceneView view(offscreen(), patient, layout);
    state.skin = SkinStyle::solid;
    std::array<Image, 2> frames;
    for (std::size_t i = 0; i < 2; ++i) {  // along the skin, deep under it
      const double z = -0.01 + 0.004 * static_cast<double>(i);
      state.X_AT = makePose(rotationWithZ(Vec3::UnitX()), Vec3(-0.03, 0.05, z));
      view.show(state);
      frames[i] = view.capture();
    }
    return blobOf(frames[0],
                  [&](int u, int v) {
                    return u > 0.7 * 900 && v < 200 &&
                           difference(at(frames[0], u, v), at(frames[1], u, v)) > 8;
                  })
        .count;
  };
  EXPECT_LT(3 * pixelsThatMove(false), pixelsThatMove(true) + 1);
}

TEST(Layout, PanelsTileTheWindowWithoutOverlap) {
  for (const auto& [width, height] :
       {std::pair(1280, 720), std::pair(640, 480), std::pair(333, 201)}) {
    const Panels panels = layoutPanels(width, height, FixedViews::three);
    for (int y = 0; y < height; ++y) {
      for (int x = 0; x < width; ++x) {
        int owners = 0;
        for (const Rect* r : {&panels.ar, &panels.front, &panels.side, &panels.top})
          owners += r->contains(x, y);
        ASSERT_LE(owners, 1) << x << ' ' << y;
      }
    }
    for (const Rect* r : {&panels.front, &panels.side, &panels.top}) EXPECT_EQ(r->right(), width);
    EXPECT_EQ(panels.front.top(), height);
    EXPECT_EQ(panels.top.y, 0);
  }
}

TEST(Layout, OneViewHasTheRightHalfAndNoneLeavesAllToThePicture) {
  const Panels one = layoutPanels(800, 400, FixedViews::one);
  EXPECT_EQ(one.ar, (Rect{0, 0, 400, 400}));
  for (const Rect* r : {&one.front, &one.side, &one.top}) {
    EXPECT_GE(r->x, one.ar.right());
    EXPECT_EQ(r->right(), 800);
    EXPECT_EQ(r->height, 400);
  }
  EXPECT_EQ(layoutPanels(800, 400, FixedViews::none).ar, (Rect{0, 0, 800, 400}));
}

TEST(Layout, LetterboxKeepsTheAspectAndTheMiddle) {
  EXPECT_EQ(letterbox({10, 20, 900, 480}, 640, 480), (Rect{140, 20, 640, 480}));
  EXPECT_EQ(letterbox({0, 0, 640, 720}, 640, 480), (Rect{0, 120, 640, 480}));
}

}  // namespace
}  // namespace palpa::scene

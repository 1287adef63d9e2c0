#include "apps/session/mouse_hands.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <numbers>

#include "apps/runtime/clock.h"

/// What a mouse says becomes what the bench's hand wants.
namespace palpa::session {
namespace {

struct Pointed {
  PointingHandSetup setup;
  PointingHand hand;
  std::int64_t now_ns = 0;
  Vec3 lies_P = Vec3(0, -0.02, 0.05);  ///< the tip, before anybody takes the tool
  scene::ViewInput input;
  scene::ArGeometry view;

  static PointingHandSetup standing() {
    PointingHandSetup s;
    s.X_DP = makePose(Eigen::AngleAxisd(0.4, Vec3::UnitX()).toRotationMatrix(), {0.02, -0.1, 0.05});
    s.X_ET = makePose(Mat3::Identity(), {0, 0, 0.11});
    s.X_AP = makePose(Eigen::AngleAxisd(-0.7, Vec3::UnitY()).toRotationMatrix(), {0.1, 0, 0.2});
    s.half_x = 0.03;
    s.half_y = 0.02;
    return s;
  }
  /// Seen from 0.4 m above the top, a little from the side.
  static scene::ArGeometry seen(const PointingHandSetup& s) {
    scene::ArGeometry g;
    g.camera.fx = g.camera.fy = 800;
    g.camera.cx = 320;
    g.camera.cy = 240;
    g.width = 640;
    g.height = 480;
    const Mat3 looks_down =
        (Eigen::AngleAxisd(std::numbers::pi, Vec3::UnitX()) * Eigen::AngleAxisd(0.3, Vec3::UnitY()))
            .toRotationMatrix();
    const Pose X_PC = makePose(looks_down, {0, 0, 0.4});
    g.X_CA = (s.X_AP * X_PC).inverse();
    return g;
  }
  explicit Pointed(double held_for_s = 1.5, const PointingHandSetup& s = standing())
      : setup(s), hand(setup), view(seen(setup)) {
    pointAt({0, 0, 0});
    after(held_for_s);
  }

  void pointAt(const Vec3& p_P) {
    const Vec3 p_C = view.X_CA * setup.X_AP * p_P;
    input.mouse_x = view.camera.cx + view.camera.fx * p_C.x() / p_C.z();
    input.mouse_y = view.camera.cy + view.camera.fy * p_C.y() / p_C.z();
    say();
  }

  void say() {
    hand.handle(input, view, now_ns);
    input.keys.clear();
  }
  /// The tool's tip over the phantom and whether the button is down, after so long.
  std::pair<Vec3, bool> after(double seconds) {
    twin::Hand::Action action;
    for (int i = 0; i < static_cast<int>(1000 * seconds); ++i) {
      now_ns += runtime::kMillisecond;
      twin::Hand::Senses senses;
      senses.now_ns = now_ns;
      senses.X_DE = setup.X_DP * makePose(Mat3::Identity(), lies_P) * setup.X_ET.inverse();
      action = hand.act(senses, 1e-3);
    }
    return {setup.X_DP.inverse() * (action.X_DH * setup.X_ET).translation(), action.buttons == 1};
  }
};

TEST(PointingHand, HoversOverWhatIsPointedAtWithinTheArea) {
  Pointed p;
  EXPECT_LT((p.after(0.5).first - Vec3(0, 0, 0.006)).norm(), 1e-5);
  p.pointAt({0.010, -0.015, 0});
  EXPECT_LT((p.after(0.5).first - Vec3(0.010, -0.015, 0.006)).norm(), 1e-5);
  p.pointAt({0.050, 0, 0});
  EXPECT_LT((p.after(0.5).first - Vec3(0.030, 0, 0.006)).norm(), 1e-5);
}

/// Over a hill it is where the eye meets that, along its normal, within its outline.
TEST(PointingHand, FollowsACurvedTop) {
  PointingHandSetup s = Pointed::standing();
  s.top.arch_high = 0.02;
  s.top.arch_half_x = s.top.arch_half_y = 0.05;
  s.top = onOrigin(s.top);
  s.to_area = [](const Vec3& p_P) { return Vec3(std::max(p_P.x(), -0.015), p_P.y(), p_P.z()); };
  Pointed p(1.5, s);
  const Vec3 there = fromTop(s.top, Vec3(0.018, -0.012, 0));
  p.pointAt(there);
  const Vec3 over = p.after(0.5).first;
  EXPECT_LT((alongTop(s.top, over) - Vec3(0.018, -0.012, 0.006)).norm(), 1e-3)
      << "it looks along the ray by the millimetre";
  p.input.left_button = true;
  p.say();
  const Vec3 deep = p.after(3).first, n = normalOf(s.top, over.x(), over.y());
  EXPECT_LT((over - deep).normalized().cross(n).norm(), 0.05);
  EXPECT_NEAR(alongTop(s.top, deep).z(), -0.009, 1e-6);
  p.input.left_button = false;
  p.pointAt(fromTop(s.top, Vec3(-0.025, 0, 0)));
  EXPECT_NEAR(alongTop(s.top, p.after(0.5).first).x(), -0.015, 1e-3);
}

TEST(PointingHand, StaysWhereNothingIsPointedAt) {
  Pointed p;
  const Vec3 begun = p.after(0.5).first;
  p.input.mouse_x = 700;  // another view of the window
  p.say();
  EXPECT_LT((p.after(0.3).first - begun).norm(), 1e-5);
  p.input.mouse_x = 300;
  p.view.X_CA = (p.setup.X_AP * makePose(Mat3::Identity(), {0, 0, 0.4})).inverse();  // it looks up
  p.say();
  EXPECT_LT((p.after(0.3).first - begun).norm(), 1e-5);
}

TEST(PointingHand, PressesWhileTheButtonIsHeldAndNoDeeperThanAHandWould) {
  Pointed p;
  EXPECT_GT(p.after(0.2).first.z(), 0.004);
  p.input.left_button = true;
  p.say();
  const double after_half_second = p.after(0.5).first.z();
  EXPECT_LT(after_half_second, 0.001);
  EXPECT_GT(after_half_second, -0.002) << "evenly, not at once";
  EXPECT_NEAR(p.after(3).first.z(), -0.009, 1e-6);
  p.input.left_button = false;
  p.say();
  EXPECT_GT(p.after(0.5).first.z(), 0.004);
}

TEST(PointingHand, TakesTheToolWhereItLiesAndLowersItGently) {
  Pointed p(0);
  Vec3 before = p.lies_P;
  double fastest = 0;
  for (int i = 0; i < 2000; ++i) {
    const Vec3 now = p.after(0.001).first;
    fastest = std::max(fastest, (now - before).norm() / 1e-3);
    before = now;
  }
  EXPECT_LT(fastest, 0.35) << "m/s";
  EXPECT_LT((before - Vec3(0, 0, 0.006)).norm(), 1e-4);
}

TEST(PointingHand, AKeyThatIsHeldMarksOnce) {
  Pointed p;
  int marks = 0;
  bool down = false;
  const auto wait = [&](double seconds) {
    for (int i = 0; i < static_cast<int>(1000 * seconds); ++i) {
      const bool now = p.after(0.001).second;
      marks += now && !down;
      down = now;
    }
  };
  for (int repeat = 0; repeat < 40; ++repeat) {
    p.input.keys = {"m"};
    p.say();
    wait(repeat == 0 ? 0.6 : 0.033);
  }
  EXPECT_EQ(marks, 1);
  wait(1);
  p.input.keys = {"m"};
  p.say();
  wait(0.5);
  EXPECT_EQ(marks, 2);
}

TEST(PointingHand, MarksOnceAKey) {
  Pointed p;
  EXPECT_FALSE(p.after(0.1).second);
  p.input.keys = {"m"};
  p.say();
  EXPECT_TRUE(p.after(0.1).second);
  EXPECT_FALSE(p.after(0.2).second);
  p.say();
  EXPECT_FALSE(p.after(0.1).second);
}

TEST(PointingHand, StaysWhileTheViewIsTurned) {
  Pointed p;
  const Vec3 begun = p.after(0.5).first;
  p.input.right_button = true;
  p.pointAt({0.02, 0, 0});
  EXPECT_LT((p.after(0.3).first - begun).norm(), 1e-5);
  p.input.right_button = false;
  p.say();
  EXPECT_GT((p.after(0.3).first - begun).norm(), 0.015);
}

}  // namespace
}  // namespace palpa::session

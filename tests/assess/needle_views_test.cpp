#include "apps/assess/needle/needle_views.h"

#include <gtest/gtest.h>

#include "anatomy/shapes/implicit_surface.h"
#include "tests/assess/motions.h"

namespace palpa::assess::test {
namespace {

constexpr double kVeinRadius = 0.005;

/// The hand-made patient with a ball for a vein where the taught line ends.
const anatomy::Patient& withAVein() {
  static const anatomy::Patient patient = [] {
    anatomy::Patient p = landmarksOnly();
    const Vec3 target = Motion::toA(taughtPath().line_to_L);
    p.landmarks[anatomy::landmark::kVeinTarget] = target;
    const Vec3 corner = Vec3::Constant(kVeinRadius + 0.002);
    p.organs.push_back(
        {"ball",
         Organ::vein,
         anatomy::surfaceNets([&](const Vec3& q) { return (q - target).norm() - kVeinRadius; },
                              {target - corner, target + corner}, 0.0005),
         {1, 1, 1, 1}});
    return p;
  }();
  return patient;
}

NeedleViews views() { return needleViewsOf(withAVein(), taughtPath()); }

/// A picture's normal points to who looks at it: on either side of the body.
class NeedleViewsOf : public testing::TestWithParam<anatomy::Side> {};

TEST_P(NeedleViewsOf, LookFromInFrontAndAlongTheNeedle) {
  anatomy::Patient patient = withAVein();
  patient.side = GetParam();
  const double left = patient.side == anatomy::Side::left ? -1 : 1;
  for (auto& [landmark, p_A] : patient.landmarks) p_A.x() *= left;
  const NeedleViews v = needleViewsOf(patient, taughtPath());
  const Vec3 direction_A = anatomy::LandmarkFrame(patient).vectorToA(taughtPath().direction_L);
  EXPECT_LT(v.skin.plane.normal_A().y(), -0.9) << "from in front";
  EXPECT_GT(v.skin.plane.across_A.x(), 0.9) << "the patient's left is on the right";
  EXPECT_GT(v.skin.plane.up_A.z(), 0.9);
  EXPECT_STREQ(v.skin.across, left > 0 ? "middle" : "shoulder");
  EXPECT_NEAR(v.vein.plane.normal_A().dot(direction_A), -1, 1e-12) << "from the needle";
  EXPECT_LT(v.vein.plane.up_A.y(), -0.5);
  EXPECT_STREQ(v.vein.across, left > 0 ? "feet" : "head");
  EXPECT_EQ(v.vein.plane.across_A.z() > 0, left < 0);
  EXPECT_NEAR(v.way.plane.offset(v.target_A), 0, 1e-9) << "entry and vein lie in the picture";
  EXPECT_GT(v.way.plane.at(v.target_A).x(), 0.02);
  EXPECT_LT(v.way.plane.at(v.target_A).y(), -0.01) << "deeper";
  for (const NeedleView* view : {&v.skin, &v.way, &v.vein}) {
    EXPECT_NEAR(view->plane.across_A.dot(view->plane.up_A), 0, 1e-12) << view->title;
    EXPECT_NEAR(view->plane.normal_A().norm(), 1, 1e-12) << view->title;
  }
}

INSTANTIATE_TEST_SUITE_P(Sides, NeedleViewsOf,
                         testing::Values(anatomy::Side::right, anatomy::Side::left));

TEST(NeedleViews, CutTheVeinWhereItIs) {
  const NeedleViews v = views();
  EXPECT_TRUE(v.skin.cut.empty());  // bones only
  for (const NeedleView* view : {&v.way, &v.vein}) {
    ASSERT_EQ(view->cut.size(), 1u) << view->title;
    const Eigen::Vector2d middle = view->plane.at(v.target_A);
    for (const Eigen::Vector2d& p : view->cut[0].points)
      EXPECT_NEAR((p - middle).norm(), kVeinRadius, 1e-4) << view->title;
  }
}

TEST(NeedleViews, ATrialAsTaughtGoesThroughAllThreeMiddles) {
  const NeedleViews v = views();
  const std::vector<NeedleTrack> tracks = needleTracks(textbook().samples());
  ASSERT_EQ(tracks.size(), 1u);
  EXPECT_LT(v.skin.plane.at(tracks[0].puncture_A).norm(), 1e-9);
  const auto aim = aimOf(tracks[0].deepest, v.vein.plane);
  ASSERT_TRUE(aim);
  EXPECT_LT(aim->norm(), 1e-6);
  EXPECT_LT((tracks[0].tips_A.front() - v.entry_A).norm(), 1e-6);
  EXPECT_LT((tracks[0].tips_A.back() - v.target_A).norm(), 2e-3);
}

TEST(NeedleViews, AnAimTooFarTowardTheHeadIsSeenSo) {
  const Vec3 taught = taughtPath().direction_L, aimed = direction_L(25 * kDeg, 25 * kDeg);
  Motion m;
  m.push(0.010).puncture().push(0.008).turnTo(aimed).push(0.030);
  const std::vector<NeedleTrack> tracks = needleTracks(m.samples());
  ASSERT_EQ(tracks.size(), 1u);
  const auto aim = aimOf(tracks[0].deepest, views().vein.plane);
  ASSERT_TRUE(aim);
  // From where it was turned to the plane 30 mm along the taught direction.
  const Vec3 beside = 0.030 * (aimed / aimed.dot(taught) - taught);
  EXPECT_NEAR(aim->norm(), beside.norm(), 1e-6);
  EXPECT_NEAR(aim->x(), -0.030 * std::tan(10 * kDeg) * std::cos(25 * kDeg), 4e-4);  // feet: right
}

TEST(NeedleViews, EachPassIsSeenAndWhatRunsAlongAPlaneHasNoAim) {
  Motion m;
  m.push(0.010).puncture().push(0.008).withdraw().push(-0.005);
  m.now().tip_A += Vec3(0.004, 0, 0);
  m.push(0.005).puncture().push(0.012);
  const std::vector<NeedleTrack> tracks = needleTracks(m.samples());
  ASSERT_EQ(tracks.size(), 2u);
  EXPECT_NEAR((tracks[1].puncture_A - tracks[0].puncture_A).x(), 0.004, 1e-9);
  EXPECT_NEAR(tracks[1].deepest.depth, 0.012, 1e-9);
  TrialSample along;
  along.axis_A = views().vein.plane.across_A;
  EXPECT_FALSE(aimOf(along, views().vein.plane));
  EXPECT_TRUE(needleTracks({}).empty());
}

}  // namespace
}  // namespace palpa::assess::test

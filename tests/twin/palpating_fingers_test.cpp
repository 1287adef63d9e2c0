#include <gtest/gtest.h>

#include <algorithm>
#include <array>

#include "apps/runtime/clock.h"
#include "apps/station/assets.h"
#include "apps/twin/feeling_hands.h"

/// Two fingers on devices that go where they are led, over a phantom that nobody feels.
namespace palpa::twin {
namespace {

class PalpatingFingers : public testing::Test {
 protected:
  /// So many seconds; false: the trial is paused.
  void run(double seconds, bool running = true) {
    runtime::Displayed seen;
    seen.trial = 1;
    seen.running = running;
    for (int i = 0; i < 1000 * seconds; ++i, now_ns_ += runtime::kMillisecond) {
      seen.t_ns = now_ns_;
      seen.X_AT = tips_[0];
      seen.second_X_AT = tips_[1];
      for (std::size_t f = 0; f < 2; ++f) {
        const Vec3 before = tips_[f].translation();
        const Hand::Senses senses{now_ns_, tips_[f], Vec3::Zero(), &seen, Vec3::Zero()};
        tips_[f] = fingers_[f]->act(senses, 1e-3).X_DH;
        fastest_ = std::max(fastest_, (tips_[f].translation() - before).norm() / 1e-3);
      }
      if (first().z() < -0.004 && !deep_) ++presses_;
      deep_ = first().z() < -0.004;
    }
  }
  Vec3 first() const { return tips_[0].translation(); }

  PalpatingSkill skill_ = readPalpatingSkill(station::assetFile("operators/palpation_expert.json"));
  std::vector<std::unique_ptr<Hand>> fingers_ =
      palpatingFingers(skill_, {Pose::Identity(), 0.03, 0.03, {}}, Pose::Identity(), 2, 7);
  std::array<Pose, 2> tips_{pickedUp(0), pickedUp(0.02)};
  std::int64_t now_ns_ = 0;
  int presses_ = 0;
  bool deep_ = false;
  double fastest_ = 0;  // m/s, of either finger

 private:
  static Pose pickedUp(double beside) {
    return makePose(rotationWithZ(-Vec3::UnitZ()), Vec3(beside, -0.03, 0.05));
  }
};

TEST_F(PalpatingFingers, GoSideBySideFromTheFirstMomentAndNeverLeap) {
  run(0.5, false);
  fastest_ = 0;  // the first look at the screen tells where the hand is to half a millimetre
  EXPECT_NEAR((tips_[1].translation() - tips_[0].translation()).x(), 0.02, 0.002)
      << "before a trial, too";
  run(20);
  EXPECT_GE(presses_, 8);
  // A thought, every 10 ms, moves them by 2 mm at most: 2 m/s in its tick; 20 mm would be 20 m/s.
  EXPECT_LT(fastest_, 4);
}

/// Wherever in the search somebody pauses: with both fingers pressing, or the first alone where the
/// second would be beside the area.
TEST_F(PalpatingFingers, GoOnAfterAPause) {
  for (int pause = 0; pause < 40; ++pause) {
    run(3.1);
    const int before = presses_;
    run(1.5, false);
    EXPECT_GT(first().z(), 0.03) << pause << ": away from it";
    run(6);
    if (testing::Test::HasFailure()) return;
    if (first().norm() > 0.035 && presses_ == before) break;  // the area is done
    EXPECT_GT(presses_, before) << pause << ": at " << first().transpose();
  }
  EXPECT_GT(presses_, 50);
}

/// One finger over a dome with an outline: it goes where the area is, and points into the top.
TEST(PalpatingFinger, FollowsACurvedTopAndPressesAlongItsNormal) {
  VisiblePhantom phantom{Pose::Identity(), 0.02, 0.02, {}};
  phantom.top.arch_high = 0.02;
  phantom.top.arch_half_x = phantom.top.arch_half_y = 0.045;
  phantom.top = onOrigin(phantom.top);
  phantom.to_area = [](const Vec3& p_P) {  // a disc
    const double r = p_P.head<2>().norm();
    return r > 0.02 ? Vec3(p_P.x() * 0.02 / r, p_P.y() * 0.02 / r, p_P.z()) : p_P;
  };
  PalpatingSkill skill = readPalpatingSkill(station::assetFile("operators/palpation_expert.json"));
  skill.look_sd = skill.tremor_rms = 0;
  const auto fingers = palpatingFingers(skill, phantom, Pose::Identity(), 1, 7);
  Pose tip = makePose(rotationWithZ(-Vec3::UnitZ()), Vec3(0, -0.02, 0.05));
  runtime::Displayed seen;
  seen.trial = 1;
  seen.running = true;
  int deep = 0;
  double farthest = 0, steepest = 0;
  for (std::int64_t now_ns = 0; now_ns < 15'000 * runtime::kMillisecond;
       now_ns += runtime::kMillisecond) {
    seen.t_ns = now_ns;
    seen.X_AT = tip;
    tip = fingers[0]->act({now_ns, tip, Vec3::Zero(), &seen, Vec3::Zero()}, 1e-3).X_DH;
    const Vec3 along = alongTop(phantom.top, tip.translation());
    if (along.z() > 0) continue;
    const Vec3 n = normalOf(phantom.top, along.x(), along.y());
    ASSERT_LT((tip.linear() * Vec3::UnitZ() + n).norm(), 1e-6);
    deep += along.z() < -0.008;
    farthest = std::max(farthest, along.head<2>().norm());
    steepest = std::max(steepest, n.head<2>().norm());
  }
  EXPECT_GT(deep, 100);
  EXPECT_GT(farthest, 0.015);
  EXPECT_LT(farthest, 0.025) << "it wanders by a millimetre or two";
  EXPECT_GT(steepest, 0.25);
}

}  // namespace
}  // namespace palpa::twin

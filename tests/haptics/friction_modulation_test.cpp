#include "haptics/modulation/modulation.h"

#include <gtest/gtest.h>

#include "tests/support/allocation_count.h"

namespace palpa::haptics {
namespace {

constexpr double kRubTick = 1e-3, kRubForce = 1.0;  // s, N
const HuntCrossley kRubbed{900, 0, 1.4};
const Dahl kRealSurface{0.3, 3000, 0.0}, kWantedSurface{0.8, 1500, 2.0};

/// Slid along x at `speed`, the surface pressed with a steady force: Coulomb's friction once it
/// slides.
Vec3 reactionOf(double speed) {
  return Vec3(speed > 0 ? -kRealSurface.mu * kRubForce : 0, 0, kRubForce);
}

FrictionModulation rubbing() { return {{kRubbed, 0, kRealSurface, {}, 0.1}, kWantedSurface}; }

TEST(FrictionModulation, TheHandFeelsTheWantedFriction) {
  for (const double speed : {0.02, 0.1}) {
    FrictionModulationState state;
    Modulated now;
    for (int i = 0; i < 400; ++i)
      now = modulateFriction(rubbing(), reactionOf(speed), Vec3(speed * kRubTick, 0, 0), kRubTick,
                             &state);
    const Vec3 felt = reactionOf(speed) + now.f_d;
    EXPECT_NEAR(felt.x(), -(kWantedSurface.mu * kRubForce + kWantedSurface.B * speed), 2e-3);
    EXPECT_NEAR(felt.z(), kRubForce, 2e-3);  // pressing feels as it does
  }
}

/// A smoother surface takes friction away: the device pushes along the motion.
TEST(FrictionModulation, SmootherPushesAlong) {
  FrictionModulation law = rubbing();
  law.wanted = {0.1, 3000, 0};
  FrictionModulationState state;
  Modulated now;
  for (int i = 0; i < 400; ++i)
    now = modulateFriction(law, reactionOf(0.05), Vec3(0.05 * kRubTick, 0, 0), kRubTick, &state);
  EXPECT_NEAR(now.f_d.x(), 0.2 * kRubForce, 2e-3);
}

TEST(FrictionModulation, OffContactAndNonsenseGiveNothingAndNothingAllocates) {
  FrictionModulationState state;
  const NoAllocation none;
  for (int i = 0; i < 100; ++i)
    modulateFriction(rubbing(), reactionOf(0.05), Vec3(5e-5, 0, 0), kRubTick, &state);
  EXPECT_EQ(modulateFriction(rubbing(), Vec3(0, 0, 0.01), Vec3(5e-5, 0, 0), kRubTick, &state).f_d,
            Vec3(Vec3::Zero()));
  EXPECT_EQ(state.wanted.F, (Packed3{0, 0, 0}));
  EXPECT_EQ(modulateFriction(rubbing(), Vec3(NAN, 0, 1), Vec3::Zero(), kRubTick, &state).f_d,
            Vec3(Vec3::Zero()));
  EXPECT_EQ(none.allocations(), 0);
}

}  // namespace
}  // namespace palpa::haptics

#include <gtest/gtest.h>

#include <cmath>
#include <memory>

#include "adds_up.h"
#include "haptics/loop/tick.h"
#include "tests/support/allocation_count.h"

/// Haptic augmented reality in the loop: a real soft thing with a flat top, a tool with a force
/// sensor on it.
namespace palpa::haptics {
namespace {

const HuntCrossley kRealThing{900, 200, 1.4};
const Dahl kRealThingsSurface{0.35, 1500, 0.4};

struct TouchLoop {
  TickConfig config;
  TickCommands commands;
  TickState state;
  std::int64_t now = 0;
  std::uint64_t readings = 0;
  Pose X_DP = Pose::Identity();
  SensorState sensor = SensorState::valid;

  TouchLoop() {
    config.contact_mode = ContactMode::sensed_object;
    config.object_at_port = 1;
    config.touch.surface.contact = {kRealThing, 0, kRealThingsSurface, {}, 0.1};
    config.touch.surface.wanted = kRealThingsSurface;
    config.touch.kinds[0] = {
        0.014,
        {8000, 0, 1.9},
        {HuntCrossley{600, 0, 1}, HuntCrossley{600, 0, 1}, HuntCrossley{300, 0, 1.1}}};
    config.touch.tip_radius = 0.008;
    config.safety.max_slew_N_per_s = 1e5;
    commands.armed = 1;
  }
  void turnThing(const Pose& X) {
    X_DP = X;
    config.X_DP = pack(X);
  }
  FlightRecord step(const Vec3& tip_P, const Vec3& f_P) {
    DeviceReading reading;
    reading.t_ns = now += 1'000'000;
    reading.sequence = ++readings;
    reading.homed = 1;
    reading.p_DE = pack(Vec3(X_DP * tip_P));
    const SensedForce sensed{pack(Vec3(X_DP.linear() * f_P)),
                             pack(Vec3(X_DP * (tip_P + 0.008 * Vec3::UnitZ()))),
                             sensor,
                             {}};
    TickForces forces;
    const FlightRecord record =
        tick(config, state, reading, nullptr, commands, now, sensed, nullptr, &forces);
    expectAddsUp(record, forces);
    return record;
  }
  /// Pressed straight down at `x` to `depth`, at 2 cm/s, and held there.
  FlightRecord press(double x, double depth) {
    FlightRecord last;
    for (double d = -1e-3; d < depth; d += 2e-5)
      last = step({x, 0, -d}, {0, 0, forceOf(kRealThing, std::max(d, 0.0), d > 0 ? 0.02 : 0)});
    for (int i = 0; i < 30; ++i) last = step({x, 0, -depth}, {0, 0, forceOf(kRealThing, depth, 0)});
    return last;
  }
};

TEST(TouchTick, TheRealThingAsItIsTakesNoForce) {
  TouchLoop loop;
  const FlightRecord last = loop.press(0, 0.006);
  EXPECT_LT(unpack(last.f_command_D).norm(), 1e-9);
  EXPECT_EQ(last.safety, SafetyCause::none);  // without any snapshot
  EXPECT_NEAR(last.indentation, 0.006, 1e-5);
  EXPECT_NEAR(last.skin_force, forceOf(kRealThing, 0.006, 0), 1e-6);
}

TEST(TouchTick, TwiceAsHardIsAsMuchAgain) {
  TouchLoop loop;
  loop.config.touch.surface.contact.target.factor = 2;
  const FlightRecord last = loop.press(0, 0.006);
  EXPECT_NEAR(last.f_command_D[2], forceOf(kRealThing, 0.006, 0), 0.01);
}

TopShape breast() {
  TopShape top;
  top.arch_high = 0.025;
  top.arch_half_x = top.arch_half_y = 0.05;
  return onOrigin(top);
}

/// Pressed into a dome and stroked over its flank, the device pushes along the normal under the tip
/// by what the depth along it asks for, and a cue's "up" is the normal of the shape.
TEST(TouchTick, OnADomeItPushesAlongTheNormalUnderTheTip) {
  const TopShape top = breast();
  TouchLoop loop;
  loop.turnThing(makePose(Eigen::AngleAxisd(0.4, Vec3::UnitY()).toRotationMatrix(), {0.1, 0, 0}));
  loop.config.top = top;
  loop.config.touch.surface.contact.target.factor = 2;
  DahlState rubs;
  FlightRecord last;
  const auto at = [&](double x, double depth) {
    return fromTop(top, Vec3(x, 0.01, 0.008 - depth));
  };
  const auto feel = [&](double x, double depth, const Vec3& slid) {
    const Vec3 n = normalOf(top, x, 0.01);
    const double f_n = forceOf(kRealThing, depth, 0);
    const Vec3 drag = dragOf(kRealThingsSurface, slid, n, f_n, 1e-3, &rubs);
    last = loop.step(at(x, depth) - 0.008 * Vec3::UnitZ(), f_n * n - drag);
  };
  for (double depth = 0; depth < 0.005; depth += 2e-5) feel(-0.03, depth, Vec3::Zero());
  for (double x = -0.03; x < 0.03; x += 2e-5) {
    feel(x, 0.005, at(x + 2e-5, 0.005) - at(x, 0.005));
    if (x < -0.029) continue;  // until it slides
    const Vec3 f_P = loop.X_DP.linear().transpose() * unpack(last.f_command_D),
               n = normalOf(top, x, 0.01);
    ASSERT_LT(f_P.normalized().cross(n).norm(), 0.06) << "3 degrees, at " << x;
    ASSERT_NEAR(last.indentation, 0.005, 1e-4) << x;
    ASSERT_NEAR(f_P.dot(n), forceOf(kRealThing, 0.005, 0), 0.02) << x;
  }
}

/// As the trial asks for it; where friction is not modulated, nothing is done.
TEST(TouchTick, TheTrialSaysHowRoughTheSurfaceIs) {
  const auto addedAlong = [](float friction, bool other) {
    TouchLoop loop;
    loop.config.touch.other_friction = other;
    loop.commands.friction = friction;
    loop.press(0, 0.006);
    const double f_n = forceOf(kRealThing, 0.006, 0);
    DahlState real;
    FlightRecord last;
    for (int i = 1; i <= 400; ++i) {
      const Vec3 drag =
          dragOf(kRealThingsSurface, Vec3(2e-5, 0, 0), Vec3::UnitZ(), f_n, 1e-3, &real);
      last = loop.step({2e-5 * i, 0, -0.006}, Vec3(0, 0, f_n) - drag);
    }
    return last.f_command_D[0];
  };
  const double once = forceOf(kRealThing, 0.006, 0) * kRealThingsSurface.mu +
                      kRealThingsSurface.B * 0.02;  // N; slides at 2 cm/s
  EXPECT_NEAR(addedAlong(2, true), -once, 0.02 * once);
  EXPECT_NEAR(addedAlong(0.5F, true), 0.5 * once, 0.02 * once);
  EXPECT_NEAR(addedAlong(1, true), 0, 0.02 * once);
  EXPECT_NEAR(addedAlong(2, false), 0, 1e-9);
}

/// Where the trial has put it, and nowhere else; in whatever frame the device is.
TEST(TouchTick, ALumpIsFeltWhereItLies) {
  const auto at = [](double x, const Pose& X_DP) {
    TouchLoop loop;
    loop.turnThing(X_DP);
    loop.commands.lumps[2] = {{0.02, 0, -0.014}, 1};
    return Vec3(X_DP.linear().transpose() * unpack(loop.press(x, 0.006).f_command_D));
  };
  const Pose turned =
      makePose(Eigen::AngleAxisd(1.1, Vec3(1, 2, -1).normalized()).toRotationMatrix(),
               Vec3(0.1, -0.2, 0.05));
  const Vec3 above = at(0.02, Pose::Identity());
  EXPECT_GT(above.z(), 0.15);
  EXPECT_LT(at(-0.02, Pose::Identity()).norm(), 0.2 * above.norm());
  EXPECT_LT((at(0.02, turned) - above).norm(), 1e-9);
}

TEST(TouchTick, WithoutItsSensorThereIsNoForceAndTheRecordSaysWhy) {
  TouchLoop loop;
  loop.config.touch.surface.contact.target.factor = 2;
  loop.press(0, 0.006);
  const Vec3 f(0, 0, forceOf(kRealThing, 0.006, 0));
  loop.sensor = SensorState::unusable;
  const NoAllocation none;
  const FlightRecord lost = loop.step({0, 0, -0.006}, f);
  EXPECT_EQ(lost.f_command_D, (Packed3{0, 0, 0}));
  EXPECT_EQ(lost.safety, SafetyCause::no_sensor);
  EXPECT_TRUE(lost.events & kSafetyTripped);
  loop.sensor = SensorState::valid;
  FlightRecord back = loop.step({0, 0, -0.006}, f);
  EXPECT_TRUE(back.events & kSafetyCleared);
  for (int i = 0; i < 30; ++i) back = loop.step({0, 0, -0.006}, f);
  EXPECT_GT(back.f_command_D[2], 0.5 * f.z());
  EXPECT_EQ(none.allocations(), 0);
}

TEST(TouchTick, ASensorThatIsSilentBetweenTrialsIsNoTrip) {
  TouchLoop loop;
  loop.commands.armed = 0;
  loop.sensor = SensorState::unusable;
  FlightRecord quiet;
  for (int i = 0; i < 30; ++i) quiet = loop.step({0, 0, 0.01}, Vec3::Zero());
  EXPECT_EQ(quiet.safety, SafetyCause::not_ready);
  EXPECT_FALSE(quiet.events & kSafetyTripped);
  EXPECT_EQ(unpack(quiet.f_command_D), Vec3(Vec3::Zero()));
  loop.commands.armed = 1;
  EXPECT_EQ(loop.step({0, 0, 0.01}, Vec3::Zero()).safety, SafetyCause::no_sensor);
}

/// White shaking of 50 mN at any force and speed.
TextureLaw whiteTexture() {
  TextureLaw law;
  law.speeds = law.forces = law.order = 1;
  law.ln_speed[0] = std::log(0.03);
  law.ln_force[0] = std::log(0.3);
  law.nodes[0][0].ln_rms = std::log(0.05);
  law.largest = 1;
  return law;
}

/// The device shakes along the thing's normal, however it lies, and the passivity observer takes
/// none of it for energy that has to be damped.
TEST(TouchTick, ATextureIsASourceAlongTheNormal) {
  for (const bool turned : {false, true}) {
    TouchLoop loop;
    if (turned)
      loop.turnThing(makePose(Mat3(Eigen::AngleAxisd(0.7, Vec3::UnitX())), Vec3(0.01, 0.02, 0)));
    loop.config.touch.texture = whiteTexture();
    loop.config.touch.surface.contact.friction = loop.config.touch.surface.wanted = {};
    loop.config.passivity.max_damping = 9;
    loop.press(0, 0.004);
    const Vec3 up = loop.X_DP.linear() * Vec3::UnitZ();
    const double f_n = forceOf(kRealThing, 0.004, 0);
    double squares = 0;
    for (int i = 0; i < 500; ++i) {
      const FlightRecord record = loop.step({1e-4 * i, 0, -0.004}, {0, 0, f_n});
      const Vec3 f = unpack(record.f_command_D);
      EXPECT_LT(f.cross(up).norm(), 1e-9);
      EXPECT_EQ(record.damped, 0);
      if (i >= 200) squares += f.squaredNorm() / 300;
    }
    // w = y - 0.9 y_before of white y
    EXPECT_NEAR(std::sqrt(squares), 0.05 * std::sqrt(1 + 0.9 * 0.9), 0.02);
  }
}

/// A copy of the state goes on with the same bits: a session can be replayed from any keyframe.
TEST(TouchTick, GoesOnFromAnyKeyframe) {
  auto loop = std::make_unique<TouchLoop>();
  loop->commands.lumps[0] = {{0.002, 0, -0.014}, 1};
  loop->press(0, 0.004);
  auto copy = std::make_unique<TouchLoop>(*loop);
  for (int i = 0; i < 50; ++i) {
    const Vec3 tip(1e-4 * i, 0, -0.004), f(-0.05, 0, 0.5);
    EXPECT_EQ(loop->step(tip, f).f_command_D, copy->step(tip, f).f_command_D);
  }
}

}  // namespace
}  // namespace palpa::haptics

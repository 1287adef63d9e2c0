#include "haptics/loop/tick.h"

#include <gtest/gtest.h>

#include <memory>

#include "adds_up.h"
#include "tests/support/allocation_count.h"

/// Two devices on one real thing in one tick.
namespace palpa::haptics {
namespace {

const HuntCrossley kSoftSide{900, 0, 1.4};
const Dahl kSideFriction{0.35, 1500, 0};
constexpr double kTipRadius = 0.008;

struct PairLoop {
  PairConfig config;
  PairState state;
  TickCommands commands;
  std::array<SensorState, 2> sensors{SensorState::valid, SensorState::valid};
  std::array<Pose, 2> X_DP{Pose::Identity(),
                           Pose::Identity()};  ///< two devices stand where they stand
  std::int64_t now = 0;

  explicit PairLoop(bool squeezing) {
    X_DP[1] = makePose(Eigen::AngleAxisd(2.1, Vec3(0, 1, 2).normalized()).toRotationMatrix(),
                       Vec3(0.2, 0.1, 0));
    for (std::size_t t = 0; t < 2; ++t) {
      TickConfig& tool = config.tools[t];
      tool.contact_mode = ContactMode::sensed_object;
      tool.object_at_port = 1;
      tool.touch.surface.contact = {kSoftSide, 0, kSideFriction, {}, 0.1};
      tool.touch.kinds[0] = {
          0.014,
          {8000, 0, 1.9},
          {HuntCrossley{600, 0, 1}, HuntCrossley{600, 0, 1}, HuntCrossley{300, 0, 1.1}}};
      tool.touch.tip_radius = kTipRadius;
      tool.safety.max_slew_N_per_s = 1e5;
      tool.X_DP = pack(X_DP[t]);
    }
    config.squeezing = squeezing;
    config.squeeze.real = kSoftSide;
    commands.armed = 1;
  }
  /// Middles of the tips and reactions on them, in P.
  std::array<FlightRecord, 2> step(const std::array<Vec3, 2>& p_P, const std::array<Vec3, 2>& f_P) {
    now += 1'000'000;
    std::array<DeviceReading, 2> readings;
    std::array<SensedForce, 2> sensed;
    for (std::size_t t = 0; t < 2; ++t) {
      readings[t].t_ns = now;
      readings[t].sequence = static_cast<std::uint64_t>(now / 1'000'000);
      readings[t].homed = 1;
      readings[t].p_DE = pack(Vec3(X_DP[t] * p_P[t]));
      sensed[t] = {
          pack(Vec3(X_DP[t].linear() * f_P[t])), pack(Vec3(X_DP[t] * p_P[t])), sensors[t], {}};
    }
    std::array<TickForces, 2> forces;
    const std::array<FlightRecord, 2> records =
        tickPair(config, state, readings, commands, now, sensed, &forces);
    for (std::size_t t = 0; t < 2; ++t) expectAddsUp(records[t], forces[t]);
    return records;
  }
  /// Both pressed down beside each other as deep as `depth`, slowly.
  std::array<FlightRecord, 2> press(double apart, double depth) {
    std::array<FlightRecord, 2> last;
    const auto down = [&](double d) {
      const Vec3 f(0, 0, forceOf(kSoftSide, std::max(d, 0.0), 0));
      last =
          step({Vec3(apart / 2, 0, kTipRadius - d), Vec3(-apart / 2, 0, kTipRadius - d)}, {f, f});
    };
    for (double d = -1e-3; d < depth; d += 2e-6) down(d);
    for (int i = 0; i < 30; ++i) down(depth);
    return last;
  }
  /// Held between them and squeezed by `x` at each side; a weight hangs on both.
  std::array<FlightRecord, 2> squeeze(double x, double weight = 0) {
    std::array<FlightRecord, 2> last;
    const auto at = [&](double depth) {
      const double F = forceOf(kSoftSide, std::max(depth, 0.0), 0),
                   hangs = depth > 0 ? -weight / 2 : 0;
      last = step({Vec3(0.03 - depth, 0, 0), Vec3(-0.03 + depth, 0, 0)},
                  {Vec3(F, 0, hangs), Vec3(-F, 0, hangs)});
    };
    for (double depth = -1e-3; depth < x; depth += 2e-6) at(depth);
    for (int i = 0; i < 30; ++i) at(x);
    return last;
  }
  Vec3 inP(std::size_t t, const FlightRecord& record) const {
    return X_DP[t].linear().transpose() * unpack(record.f_command_D);
  }
};

TEST(TickPair, TheRealThingAsItIsTakesNoForce) {
  PairLoop loop(false);
  for (const FlightRecord& record : loop.press(0.02, 0.006)) {
    EXPECT_LT(unpack(record.f_command_D).norm(), 1e-9);
    EXPECT_EQ(record.safety, SafetyCause::none);
    EXPECT_NEAR(record.indentation, 0.006, 1e-4);
  }
}

TEST(TickPair, ALumpBetweenThemIsFeltByBothAlike) {
  PairLoop loop(false);
  loop.commands.lumps[0] = {{0, 0, -0.014}, 1};
  const std::array<FlightRecord, 2> last = loop.press(0.02, 0.006);
  const Vec3 right = loop.inP(0, last[0]), left = loop.inP(1, last[1]);
  EXPECT_GT(right.z(), 0.05);
  EXPECT_LT((right - Vec3(-left.x(), left.y(), left.z())).norm(), 1e-6)
      << "each in its own device's frame, one thing";
}

TEST(TickPair, PressingGoesOnWithTheToolThatIsBelieved) {
  PairLoop loop(false);
  loop.config.tools[0].touch.surface.contact.target.factor = 2;
  loop.press(0.02, 0.006);
  loop.sensors[1] = SensorState::unusable;
  std::array<FlightRecord, 2> last;
  const Vec3 f(0, 0, forceOf(kSoftSide, 0.006, 0));
  const NoAllocation none;
  for (int i = 0; i < 30; ++i)
    last =
        loop.step({Vec3(0.01, 0, kTipRadius - 0.006), Vec3(-0.01, 0, kTipRadius - 0.006)}, {f, f});
  EXPECT_EQ(none.allocations(), 0);
  EXPECT_NEAR(loop.inP(0, last[0]).z(), f.z(), 0.02);
  EXPECT_EQ(last[1].f_command_D, (Packed3{0, 0, 0}));
  EXPECT_EQ(last[1].safety, SafetyCause::no_sensor);
  EXPECT_EQ(last[0].safety, SafetyCause::none);
}

TEST(TickPair, SqueezedItIsTwiceAsHardAndTwiceAsHeavy) {
  PairLoop loop(true);
  loop.config.squeeze.target.factor = 2;
  loop.config.squeeze.weight_factor = 2;
  const double F = forceOf(kSoftSide, 0.005, 0);
  const std::array<FlightRecord, 2> last = loop.squeeze(0.005, 0.2);
  EXPECT_LT((loop.inP(0, last[0]) - Vec3(F, 0, -0.1)).norm(), 0.01);
  EXPECT_LT((loop.inP(1, last[1]) - Vec3(-F, 0, -0.1)).norm(), 0.01);
}

TEST(TickPair, SqueezingTakesTwo) {
  for (std::size_t lost = 0; lost < 2; ++lost) {
    PairLoop loop(true);
    loop.config.squeeze.target.factor = 2;
    loop.squeeze(0.005);
    loop.sensors[lost] = SensorState::unusable;
    const double F = forceOf(kSoftSide, 0.005, 0);
    std::array<FlightRecord, 2> last;
    for (int i = 0; i < 30; ++i)
      last = loop.step({Vec3(0.025, 0, 0), Vec3(-0.025, 0, 0)}, {Vec3(F, 0, 0), Vec3(-F, 0, 0)});
    for (const FlightRecord& record : last) EXPECT_EQ(unpack(record.f_command_D).norm(), 0);
  }
}

TEST(TickPair, TheEmergencyStopIsForBothAndANewTrialForgets) {
  PairLoop loop(true);
  loop.config.squeeze.target.factor = 2;
  loop.squeeze(0.005);
  EXPECT_GT(loop.state.squeeze.d0, 0);
  const double F = forceOf(kSoftSide, 0.005, 0);
  loop.commands.emergency_stop = 1;
  for (const FlightRecord& record :
       loop.step({Vec3(0.025, 0, 0), Vec3(-0.025, 0, 0)}, {Vec3(F, 0, 0), Vec3(-F, 0, 0)})) {
    EXPECT_EQ(record.f_command_D, (Packed3{0, 0, 0}));
    EXPECT_EQ(record.safety, SafetyCause::emergency_stop);
  }
  loop.commands.trial = 2;
  loop.step({Vec3(0.05, 0, 0), Vec3(-0.05, 0, 0)}, {Vec3::Zero(), Vec3::Zero()});
  EXPECT_EQ(loop.state.squeeze.d0, 0);
}

TEST(TickPair, ACopyGoesOnWithTheSameBits) {
  auto loop = std::make_unique<PairLoop>(false);
  loop->commands.lumps[0] = {{0.002, 0, -0.014}, 1};
  loop->press(0.02, 0.004);
  auto copy = std::make_unique<PairLoop>(*loop);
  for (int i = 0; i < 50; ++i) {
    const std::array<Vec3, 2> p{Vec3(0.01 + 1e-4 * i, 0, kTipRadius - 0.004),
                                Vec3(-0.01, 0, kTipRadius - 0.004)},
        f{Vec3(-0.05, 0, 0.5), Vec3(0, 0, 0.5)};
    const auto one = loop->step(p, f), other = copy->step(p, f);
    for (std::size_t t = 0; t < 2; ++t) EXPECT_EQ(one[t].f_command_D, other[t].f_command_D);
  }
}

}  // namespace
}  // namespace palpa::haptics

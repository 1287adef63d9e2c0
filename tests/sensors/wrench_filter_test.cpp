#include "haptics/sensors/wrench_filter.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <vector>

#include "anatomy/base/error.h"
#include "moving_tool.h"

namespace palpa::haptics {
namespace {

const Vec3 kGravity_W(0, 0, -9.80665);
constexpr LowPass kNoFilter{};

double distance(const Packed3& a, const Packed3& b) { return (unpack(a) - unpack(b)).norm(); }

WrenchSample sampleOf(const Wrench& measured, const Wrench& bias = {}) {
  WrenchSample sample;
  sample.sequence = 1;
  for (std::size_t i = 0; i < 3; ++i) {
    sample.f_S[i] = measured.f_S[i] + bias.f_S[i];
    sample.tau_S[i] = measured.tau_S[i] + bias.tau_S[i];
  }
  return sample;
}

struct Worst {
  double f = 0, tau = 0;
};

const Wrench kContact{{1.5, -2.0, 3.0}, {0.05, 0.02, -0.04}};
const Wrench kBias{{4, -3, 2}, {0.1, 0.2, -0.3}};

/// Largest error over `seconds` of waving; valid from the third tick on.
Worst worstError(const MovingTool& tool, const WrenchFilter& filter, double seconds = 4) {
  WrenchFilterState state;
  Worst worst;
  for (int k = 0; k < seconds * 1000; ++k) {
    const double t = k * 1e-3;
    const WrenchSample sample = sampleOf(tool.measured(t, kContact, kGravity_W), kBias);
    const ContactWrench got = step(filter, state, sample, tool.pose(t), k * 1'000'000LL);
    EXPECT_EQ(got.valid, k >= 2);
    if (!got.valid) continue;
    worst.f = std::max(worst.f, distance(got.contact.f_S, kContact.f_S));
    worst.tau = std::max(worst.tau, distance(got.contact.tau_S, kContact.tau_S));
  }
  return worst;
}

WrenchFilter filterFor(const ToolLoad& tool, const LowPass& low_pass) {
  WrenchFilter filter;
  filter.low_pass = low_pass;
  filter.tool = tool;
  filter.bias = kBias;
  return filter;
}

/// Three ticks of the same, at rest along W.
ContactWrench atRest(const WrenchFilter& filter, const WrenchSample& sample) {
  WrenchFilterState state;
  for (int k = 0; k < 2; ++k) EXPECT_FALSE(step(filter, state, sample, {}, k * 1'000'000LL).valid);
  return step(filter, state, sample, {}, 2'000'000);
}

TEST(WrenchFilter, AHangingToolThatIsPushedUpReadsThePushUp) {
  WrenchFilter filter;
  filter.tool = {0.2, {0, 0, -0.1}, {}};  // S along W, the tool below it
  const double weight = 0.2 * 9.80665;
  const Wrench measured{{0, 0, -weight + 1.0}, {0, 0, 0}};  // its weight pulls the sensor down
  const ContactWrench got = atRest(filter, sampleOf(measured));
  ASSERT_TRUE(got.valid);
  EXPECT_LT(distance(got.contact.f_S, {0, 0, 1}), 1e-12);
  EXPECT_LT(distance(got.contact.tau_S, {0, 0, 0}), 1e-12);
}

TEST(WrenchFilter, AHorizontalToolsWeightTurnsAboutTheSensor) {
  WrenchFilter filter;
  filter.tool = {0.2, {0.1, 0, 0}, {}};
  const double weight = 0.2 * 9.80665;  // r x m g = (0.1, 0, 0) x (0, 0, -w) = (0, 0.1 w, 0)
  const Wrench measured{{0, 0, -weight}, {0, 0.1 * weight, 0}};
  const ContactWrench got = atRest(filter, sampleOf(measured));
  ASSERT_TRUE(got.valid);
  EXPECT_LT(distance(got.contact.f_S, {0, 0, 0}), 1e-12);
  EXPECT_LT(distance(got.contact.tau_S, {0, 0, 0}), 1e-12);
}

// Differences over 1 ms: (2 pi f h)^2/12. Turns of up to 2 rad at 4 Hz swing the tool at 8 Hz: 2e-4
// of forces below 10 N and of torques below 0.5 N m.
TEST(WrenchFilter, AKnownContactIsRecoveredFromAToolThatIsWavedAbout) {
  double f = 0, tau = 0, without = 0;
  for (std::uint64_t seed = 1; seed <= 10; ++seed) {
    const MovingTool tool(seed);
    for (const LowPass& low_pass : {kNoFilter, butterworth(30, 1000)}) {
      const Worst worst = worstError(tool, filterFor(tool.load(), low_pass));
      f = std::max(f, worst.f);
      tau = std::max(tau, worst.tau);
    }
    without = std::max(without, worstError(tool, filterFor({}, kNoFilter)).f);
  }
  EXPECT_LT(f, 2e-3);
  EXPECT_LT(tau, 1e-4);
  EXPECT_GT(without, 2) << "the motion must be one that matters";
  RecordProperty("worst_force_error_N", std::to_string(f));
  RecordProperty("worst_torque_error_Nm", std::to_string(tau));
  RecordProperty("uncompensated_N", std::to_string(without));
}

TEST(WrenchFilter, EveryPartOfTheLoadIsNeeded) {
  const MovingTool tool(3);
  ToolLoad point = tool.load(), central = tool.load();
  point.inertia = {};
  central.p_SM = {0, 0, 0};
  EXPECT_GT(worstError(tool, filterFor(point, kNoFilter)).tau, 1e-3);
  EXPECT_GT(worstError(tool, filterFor(central, kNoFilter)).f, 0.1);
  EXPECT_GT(worstError(tool, filterFor(central, kNoFilter)).tau, 0.01);
}

TEST(WrenchFilter, AWrongMassShowsAsItsOwnWeightAndInertia) {
  const MovingTool tool(5);
  const double more = 0.05;
  ToolLoad heavy = tool.load();
  heavy.mass += more;
  const WrenchFilter right = filterFor(tool.load(), kNoFilter), wrong = filterFor(heavy, kNoFilter);
  WrenchFilterState a, b;
  double largest = 0;
  for (int k = 0; k < 1000; ++k) {
    const WrenchSample sample = sampleOf(tool.measured(k * 1e-3, kContact, kGravity_W), kBias);
    const PackedPose X_WS = tool.pose(k * 1e-3);
    const Wrench good = step(right, a, sample, X_WS, k * 1'000'000LL).contact;
    const Wrench bad = step(wrong, b, sample, X_WS, k * 1'000'000LL).contact;
    // -dm (g - a_M), and the tool's own force is m (g - a_M): the same scaled.
    const Wrench own = toolWrench(tool.load(), a.motion.motion);
    const Vec3 expected = -more / tool.load().mass * unpack(own.f_S);
    if (k < 2) continue;
    ASSERT_LT((unpack(bad.f_S) - unpack(good.f_S) - expected).norm(), 1e-12);
    ASSERT_LT(
        (unpack(bad.tau_S) - unpack(good.tau_S) - unpack(tool.load().p_SM).cross(expected)).norm(),
        1e-12);
    largest = std::max(largest, expected.norm());
  }
  EXPECT_GT(largest, more * 9.8);
}

TEST(WrenchFilter, NoiseOfThePoseGrowsAsTheSecondDifferencePredicts) {
  WrenchFilter filter;
  filter.low_pass = butterworth(30, 1000);
  filter.tool.mass = 0.1;
  double gain = 0;  // sum of squares of the impulse response of L after (1, -2, 1)/dt^2
  LowPassState<1> impulse;
  for (int k = 0; k < 2000; ++k) {
    const double d = k == 0 || k == 2 ? 1e6 : k == 1 ? -2e6 : 0;
    const double y = apply(filter.low_pass, impulse, std::array{d})[0];
    gain += y * y;
  }
  RandomStream random(1, "pose noise");
  WrenchFilterState state;
  const WrenchSample still = sampleOf({{0, 0, -0.1 * 9.80665}, {}});
  double squares = 0;
  const int n = 50'000;
  const double sd = 20e-6;
  for (int k = -1000; k < n; ++k) {
    const PackedPose X_WS{{random.normal(0, sd), 0, 0}, {1, 0, 0, 0}};
    const double f = step(filter, state, still, X_WS, k * 1'000'000LL).contact.f_S[0];
    if (k >= 0) squares += f * f;
  }
  const double expected = filter.tool.mass * sd * std::sqrt(gain);
  EXPECT_NEAR(std::sqrt(squares / n), expected, 0.05 * expected);  // correlated over 30 samples
  RecordProperty("force_noise_mN_of_20um_100g_30Hz", std::to_string(expected * 1e3));
}

/// A filter at rest whose inputs the test chooses.
struct Ticks {
  WrenchFilter filter;
  WrenchFilterState state;
  std::int64_t now = 0;
  Ticks() {
    filter.low_pass = butterworth(20, 1000);
    for (int i = 0; i < 3; ++i) push(2);
  }
  ContactWrench push(double f, std::uint32_t flags = 0, const PackedPose& X_WS = {}) {
    WrenchSample sample = sampleOf({{f, 0, 0}, {}});
    sample.flags = flags;
    return step(filter, state, sample, X_WS, now += 1'000'000);
  }
};

TEST(WrenchFilter, AnUnusableSampleGivesNothingAndLeavesNoTrace) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  for (const std::uint32_t flag : {kNothingYet, kSilent, kFault, kSaturated, kOverload}) {
    Ticks ticks;
    ASSERT_NEAR(ticks.push(2).contact.f_S[0], 2, 1e-12);
    const bool unusable = flag != kOverload;  // large, but measured
    EXPECT_EQ(ticks.push(500, flag).valid, !unusable) << flag;
    if (!unusable) continue;
    EXPECT_FALSE(ticks.push(3).valid) << "nothing of one call ago";
    EXPECT_NEAR(ticks.push(3).contact.f_S[0], 3, 1e-12);
  }
  Ticks ticks;
  EXPECT_FALSE(ticks.push(nan).valid);
  ticks.push(4);
  EXPECT_NEAR(ticks.push(4).contact.f_S[0], 4, 1e-12);
}

TEST(WrenchFilter, APoseThatIsNotFiniteOrAGapCostsThreePoses) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  Ticks broken, late;
  EXPECT_FALSE(broken.push(5, 0, {{0, nan, 0}, {1, 0, 0, 0}}).valid);
  late.now += 50'000'000;
  EXPECT_FALSE(late.push(5).valid);
  EXPECT_FALSE(broken.push(5).valid);
  for (Ticks* ticks : {&broken, &late}) {
    EXPECT_FALSE(ticks->push(5).valid);
    EXPECT_NEAR(ticks->push(5).contact.f_S[0], 5, 1e-12);
  }
}

TEST(SensorMotion, TheSameReadingTwiceKeepsTheMotion) {
  const MovingTool tool(4);
  MotionState state;
  for (int k = 0; k < 5; ++k) observe({}, state, tool.pose(k * 1e-3), k * 1'000'000LL);
  const Packed3 a = state.motion.a_S;
  EXPECT_GT(unpack(a).norm(), 0);
  EXPECT_EQ(observe({}, state, tool.pose(4e-3), 4'000'000).a_S, a);
}

TEST(SensorMotion, AfterAGapOrATimeThatGoesBackThereIsGravityAlone) {
  const MovingTool tool(4);
  for (const std::int64_t then : {20'000'000LL, -20'000'000LL}) {
    MotionState state;
    for (int k = 0; k < 5; ++k) observe({}, state, tool.pose(k * 1e-3), k * 1'000'000LL);
    const PackedPose X_WS = tool.pose(1.0);
    const SensorMotion motion = observe({}, state, X_WS, then);
    EXPECT_EQ(motion.a_S, (Packed3{0, 0, 0}));
    EXPECT_EQ(motion.alpha_S, (Packed3{0, 0, 0}));
    EXPECT_LT((unpack(motion.g_S) - unpack(X_WS.q).conjugate() * kGravity_W).norm(), 1e-12);
  }
}

}  // namespace
}  // namespace palpa::haptics

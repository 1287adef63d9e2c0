#include "apps/task_palpation/palpation_task.h"

#include <gtest/gtest.h>

#include "anatomy/base/error.h"
#include "apps/task_palpation/guidance.h"

namespace palpa::task_palpation {
namespace {

constexpr double kRadius = 0.008;
const Vec3 kTop_D(0.01, -0.1, 0.02);  // the phantom's frame in D, turned so that its z is D's y

haptics::TickConfig config() {
  haptics::TickConfig c;
  c.touch.tip_radius = kRadius;
  Mat3 R;
  R << 1, 0, 0, 0, 0, 1, 0, -1, 0;  // columns: x, y, z of P in D
  c.X_DP = pack(makePose(R, kTop_D));
  return c;
}

/// A tool upright in P with its end at `p_P`, a force along P's z.
haptics::FlightRecord at(const Vec3& p_P, std::int64_t t_ns, double real_N, double device_N,
                         std::uint32_t buttons = 0) {
  const haptics::TickConfig c = config();
  const Pose X_PT = makePose(rotationWithZ(-Vec3::UnitZ()), p_P), X_DT = unpack(c.X_DP) * X_PT;
  haptics::FlightRecord r;
  r.t_ns = t_ns;
  r.commands.trial = 1;
  r.commands.armed = 1;
  r.reading.homed = 1;
  r.reading.buttons = buttons;
  const PackedPose packed = pack(X_DT);
  r.reading.p_DE = packed.p;
  r.reading.q_DE = packed.q;
  const Vec3 z_D = unpack(c.X_DP).linear() * Vec3::UnitZ();
  r.sensed.f_D = pack(Vec3(real_N * z_D));
  r.f_command_D = pack(Vec3(device_N * z_D));
  return r;
}

TEST(PalpationListener, HearsPlaceAndBothForces) {
  PalpationListener listener(config());
  listener.begin(1);
  EXPECT_TRUE(listener.add(at({0.01, -0.02, -0.004}, 1'000'000, 0.4, 0.1)));
  ASSERT_EQ(listener.samples().size(), 1u);
  EXPECT_LT((listener.samples()[0].p_P - Vec3(0.01, -0.02, -0.004)).norm(), 1e-9);
  EXPECT_NEAR(listener.samples()[0].f_n, 0.5, 1e-9);
}

/// Both fingers in the same ticks, the second on a device that stands elsewhere.
TEST(PalpationListener, OfTwoFingersEachIsFeltForItselfAndTheFirstOnesClockAndButtonCount) {
  haptics::PairConfig pair;
  pair.tools = {config(), config()};
  pair.tools[1].X_DP = pack(Pose(Eigen::Translation3d(0, 0, 0.1) * unpack(config().X_DP)));
  PalpationListener listener(config(), pair);
  listener.begin(1);
  for (int i = 0; i < 20; ++i) {
    EXPECT_EQ(listener.add(at({0.01, 0, -0.004}, i * 1'000'000, 0.4, 0.1)), i % 10 == 0);
    haptics::FlightRecord second =
        at({0.03, 0, -0.002}, i * 1'000'000, 0.2, 0, PalpationListener::kMark);
    second.tool = 1;
    second.reading.p_DE[2] += 0.1;
    EXPECT_EQ(listener.add(second), i % 10 == 0);
  }
  ASSERT_EQ(listener.samples().size(), 4u);
  for (std::size_t i = 0; i < 4; ++i) {
    const assess::PalpationSample& sample = listener.samples()[i];
    EXPECT_EQ(sample.tool, static_cast<int>(i % 2));
    EXPECT_LT((sample.p_P - (i % 2 == 0 ? Vec3(0.01, 0, -0.004) : Vec3(0.03, 0, -0.002))).norm(),
              1e-9);
    EXPECT_NEAR(sample.f_n, i % 2 == 0 ? 0.5 : 0.2, 1e-9);
  }
  EXPECT_NEAR(listener.seconds(), 0.019, 1e-12) << "once, not twice";
  EXPECT_TRUE(listener.marks().empty()) << "the second finger's button";
  EXPECT_NEAR(pressing(listener.samples()), 0.5, 1e-9);
}

/// Places lie along a curved top, and a press is what goes along its normal.
TEST(PalpationListener, OnACurvedTopPlaceAndForceAreAlongItsNormal) {
  haptics::TickConfig c = config();
  c.top.arch_high = 0.02;
  c.top.arch_half_x = c.top.arch_half_y = 0.045;
  c.top = onOrigin(c.top);
  const Vec3 along(0.02, -0.01, -0.004), n = normalOf(c.top, along.x(), along.y()),
                                         middle = fromTop(c.top, along + Vec3(0, 0, kRadius));
  PalpationListener listener(c);
  listener.begin(1);
  haptics::FlightRecord r = at(middle - Vec3(0, 0, kRadius), 1'000'000, 0, 0);
  const Mat3 R_DP = unpack(c.X_DP).linear();
  r.sensed.f_D = pack(Vec3(R_DP * (0.5 * n + 0.2 * n.unitOrthogonal())));
  ASSERT_TRUE(listener.add(r));
  EXPECT_LT((listener.samples()[0].p_P - along).norm(), 1e-9);
  EXPECT_NEAR(listener.samples()[0].f_n, 0.5, 1e-9);
}

TEST(PalpationListener, KeepsOneSampleInTenMillisecondsAndNoPauses) {
  PalpationListener listener(config());
  listener.begin(1);
  for (int i = 0; i < 1000; ++i) listener.add(at({0, 0, 0}, i * 1'000'000, 0, 0));
  EXPECT_EQ(listener.samples().size(), 100u);
  EXPECT_NEAR(listener.seconds(), 0.999, 1e-9);
  haptics::FlightRecord paused = at({0, 0, 0}, 1'000'000'000, 0, 0);
  paused.commands.armed = 0;
  EXPECT_FALSE(listener.add(paused));
  listener.add(at({0, 0, 0}, 60'000'000'000, 0, 0));
  EXPECT_NEAR(listener.seconds(), 0.999, 1e-9) << "a minute's pause is no time of searching";
}

TEST(PalpationListener, AMarkIsAButtonThatGoesDownOverThePhantom) {
  PalpationListener listener(config());
  listener.begin(1);
  auto add = [&, t = std::int64_t{0}](const Vec3& p_P, bool down) mutable {
    listener.add(at(p_P, t += 1'000'000, 0, 0, down ? PalpationListener::kMark : 0));
  };
  add({0, 0, 0}, true);  // held since before the trial
  add({0, 0, 0}, false);
  add({0, 0, 0.05}, true);  // in the air
  add({0, 0, 0.05}, false);
  EXPECT_TRUE(listener.marks().empty());
  add({0.005, 0.01, 0.001}, true);
  add({0.006, 0.01, 0.001}, true);  // the same press
  add({0.006, 0.01, 0.001}, false);
  add({0.02, 0.01, 0}, true);
  ASSERT_EQ(listener.marks().size(), 2u);
  EXPECT_NEAR(listener.marks()[0].p_P.x(), 0.005, 1e-9);
  listener.grade(0, 2, 0);
  listener.grade(0.016, 0, 0);
  EXPECT_EQ(listener.marks()[1].hardness, 2);
  EXPECT_EQ(listener.marks()[1].diameter, 0.016);
  listener.grade(0.01, 0, 0, 1);
  EXPECT_EQ(listener.marks()[0].diameter, 0.01);
  listener.grade(0.01, 0, 0, 7);  // there is none
}

TEST(PalpationListener, AButtonHeldOverAPauseMarksNothing) {
  PalpationListener listener(config());
  listener.begin(1);
  listener.add(at({0, 0, 0}, 1'000'000, 0, 0));
  haptics::FlightRecord paused = at({0, 0, 0}, 2'000'000, 0, 0, PalpationListener::kMark);
  paused.commands.armed = 0;
  listener.add(paused);
  listener.add(at({0, 0, 0}, 3'000'000, 0, 0, PalpationListener::kMark));
  EXPECT_TRUE(listener.marks().empty());
}

TEST(Grades, GoThroughWordsAndBack) {
  const trial::Grade grade = trial::gradeOf(trial::gradeText(0.016, 2, 1));
  EXPECT_EQ(grade.diameter, 0.016);
  EXPECT_EQ(grade.hardness, 2);
  EXPECT_EQ(grade.mobility, 1);
  EXPECT_EQ(trial::gradeText(0, 0, 0), "");
  EXPECT_EQ(trial::gradeOf("diameter nonsense mm").diameter, 0);
  EXPECT_EQ(trial::gradeOf("").hardness, 0);
}

TEST(Cases, GoThroughTheRecordAndBack) {
  const std::vector<assess::CaseLump> lumps{{{0.01, 0.02, -0.018}, 0.016, 2, 1},
                                            {{-0.01, 0, -0.011}, 0.012, 1, 2}};
  const std::vector<assess::CaseLump> again = caseOf(caseText(lumps));
  ASSERT_EQ(again.size(), 2u);
  EXPECT_EQ(again[1].p_P, lumps[1].p_P);
  EXPECT_FALSE(takenIn(caseText(lumps)));
  EXPECT_TRUE(takenIn(caseText(lumps, true)));
  EXPECT_EQ(caseOf(caseText(lumps, true)).size(), lumps.size());
  EXPECT_EQ(again[1].mobility, 2);
  EXPECT_TRUE(caseOf(caseText({})).empty());
  EXPECT_THROW(caseOf("[{\"p_P_m\": 3}]"), Error);
  EXPECT_THROW(caseOf("lumps"), Error);
}

assess::CoverageMap emptyMap() { return {{0.03, 0.03}, {0.15, 0.3, 0.6}, 0.006}; }

void feel(assess::CoverageMap& map, const Vec3& p_P) { map.add({1, p_P, 0.2}); }

TEST(Guidance, LeadsAlongStripsToWhatWasNotFelt) {
  assess::CoverageMap map = emptyMap();
  const std::optional<Vec3> first = nextInStrips(map);
  ASSERT_TRUE(first);
  EXPECT_LT(first->x(), -0.02);
  EXPECT_LT(first->y(), -0.025) << "from the near left";
  feel(map, *first);
  EXPECT_GT(nextInStrips(map)->y(), first->y());
  for (double x = -0.03; x <= 0.03; x += 0.004)
    for (double y = -0.03; y <= 0.03; y += 0.004) feel(map, {x, y, 0});
  EXPECT_FALSE(nextInStrips(map));
}

TEST(Guidance, WaitsLongerTheBetterItGoesAndLeavesEverySecondTrialAlone) {
  Guidance guidance(true);
  const assess::CoverageMap map = emptyMap();
  EXPECT_TRUE(guidance.helps(1));
  EXPECT_FALSE(guidance.helps(2));
  guidance.begin(1);
  EXPECT_FALSE(guidance.lead(map, 1.9));
  EXPECT_TRUE(guidance.lead(map, 2.1));
  EXPECT_TRUE(guidance.lead(map, 3.1));
  EXPECT_NEAR(guidance.shown_s(), 1.2, 1e-9);
  guidance.end(true);
  EXPECT_NEAR(guidance.amount(), 0.66, 1e-9);
  guidance.begin(2);
  EXPECT_FALSE(guidance.lead(map, 100));
  EXPECT_EQ(guidance.shown_s(), 0);
  guidance.end(true);
  guidance.begin(3);
  EXPECT_FALSE(guidance.lead(map, 6));
  EXPECT_TRUE(guidance.lead(map, 6.5));
  guidance.end(true);
  EXPECT_FALSE(guidance.helps(5)) << "nobody who covers everything needs it";
  guidance.end(false);
  EXPECT_TRUE(guidance.helps(5));
  EXPECT_FALSE(Guidance(false).helps(1));
}

}  // namespace
}  // namespace palpa::task_palpation

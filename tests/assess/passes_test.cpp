#include "apps/assess/needle/phases.h"

#include <gtest/gtest.h>

#include "tests/assess/motions.h"

namespace palpa::assess::test {
namespace {

/// Passes counted while they are made, beside those of the score.
void expectPasses(const std::vector<TrialSample>& samples, int passes) {
  PassCounter counter;
  for (const TrialSample& s : samples) counter.add(s);
  EXPECT_EQ(counter.passes(), passes);
  const TrialAssessment a = assess(samples, "time");
  EXPECT_EQ(a.skin_punctures + a.redirections, passes);
}

Motion redirectedTimes(int times) {
  Motion m;
  m.push(0.010).puncture().push(0.008).turnTo(taughtPath().direction_L).push(0.020);
  for (int i = 0; i < times; ++i)
    m.push(-0.010).turnTo(direction_L((i % 2 ? 25 : 35) * kDeg, 15 * kDeg)).push(0.012);
  return m;
}

TEST(PassCounter, CountsAsTheScoreDoes) {
  expectPasses(Motion().hold(1).samples(), 0);
  expectPasses(textbook().samples(), 1);
  for (int times = 1; times <= 4; ++times)
    expectPasses(redirectedTimes(times).samples(), 1 + times);
  Motion twice = redirectedTimes(2);
  twice.withdraw()
      .push(-0.005)
      .push(0.005)
      .puncture()
      .push(0.008)
      .turnTo(taughtPath().direction_L)
      .push(0.028);
  expectPasses(twice.samples(), 4);
}

TEST(PassCounter, TellsTheFourthPassWhenItIsUnderWay) {
  const std::vector<TrialSample> samples = redirectedTimes(3).samples();
  PassCounter counter;
  std::size_t at = 0;
  while (at < samples.size() && counter.passes() <= 3) counter.add(samples[at++]);
  ASSERT_LT(at, samples.size());
  // 12 mm at 10 mm/s: the fourth pass counts when it has gone 3 mm.
  EXPECT_NEAR(samples[at - 1].t_s, samples.back().t_s - 0.9, 0.01);
}

}  // namespace
}  // namespace palpa::assess::test

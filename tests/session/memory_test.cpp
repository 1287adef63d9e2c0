#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>

#include "anatomy/base/quantile.h"
#include "apps/session/comparison_session.h"
#include "apps/session/palpation_session.h"
#include "apps/session/pulse_session.h"
#include "apps/session/search_session.h"
#include "tests/session/quick_sessions.h"
#include "tests/support/counts.h"
#include "tests/support/live_bytes.h"

/// What a session holds does not grow with its trials but by their results: the ticks are in the
/// evidence. A needle's trial has some 20,000 ticks of 144 bytes.
namespace palpa::session {
namespace {

constexpr double kResultBytes = 50'000;  // bytes of a trial

SessionOptions sessionOf(int trials) {
  SessionOptions options = quick(OperatorKind::expert, 11);
  options.trials = trials;
  return options;
}

/// Bytes a trial in what `run` leaves of a session, once a first one has made what is made once in
/// a program.
template <typename World, typename Run>
double heldPerTrial(int trials, const Run& run) {
  {
    const SessionOptions first = sessionOf(1);
    Quick<World> world(first);
    run(first, world);
  }
  const SessionOptions options = sessionOf(trials);
  Quick<World> world(options);
  const std::int64_t before = LiveBytes::now();
  LiveBytes::note();
  const auto left = run(options, world);
  return static_cast<double>(LiveBytes::now() - before) / static_cast<double>(left.trials.size());
}

double middleOf(std::vector<std::int64_t>::const_iterator from,
                std::vector<std::int64_t>::const_iterator to) {
  return quantile(std::vector<double>(from, to), 0.5);
}

/// From the second third of the session to the last.
double growthPerTrial(int trials) {
  const std::vector<std::int64_t> lows = LiveBytes::lows();
  const auto third = static_cast<std::ptrdiff_t>(lows.size() / 3);
  const double second = middleOf(lows.begin() + third, lows.begin() + 2 * third),
               last = middleOf(lows.begin() + 2 * third, lows.end());
  return (last - second) / (trials / 3.0);
}

TEST(Memory, OfANeedleDoesNotGrowWithItsTrials) {
  const int trials = test::counted(4, 30);
  const double held =
      heldPerTrial<NeedleWorld>(trials, [](const SessionOptions& options, NeedleWorld& world) {
        return runNeedleSession(options, world, freshPlace("needle"));
      });
  const double grown = growthPerTrial(trials);
  std::printf("a needle's trial: %.1f kB while it goes on, %.1f kB left\n", 1e-3 * grown,
              1e-3 * held);
  EXPECT_LT(grown, kResultBytes);
  EXPECT_LT(held, kResultBytes);
  EXPECT_GT(held, sizeof(task_needle::CompletedTrial)) << "nothing was counted";
}

TEST(Memory, OfAPalpationIsThatOfItsResults) {
  if (!test::fullCounts()) GTEST_SKIP() << "a palpation takes long: with every stated count";
  EXPECT_LT(heldPerTrial<PalpationWorld>(2,
                                         [](const SessionOptions& options, const auto& world) {
                                           return runPalpation(options, world,
                                                               freshPlace("palpation"));
                                         }),
            kResultBytes);
}

TEST(Memory, OfASearchIsThatOfItsResults) {
  EXPECT_LT(heldPerTrial<SearchWorld>(2,
                                      [](const SessionOptions& options, const auto& world) {
                                        return runSearch(options, world, freshPlace("search"));
                                      }),
            kResultBytes);
}

TEST(Memory, OfASqueezeIsThatOfItsResults) {
  EXPECT_LT(heldPerTrial<SqueezeWorld>(2,
                                       [](const SessionOptions& options, const auto& world) {
                                         return runComparison(options, world,
                                                              freshPlace("squeeze"));
                                       }),
            kResultBytes);
}

TEST(Memory, OfAPulseIsThatOfItsResults) {
  EXPECT_LT(heldPerTrial<PulseWorld>(2,
                                     [](const SessionOptions& options, const auto& world) {
                                       return runPulse(options, world, freshPlace("pulse"));
                                     }),
            kResultBytes);
}

TEST(Memory, OfFrictionIsThatOfItsResults) {
  EXPECT_LT(heldPerTrial<FrictionWorld>(2,
                                        [](const SessionOptions& options, const auto& world) {
                                          return runComparison(options, world,
                                                               freshPlace("friction"));
                                        }),
            kResultBytes);
}

}  // namespace
}  // namespace palpa::session

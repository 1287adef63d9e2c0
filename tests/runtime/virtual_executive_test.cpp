#include <gtest/gtest.h>

#include <stdexcept>
#include <vector>

#include "activities.h"

namespace palpa::runtime {
namespace {

using Log = std::vector<std::pair<std::int64_t, std::string>>;

/// Tells its steps to `log`; every `period` from 0 until `end`.
Doing ticker(Log& log, const std::string& name, std::int64_t period, std::int64_t end) {
  return {name, [&log, name, period, end](std::int64_t now) {
            log.emplace_back(now, name);
            return now + period > end ? kNever : now + period;
          }};
}

TEST(VirtualExecutive, StepsInOrderOfDueTimeThenPriorityThenAdding) {
  Log log;
  Doing slow = ticker(log, "slow", 30, 60), fast = ticker(log, "fast", 20, 60),
        twin = ticker(log, "twin", 30, 60);
  const auto executive = makeVirtualExecutive();
  executive->add(slow, {5, false, false});
  executive->add(fast, {1, false, false});
  executive->add(twin, {5, false, false});
  executive->run();
  const Log expected{{0, "fast"},  {0, "slow"},  {0, "twin"},  {20, "fast"}, {30, "slow"},
                     {30, "twin"}, {40, "fast"}, {60, "fast"}, {60, "slow"}, {60, "twin"}};
  EXPECT_EQ(log, expected);
  EXPECT_EQ(executive->clock().now(), 60);
  EXPECT_EQ(executive->mode(), TimeMode::virtual_time);
}

TEST(VirtualExecutive, TimeNeverGoesBackThoughAnActivityAsksForThePast) {
  std::vector<std::int64_t> times;
  int left = 5;
  Doing late("late", [&](std::int64_t now) {
    times.push_back(now);
    return --left ? now - 1000 : kNever;
  });
  Doing other("other", [&](std::int64_t now) {
    times.push_back(now);
    return now >= 100 ? kNever : now + 50;
  });
  const auto executive = makeVirtualExecutive();
  executive->add(late, {0, false, false});
  executive->add(other, {1, false, false});
  executive->run();
  ASSERT_EQ(times.size(), 8u);
  for (std::size_t i = 1; i < times.size(); ++i) EXPECT_GE(times[i], times[i - 1]);
}

TEST(VirtualExecutive, ClockStandsAtTheStepThatRuns) {
  const auto executive = makeVirtualExecutive();
  int steps = 0;
  Doing reader("reader", [&](std::int64_t now) {
    EXPECT_EQ(executive->clock().now(), now);
    return ++steps == 10 ? kNever : now + 7;
  });
  executive->add(reader, {});
  executive->run();
  EXPECT_EQ(steps, 10);
}

TEST(VirtualExecutive, StopEndsAfterTheStepThatAsked) {
  const auto executive = makeVirtualExecutive();
  Log log;
  Doing endless = ticker(log, "endless", 10, kSecond);
  Doing stopper("stopper", [&](std::int64_t now) {
    if (now >= 100) executive->stop();
    return now + 100;
  });
  executive->add(stopper, {0, false, false});
  executive->add(endless, {1, false, false});
  executive->run();
  EXPECT_EQ(log.back().first, 90) << "the step due with the stop, but later in order, is not run";
}

TEST(VirtualExecutive, ExceptionReachesTheCaller) {
  const auto executive = makeVirtualExecutive();
  Doing faulty("faulty",
               [](std::int64_t) -> std::int64_t { throw std::runtime_error("lens cap"); });
  executive->add(faulty, {});
  EXPECT_THROW(executive->run(), std::runtime_error);
}

TEST(VirtualExecutive, SaysWhatStepsCostAndStepsInTheSameOrder) {
  Log plain, measured;
  StepCosts costs;
  for (const bool asked : {false, true}) {
    const auto executive = makeVirtualExecutive(asked ? &costs : nullptr);
    Log& log = asked ? measured : plain;
    Doing fast = ticker(log, "fast", 10, 100), slow = ticker(log, "slow", 30, 100);
    executive->add(slow, {0, false, false});
    executive->add(fast, {1, false, false});
    executive->run();
  }
  EXPECT_EQ(measured, plain);
  ASSERT_EQ(costs.size(), 2u);
  EXPECT_GT(costs.at("fast"), 0);
  EXPECT_GT(costs.at("slow"), 0);
}

TEST(VirtualExecutive, WithoutActivitiesItReturns) {
  const auto executive = makeVirtualExecutive();
  executive->run();
  EXPECT_EQ(executive->clock().now(), 0);
}

}  // namespace
}  // namespace palpa::runtime

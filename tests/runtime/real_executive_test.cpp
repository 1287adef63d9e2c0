#include <gtest/gtest.h>

#include <atomic>
#include <stdexcept>
#include <thread>
#include <vector>

#include "activities.h"

/// Nothing here asserts how long anything takes. Plain (not atomic) counters are read after run():
/// the ThreadSanitizer build proves that run() has joined every thread.
namespace palpa::runtime {
namespace {

Doing counter(int& steps, int last, std::int64_t period = kMillisecond / 10) {
  return {"counter", [&steps, last, period](std::int64_t now) {
            return ++steps == last ? kNever : now + period;
          }};
}

Doing endless(int& steps) {
  return {"endless", [&steps](std::int64_t now) {
            ++steps;
            return now + kMillisecond / 10;
          }};
}

TEST(RealExecutive, RunsEveryActivityToItsEndAndCountsTheSteps) {
  int a_steps = 0, b_steps = 0;
  Doing a = counter(a_steps, 50), b = counter(b_steps, 7);
  const auto executive = makeRealExecutive();
  executive->add(a, {0, false, false});
  executive->add(b, {1, false, true});
  executive->run();
  EXPECT_EQ(a_steps, 50);
  EXPECT_EQ(b_steps, 7);
  const std::vector<Lateness> late = executive->lateness();
  ASSERT_EQ(late.size(), 2u);
  EXPECT_EQ(late[0].steps, 50u);
  EXPECT_EQ(late[1].steps, 7u);
  EXPECT_EQ(late[0].name, "counter");
  EXPECT_LE(late[0].median_us, late[0].p99_us);
  EXPECT_LE(late[0].p99_us, late[0].p999_us);
  EXPECT_LE(late[0].p999_us, late[0].max_us);
  EXPECT_LE(late[0].cost.median_us, late[0].cost.max_us);
  EXPECT_EQ(late[0].late.count(), 50u);
  EXPECT_EQ(late[0].missed_ticks, 0u) << "without a period none can be missed";
  EXPECT_EQ(executive->mode(), TimeMode::real);
}

bool saysGrantedOrWhyNot(const std::string& words, const std::string& granted,
                         const std::string& refused) {
  const std::size_t at = words.find(refused);
  return at == std::string::npos ? words.find(granted) != std::string::npos
                                 : words.find('(', at) != std::string::npos;
}

TEST(RealExecutive, RealTimePolicyIsGrantedOrTheReasonIsTold) {
  int steps = 0, plain_steps = 0;
  Doing a = counter(steps, 3), plain = counter(plain_steps, 3);
  const auto executive = makeRealExecutive();
  executive->add(a, {0, true, false});
  executive->add(plain, {1, false, false});
  executive->run();
  const std::string words = executive->lateness().at(0).scheduling;
  EXPECT_TRUE(saysGrantedOrWhyNot(words, "SCHED_FIFO", "SCHED_FIFO refused")) << words;
  EXPECT_TRUE(saysGrantedOrWhyNot(words, "; memory", "not locked: refused")) << words;
  EXPECT_EQ(words.find("CPU"), std::string::npos) << "none was asked for";
  EXPECT_EQ(executive->lateness().at(1).scheduling, "normal priority");
}

TEST(RealExecutive, CpuThatIsNotThereIsRefusedAndTheStepsRunAllTheSame) {
  int steps = 0;
  Doing a = counter(steps, 3);
  const auto executive = makeRealExecutive();
  executive->add(a, {0, true, false, 1 << 20});
  executive->run();
  EXPECT_EQ(steps, 3);
  const std::string words = executive->lateness().at(0).scheduling;
  EXPECT_NE(words.find("CPU 1048576 refused (this computer has none)"), std::string::npos) << words;
}

/// Falls a whole number of periods behind once, by waiting on the session's own clock.
class Stumbling final : public Activity {
 public:
  explicit Stumbling(const Clock& clock) : clock_(clock) {}
  const char* name() const override { return "stumbling"; }
  std::int64_t period_ns() const override { return kMillisecond; }
  std::int64_t step(std::int64_t now) override {
    if (due_ < 0) due_ = now;
    if (++steps_ == 4)
      while (clock_.now() < due_ + 3 * kMillisecond) {
      }
    if (steps_ == 8) return kNever;
    return due_ += kMillisecond;
  }

 private:
  const Clock& clock_;
  std::int64_t due_ = -1;
  int steps_ = 0;
};

TEST(RealExecutive, StepsLaterThanAPeriodCountAsMissed) {
  const auto executive = makeRealExecutive();
  Stumbling a(executive->clock());
  executive->add(a, {});
  executive->run();
  const Lateness late = executive->lateness().at(0);
  EXPECT_EQ(late.steps, 8u);
  EXPECT_GE(late.missed_ticks, 1u) << "the fifth was due two periods before the fourth ended";
  EXPECT_LE(late.missed_ticks, 8u);
  EXPECT_GE(late.max_us, 1000) << "it waited until then";
}

TEST(RealExecutive, OnlyWhoAsksRunsOnTheCallersThread) {
  std::thread::id window, worker;
  Doing a("window", [&](std::int64_t) {
    window = std::this_thread::get_id();
    return kNever;
  });
  Doing b("worker", [&](std::int64_t) {
    worker = std::this_thread::get_id();
    return kNever;
  });
  const auto executive = makeRealExecutive();
  executive->add(a, {0, false, true});
  executive->add(b, {0, false, false});
  executive->run();
  EXPECT_EQ(window, std::this_thread::get_id());
  EXPECT_NE(worker, std::this_thread::get_id());
  EXPECT_NE(worker, std::thread::id());
}

class FaultOn : public testing::TestWithParam<bool> {};

TEST_P(FaultOn, ExceptionStopsAllAndIsRethrown) {
  int steps = 0, others = 0, third = 0;
  Doing faulty("faulty", [&](std::int64_t now) -> std::int64_t {
    if (++steps == 5) throw std::runtime_error("cable pulled");
    return now + kMillisecond / 10;
  });
  Doing a = endless(others), b = endless(third);
  const auto executive = makeRealExecutive();
  executive->add(a, {0, false, false});
  executive->add(faulty, {1, false, GetParam()});
  executive->add(b, {2, false, false});
  try {
    executive->run();
    ADD_FAILURE() << "run() returned";
  } catch (const std::runtime_error& e) {
    EXPECT_STREQ(e.what(), "cable pulled");
  }
  EXPECT_EQ(steps, 5);
  const int before = others + third;
  std::this_thread::yield();
  EXPECT_EQ(others + third, before);
}

INSTANTIATE_TEST_SUITE_P(Threads, FaultOn, testing::Bool(),
                         [](const auto& mode) { return mode.param ? "caller" : "worker"; });

TEST(RealExecutive, StopFromAnActivityJoinsAll) {
  const auto executive = makeRealExecutive();
  int others = 0, steps = 0;
  Doing a = endless(others);
  Doing stopper("stopper", [&](std::int64_t now) {
    if (++steps == 20) executive->stop();
    return now + kMillisecond / 10;
  });
  executive->add(a, {0, false, false});
  executive->add(stopper, {1, false, false});
  executive->run();
  EXPECT_EQ(steps, 20) << "no step after the stop on the thread that asked";
}

TEST(RealExecutive, StopFromOutsideJoinsAll) {
  const auto executive = makeRealExecutive();
  std::atomic<int> steps{0};
  Doing a("endless", [&](std::int64_t now) {
    steps.fetch_add(1);
    steps.notify_all();
    return now + kMillisecond / 10;
  });
  executive->add(a, {});
  std::thread outside([&] {
    steps.wait(0);  // until the first step: a stop before run() would be no stop of this run
    executive->stop();
  });
  executive->run();
  outside.join();
  EXPECT_GE(steps.load(), 1);
}

TEST(RealExecutive, NoStepBeforeItsTimeAndTimeNeverGoesBack) {
  std::int64_t due = 0, last = -1;
  int early = 0, back = 0, steps = 0;
  Doing a("watch", [&](std::int64_t now) {
    early += now < due;
    back += now < last;
    last = now;
    due = now + kMillisecond;
    return ++steps == 50 ? kNever : due;
  });
  const auto executive = makeRealExecutive();
  executive->add(a, {});
  executive->run();
  EXPECT_EQ(early, 0);
  EXPECT_EQ(back, 0);
}

}  // namespace
}  // namespace palpa::runtime

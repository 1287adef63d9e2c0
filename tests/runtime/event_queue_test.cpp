#include "apps/runtime/channels.h"

#include <gtest/gtest.h>

#include <string>
#include <thread>

namespace palpa::runtime {
namespace {

TEST(EventQueue, KeepsOrderOverManyTurnsOfTheRing) {
  EventQueue<int> queue(3);
  int out = 0, next_in = 0, next_out = 0;
  for (int turn = 0; turn < 100; ++turn) {
    for (int i = 0; i < 1 + turn % 3; ++i) EXPECT_TRUE(queue.push(next_in++));
    while (queue.pop(&out)) EXPECT_EQ(out, next_out++);
  }
  EXPECT_EQ(next_out, next_in);
  EXPECT_EQ(queue.overflows(), 0u);
}

TEST(EventQueue, HoldsItsCapacityAndCountsWhatDidNotFit) {
  EventQueue<int> queue(4);
  for (int i = 0; i < 4; ++i) EXPECT_TRUE(queue.push(i));
  for (int i = 4; i < 7; ++i) EXPECT_FALSE(queue.push(i));
  EXPECT_EQ(queue.overflows(), 3u);
  int out = -1;
  for (int i = 0; i < 4; ++i) {
    ASSERT_TRUE(queue.pop(&out));
    EXPECT_EQ(out, i) << "the old ones are never overwritten";
  }
  EXPECT_FALSE(queue.pop(&out));
  EXPECT_TRUE(queue.push(9)) << "room again";
}

TEST(EventQueue, EmptyLeavesTheTargetAlone) {
  EventQueue<std::string> queue(2);
  std::string out = "before";
  EXPECT_FALSE(queue.pop(&out));
  EXPECT_EQ(out, "before");
}

TEST(EventQueue, BetweenTwoThreadsNoneIsLostAndOrderIsKept) {
  constexpr int kEvents = 100'000;
  EventQueue<std::pair<int, std::string>> queue(64);
  std::uint64_t refused = 0;
  std::thread writer([&] {
    for (int i = 0; i < kEvents; ++i)
      while (!queue.push({i, "event " + std::to_string(i)})) {
        ++refused;
        std::this_thread::yield();
      }
  });
  std::pair<int, std::string> out;
  int wrong = 0;
  for (int next = 0; next < kEvents;) {
    if (!queue.pop(&out)) {
      std::this_thread::yield();
      continue;
    }
    wrong += out.first != next || out.second != "event " + std::to_string(next);
    ++next;
  }
  writer.join();
  EXPECT_EQ(wrong, 0);
  EXPECT_EQ(queue.overflows(), refused) << "every refusal is counted";
  EXPECT_FALSE(queue.pop(&out));
}

}  // namespace
}  // namespace palpa::runtime

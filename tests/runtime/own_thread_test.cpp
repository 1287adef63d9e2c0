#include <gtest/gtest.h>

#include <set>
#include <stdexcept>
#include <thread>

#include "apps/runtime/own_thread.h"

namespace palpa::runtime {
namespace {

TEST(OwnThread, DoesEveryPieceInTheSameThreadBesideTheCaller) {
  OwnThread<std::thread::id> beside;
  std::set<std::thread::id> all;
  for (int i = 0; i < 100; ++i)
    all.insert(beside.start([] { return std::this_thread::get_id(); }).get());
  EXPECT_EQ(all.size(), 1u);
  EXPECT_EQ(all.count(std::this_thread::get_id()), 0u);
}

TEST(OwnThread, WhatIsThrownComesOutOfTheFuture_AndTheThreadGoesOn) {
  OwnThread<int> beside;
  EXPECT_THROW(beside.start([]() -> int { throw std::runtime_error("no picture"); }).get(),
               std::runtime_error);
  EXPECT_EQ(beside.start([] { return 7; }).get(), 7);
}

TEST(OwnThread, EndsOnlyWithItsLastPieceDone) {
  bool done = false;
  {
    OwnThread<int> beside;
    beside.start([&done] {
      done = true;
      return 0;
    });
  }
  EXPECT_TRUE(done);
  const OwnThread<int> never_used;
}

}  // namespace
}  // namespace palpa::runtime

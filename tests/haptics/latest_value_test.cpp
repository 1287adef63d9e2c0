#include "haptics/latest_value.h"

#include <gtest/gtest.h>

#include <thread>

namespace palpa::haptics {
namespace {

struct Block {
  std::array<std::uint64_t, 64> words{};
};

TEST(Latest, NothingPublishedIsTheDefaultAndTheLastStays) {
  LatestValue<int> latest;
  EXPECT_EQ(latest.read(), 0);
  latest.write(1);
  latest.write(2);
  EXPECT_EQ(latest.read(), 2);
  EXPECT_EQ(latest.read(), 2);
}

TEST(Latest, TheReaderNeverSeesATornOrAnOlderValue) {
  constexpr std::uint64_t kLast = 200'000;
  LatestValue<Block> latest;
  std::thread writer([&] {
    Block block;
    for (std::uint64_t v = 1; v <= kLast; ++v) {
      block.words.fill(v);
      latest.write(block);
    }
  });
  std::uint64_t last = 0, wrong = 0;
  while (last < kLast) {
    const Block& block = latest.read();
    for (const std::uint64_t word : block.words) wrong += word != block.words[0];
    wrong += block.words[0] < last;
    last = block.words[0];
  }
  writer.join();
  EXPECT_EQ(wrong, 0u);
}

}  // namespace
}  // namespace palpa::haptics

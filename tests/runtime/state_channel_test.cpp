#include "apps/runtime/channels.h"

#include <gtest/gtest.h>

#include <array>
#include <memory>
#include <thread>

namespace palpa::runtime {
namespace {

/// Large enough that a copy takes many instructions: a torn value would show.
struct Wide {
  std::array<std::uint64_t, 64> words{};
  static Wide of(std::uint64_t version) {
    Wide w;
    for (std::size_t i = 0; i < w.words.size(); ++i) w.words[i] = version * (i + 1);
    return w;
  }
  std::uint64_t version() const { return words[0]; }
  bool whole() const {
    for (std::size_t i = 0; i < words.size(); ++i)
      if (words[i] != words[0] * (i + 1)) return false;
    return true;
  }
};

TEST(StateChannel, ReaderNeverSeesATornValueAndVersionsNeverGoBack) {
  constexpr std::uint64_t kLast = 200'000;
  StateChannel<Wide> channel(TimeMode::real);
  std::thread writer([&] {
    for (std::uint64_t v = 1; v <= kLast; ++v) channel.publish(Wide::of(v), 0);
  });
  std::uint64_t last = 0, torn = 0, back = 0, seen = 0;
  while (last < kLast) {
    const Wide* value = channel.read(0);
    if (!value) continue;
    torn += !value->whole();
    back += value->version() < last;
    seen += value->version() > last;
    last = value->version();
  }
  writer.join();
  EXPECT_EQ(torn, 0u);
  EXPECT_EQ(back, 0u);
  EXPECT_GE(seen, 1u);
  EXPECT_EQ(channel.read(0)->version(), kLast) << "the last value stays";
}

TEST(StateChannel, SharedPicturesAreNeitherLostNorFreedTwice) {
  StateChannel<std::shared_ptr<int>> channel(TimeMode::real);
  const auto last = std::make_shared<int>(10'000);
  std::thread writer([&] {
    for (int v = 1; v < 10'000; ++v) channel.publish(std::make_shared<int>(v), 0);
    channel.publish(last, 0);
  });
  int seen = 0;
  while (seen < 10'000)
    if (const auto* value = channel.read(0)) {
      const std::shared_ptr<int> mine = *value;
      ASSERT_GE(*mine, seen);
      seen = *mine;
    }
  writer.join();
  EXPECT_EQ(last.use_count(), 2) << "one here, one in the channel";
}

class BothModes : public testing::TestWithParam<TimeMode> {};

TEST_P(BothModes, NothingBeforeTheFirstThenLatestWins) {
  StateChannel<int> channel(GetParam());
  EXPECT_EQ(channel.read(100), nullptr);
  channel.publish(1, 0);
  channel.publish(2, 0);
  channel.publish(3, 0);
  ASSERT_NE(channel.read(0), nullptr);
  EXPECT_EQ(*channel.read(0), 3);
  EXPECT_EQ(*channel.read(1), 3) << "it stays until a newer one comes";
  channel.publish(4, 0);
  EXPECT_EQ(*channel.read(1), 4);
}

INSTANTIATE_TEST_SUITE_P(Modes, BothModes, testing::Values(TimeMode::real, TimeMode::virtual_time),
                         [](const auto& mode) {
                           return mode.param == TimeMode::real ? "real" : "virtual_time";
                         });

TEST(StateChannel, InVirtualTimeNothingIsVisibleBeforeItsTime) {
  StateChannel<int> channel(TimeMode::virtual_time);
  channel.publish(1, 100);
  EXPECT_EQ(channel.read(0), nullptr);
  EXPECT_EQ(channel.read(99), nullptr);
  ASSERT_NE(channel.read(100), nullptr);
  channel.publish(2, 200);
  channel.publish(3, 300);
  EXPECT_EQ(*channel.read(199), 1);
  EXPECT_EQ(*channel.read(200), 2);
  EXPECT_EQ(*channel.read(299), 2);
  EXPECT_EQ(*channel.read(1000), 3);
}

TEST(StateChannel, InVirtualTimeAReaderWhoComesLateGetsTheLatest) {
  StateChannel<int> channel(TimeMode::virtual_time);
  for (int i = 1; i <= 50; ++i) channel.publish(i, 10 * i);
  EXPECT_EQ(*channel.read(305), 30);
  EXPECT_EQ(*channel.read(500), 50);
}

}  // namespace
}  // namespace palpa::runtime

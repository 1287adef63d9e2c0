// Pages that go and come back.
#include <gtest/gtest.h>

#include <thread>

#include "attacked.h"

namespace palpa::console_attack {
namespace {

class ComingBack : public Attacked {};

TEST_F(ComingBack, TwoPagesGetTheSameAndWhoComesBackGetsTheRestOnce) {
  const std::string id = session();
  std::vector<Event> one, other;
  std::thread first([&] { one = console().events(id, "", until(60)); });
  other = console().events(id, "", until(60));
  first.join();
  ASSERT_GE(one.size(), 60u);
  ASSERT_GE(other.size(), 60u);
  expectNumbered(one, 1);
  for (std::size_t i = 0; i < 60; ++i) EXPECT_EQ(one[i], other[i]) << i;
  std::vector<Event> pieces;  // dropped after every few, back with the last number that came
  while (pieces.size() < 60) {
    const auto more =
        console().events(id, pieces.empty() ? "" : std::to_string(pieces.back().id), until(7));
    ASSERT_FALSE(more.empty());
    pieces.insert(pieces.end(), more.begin(), more.end());
  }
  expectNumbered(pieces, 1);
  for (std::size_t i = 0; i < 60; ++i) EXPECT_EQ(pieces[i], one[i]) << i;
}

TEST_F(ComingBack, NumbersThatNeverWere) {
  const std::string id = session();
  for (const char* last : {"999999", "500000"}) {
    const auto all = console().events(id, last, until(3));
    ASSERT_FALSE(all.empty()) << last;
    EXPECT_EQ(all[0].id, 1u) << last << ": beyond the log, told from its beginning";
  }
  for (const char* last : {"-1", "x", "1e3", "99999999999999999999999", "0", "1 2"}) {
    const auto all = console().events(id, last, until(3));
    ASSERT_FALSE(all.empty()) << last;
    EXPECT_EQ(all[0].id, 1u) << last << ": no number, told from its beginning";
  }
}

}  // namespace
}  // namespace palpa::console_attack

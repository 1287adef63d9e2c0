#include "apps/console/web/guard.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>
#include <thread>
#include <vector>

#include "tests/support/damage.h"
#include "tests/support/scratch_folder.h"

namespace palpa::console {
namespace {

std::vector<std::string> linesOf(const std::filesystem::path& file) {
  std::vector<std::string> lines;
  std::ifstream stream(file, std::ios::binary);
  for (std::string line; std::getline(stream, line);) lines.push_back(line);
  return lines;
}

TEST(Refusals, OneLineWhateverWasSent) {
  const test::ScratchFolder folder("refusals");
  Refusals refusals(folder / "refused.log");
  test::DamageDice dice(7);
  const auto bytes = [&] {
    std::string text(dice.below(400), '\0');
    for (char& c : text) c = static_cast<char>(dice.below(256));
    return text;
  };
  for (int i = 0; i < 500; ++i) refusals.note(bytes(), bytes(), bytes(), 400 + i % 100, bytes());
  const auto lines = linesOf(folder / "refused.log");
  ASSERT_EQ(lines.size(), 500u);
  for (const std::string& line : lines) {
    EXPECT_LT(line.size(), 540u);
    EXPECT_TRUE(std::all_of(line.begin(), line.end(), [](unsigned char c) {
      return c >= 0x20 && c < 0x7f;
    })) << line;
  }
}

/// Whoever sends spaces and line ends cannot write an entry that looks like another's.
TEST(Refusals, WhatWasSentStaysOneWord) {
  const test::ScratchFolder folder("forged");
  Refusals refusals(folder / "refused.log");
  refusals.note("127.0.0.1", "GET", "/x 200 fine\n2026-01-01T00:00:00Z 10.0.0.1 GET / 403 forged",
                404, "no such path");
  refusals.note("", "", "", 400, "was not understood");
  const auto lines = linesOf(folder / "refused.log");
  ASSERT_EQ(lines.size(), 2u);
  EXPECT_EQ(
      lines[0].substr(20),
      " 127.0.0.1 GET /x?200?fine?2026-01-01T00:00:00Z?10.0.0.1?GET?/?403?forged 404 no such path");
  EXPECT_EQ(lines[1].substr(20), " - - - 400 was not understood");
}

/// Where somebody has put a link to another file, that one stays as it is.
TEST(Refusals, NoLinkIsFollowed) {
  const test::ScratchFolder folder("link");
  std::ofstream(folder / "victim") << "as it was\n";
  std::filesystem::create_symlink("victim", folder / "refused.log");
  Refusals refusals(folder / "refused.log");
  refusals.note("127.0.0.1", "GET", "/x", 404, "no such path");
  EXPECT_EQ(linesOf(folder / "victim"), std::vector<std::string>{"as it was"});
}

TEST(Refusals, NoQuery) {
  const test::ScratchFolder folder("query");
  Refusals refusals(folder / "refused.log");
  refusals.note("127.0.0.1", "GET", "/api/enter?token=correct-horse-battery-staple", 401,
                "give the console's token first");
  EXPECT_EQ(linesOf(folder / "refused.log")[0].find("horse"), std::string::npos);
}

TEST(Refusals, TheFileDoesNotGrowBeyondTwoMegabytes) {
  const test::ScratchFolder folder("long");
  Refusals refusals(folder / "refused.log");
  for (int i = 0; i < 20'000; ++i)
    refusals.note("127.0.0.1", "GET", "/" + std::string(200, 'x'), 404, "no such path");
  EXPECT_LT(std::filesystem::file_size(folder / "refused.log") +
                std::filesystem::file_size(folder / "refused.log.1"),
            5u << 19);
  EXPECT_EQ(std::distance(std::filesystem::directory_iterator(folder.path()), {}), 2);
}

TEST(Refusals, FromManyThreadsEachLineIsWhole) {
  const test::ScratchFolder folder("threads");
  Refusals refusals(folder / "refused.log");
  std::vector<std::thread> threads;
  for (int t = 0; t < 8; ++t)
    threads.emplace_back([&] {
      for (int i = 0; i < 100; ++i) refusals.note("127.0.0.1", "GET", "/x", 404, "no such path");
    });
  for (std::thread& thread : threads) thread.join();
  const auto lines = linesOf(folder / "refused.log");
  EXPECT_EQ(lines.size(), 800u);
  for (const std::string& line : lines)
    EXPECT_EQ(line.substr(20), " 127.0.0.1 GET /x 404 no such path");
}

/// A folder that is gone or full: who was refused stays refused, nothing else happens.
TEST(Refusals, WhereNothingCanBeWrittenNothingBreaks) {
  Refusals("/proc/there/is/none").note("127.0.0.1", "GET", "/", 403, "words");
}

}  // namespace
}  // namespace palpa::console

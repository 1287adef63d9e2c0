#include "anatomy/base/whole_file.h"

#include <gtest/gtest.h>

#include "anatomy/base/error.h"
#include "tests/support/files.h"

namespace palpa {
namespace {

TEST(WholeFile, IsThereWholeOrNotAtAll) {
  const auto folder = test::freshFolder("base", "whole");
  writeWhole(folder / "a.txt", "first");
  {
    WholeFile left(folder / "a.txt");
    left.write("second, but");
  }
  EXPECT_EQ(test::slurp(folder / "a.txt"), "first");
  writeWhole(folder / "a.txt", "second");
  EXPECT_EQ(test::slurp(folder / "a.txt"), "second");
  EXPECT_EQ(std::distance(std::filesystem::directory_iterator(folder), {}), 1) << "nothing beside";
  EXPECT_THROW(writeWhole(folder / "no/such/a.txt", ""), Error);
}

/// A page that is given the name of a session or of a centre's records.
TEST(WholeFile, NeverTakesThePlaceOfADatabase) {
  const auto folder = test::freshFolder("base", "database");
  std::string evidence("SQLite format 3\0", 16);
  evidence.append("and all that a trainee did");
  std::ofstream(folder / "session.palpa", std::ios::binary) << evidence;
  EXPECT_THROW(writeWhole(folder / "session.palpa", "<!doctype html>"), Error);
  EXPECT_EQ(test::slurp(folder / "session.palpa"), evidence);
  std::ofstream(folder / "short.txt") << "SQLite";
  EXPECT_NO_THROW(writeWhole(folder / "short.txt", "text"));
}

TEST(ReadWhole, GivesEveryByteAndNothingWhereThereIsNoFile) {
  const auto folder = test::freshFolder("base", "read");
  std::string bytes;
  for (int i = 0; i < 200'000; ++i) bytes += static_cast<char>(i % 251);
  writeWhole(folder / "a.bin", bytes);
  writeWhole(folder / "empty", "");
  EXPECT_EQ(readWhole(folder / "a.bin"), bytes);
  EXPECT_EQ(readWhole(folder / "empty"), "");
  EXPECT_EQ(readWhole(folder / "missing"), std::nullopt);
  EXPECT_EQ(readWhole(folder), std::nullopt);
}

}  // namespace
}  // namespace palpa

#include "forbidden.h"

#include <gtest/gtest.h>

namespace palpa::house {
namespace {

bool caught(const std::string& path, const std::string& text) {
  return !forbiddenWords({path, text}).empty();
}

TEST(Forbidden, TheTreeHoldsNoneOfIt) {
  std::size_t files = 0;
  for (const SourceFile& file : sourceTree(PALPA_SOURCE_DIR)) {
    ++files;
    for (const std::string& line : forbiddenWords(file)) ADD_FAILURE() << line;
  }
  EXPECT_GT(files, 250u) << "the walk has lost the tree";
}

TEST(Forbidden, EveryWordIsCaughtWhenPlanted) {
  for (const Forbidden& f : forbidden())
    EXPECT_TRUE(caught("scene/a.cpp", "int x; " + f.word + " y;\n")) << f.word;
}

TEST(Forbidden, CommentsAreFreeForCodeWordsOnly) {
  EXPECT_FALSE(caught("scene/a.cpp",
                      "// no std::random_"
                      "device here\nint x;"));
  EXPECT_TRUE(caught("scene/a.cpp",
                     "// see /wo"
                     "rk/x\nint x;"));
  EXPECT_TRUE(caught("README.md",
                     "see /wo"
                     "rk/x"));
}

TEST(Forbidden, PartsOfLongerNamesAreFree) {
  EXPECT_FALSE(caught("scene/a.cpp",
                      "double operan"
                      "d(int);"));
  EXPECT_TRUE(caught("scene/a.cpp",
                     "double x = ran"
                     "d();"));
  EXPECT_FALSE(caught("README.md",
                      "frame"
                      "wo"
                      "rk/x"));
}

TEST(Forbidden, ClocksAreAtHomeInTheClock) {
  EXPECT_FALSE(caught("apps/os/system_time.cpp",
                      "clock_"
                      "gettime(CLOCK_MONOTONIC, &t);"));
  EXPECT_TRUE(caught("apps/runtime/bus.h",
                     "clock_"
                     "gettime(CLOCK_MONOTONIC, &t);"));
}

TEST(WithoutComments, KeepsTextInQuotes) {
  EXPECT_EQ(withoutComments("a \"b // c\" // d\ne"), "a \"b // c\" \ne");
  EXPECT_EQ(withoutComments("a/* b\n */c"), "ac");
  EXPECT_EQ(withoutComments("\"a\\\"// b\" // c"), "\"a\\\"// b\" ");
}

}  // namespace
}  // namespace palpa::house

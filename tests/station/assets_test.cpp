#include "apps/station/assets.h"

#include <gtest/gtest.h>

#include <cstdlib>

#include "anatomy/base/error.h"
#include "tests/support/files.h"

/// The program's data are found wherever the program was put.
namespace palpa::station {
namespace {

namespace fs = std::filesystem;

TEST(Assets, LieBesideTheProgramOrWhereTheVariableSays) {
  const fs::path top = test::freshFolder("station", "assets"),
                 beside = top / "usr/share/palpa/assets", elsewhere = top / "mine",
                 program = top / "usr/bin/palpa";
  ::unsetenv("PALPA_ASSETS");
  EXPECT_EQ(assetsFolder(program), PALPA_SOURCE_DIR "/assets")
      << "a program that was not installed uses the tree that it was built from";
  fs::create_directories(beside / "materials");
  EXPECT_EQ(assetsFolder(program), beside);
  fs::create_directories(elsewhere / "materials");
  ::setenv("PALPA_ASSETS", elsewhere.c_str(), 1);
  EXPECT_EQ(assetsFolder(program), elsewhere);
  ::setenv("PALPA_ASSETS", top.c_str(), 1);
  EXPECT_THROW(assetsFolder(program), Error) << "another folder in its place would be a surprise";
  ::unsetenv("PALPA_ASSETS");
  EXPECT_EQ(programFile().filename(), "test_station");
}

}  // namespace
}  // namespace palpa::station

#include <gtest/gtest.h>

#include <cstdlib>

#include "tests/headset/worn.h"

/// The program on a desktop: a person, a window, a headset beside it.
namespace palpa::headset {
namespace {

/// Runs until it is interrupted, as by Ctrl-C; its exit code, and what it said on standard error.
struct Ended {
  int code = -1;
  bool begun = false;
  std::string said;
};
/// Once the headset has shown so many layers after the file `begun` was there, however long that
/// takes: two minutes at most.
Ended interruptedAfter(int layers, const std::string& begun, const std::string& arguments,
                       const test::TestXr& xr) {
  const std::string folder = xr.folder().string();
  const std::string command =
      std::string(PALPA_PROGRAM) + " subclavian --display openxr --operator person --quiet --out " +
      folder + "/out " + arguments + " >/dev/null 2>" + folder + "/said.txt & program=$!; " +
      "for i in $(seq 1200); do [ -s " + folder + "/out/" + begun + " ] && [ $(cat " + folder +
      "/layers 2>/dev/null | wc -c) -ge " + std::to_string(layers) +
      " ] && break; sleep 0.1; done; kill -TERM $program; wait $program";
  Ended run;
  run.code = std::system(command.c_str());
  run.begun = std::filesystem::exists(xr.folder() / "out" / begun);
  std::ifstream file(folder + "/said.txt");
  for (std::string line; std::getline(file, line);) run.said += line + "\n";
  return run;
}

TEST(HeadsetDesktop, APersonHasAWindowAndAHeadset) {
  if (!std::getenv("DISPLAY")) GTEST_SKIP() << "no DISPLAY: run under xvfb-run";
  const test::TestXr xr(PALPA_TEST_XR_JSON, "eyes=64x64,64x64");
  const Ended run =
      interruptedAfter(6, "session.palpa", "--no-demonstration --no-familiarisation", xr);
  EXPECT_TRUE(run.begun);
  EXPECT_EQ(run.code, 0) << run.said;
  EXPECT_EQ(run.said, "");
  const test::XrReport report = xr.report();
  expectClean(report, "desktop");
  EXPECT_GT(calls(report, "layers"), 5);
}

/// The demonstration is made without display, and must not decide the kind of context for the
/// window after it.
TEST(HeadsetDesktop, TheDemonstrationComesBefore) {
  if (!std::getenv("DISPLAY")) GTEST_SKIP() << "no DISPLAY: run under xvfb-run";
  const test::TestXr xr(PALPA_TEST_XR_JSON, "eyes=64x64,64x64");
  const Ended run = interruptedAfter(6, "demonstration/session.palpa", "", xr);
  EXPECT_TRUE(run.begun) << run.said;
  EXPECT_GT(calls(xr.report(), "layers"), 5) << run.said;
  EXPECT_EQ(run.said.find("headset"), std::string::npos) << run.said;
  EXPECT_EQ(run.said.find("EGL"), std::string::npos) << run.said;
}

}  // namespace
}  // namespace palpa::headset

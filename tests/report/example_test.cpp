#include <gtest/gtest.h>

#include "synthetic_report.h"

namespace palpa::report {
namespace {

/// Leaves two pages in the build folder to look at, in tests/report/tmp/Example.PagesToLookAt.
TEST(Example, PagesToLookAt) {
  const auto folder = test::freshFolder("example");
  writeReport(test::syntheticReport(1), folder / "one.html");
  writeReport(test::syntheticReport(10), folder / "ten.html");
  // Decimated, a trial of 30 s takes about 120 kB: ten of them can still be mailed.
  EXPECT_LT(std::filesystem::file_size(folder / "ten.html"), 1'500'000u);
}

}  // namespace
}  // namespace palpa::report

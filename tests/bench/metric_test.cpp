#include "apps/bench/timing.h"

#include <gtest/gtest.h>

#include <limits>

namespace palpa::bench {
namespace {

nlohmann::json printed(double value) {
  testing::internal::CaptureStdout();
  print("lateness_p99", value, "us", {{"noise", "none"}});
  const std::string line = testing::internal::GetCapturedStdout();
  EXPECT_EQ(line.find('\n'), line.size() - 1) << "one line";
  return nlohmann::json::parse(line);
}

TEST(Print, IsOneJsonObjectALine) {
  const nlohmann::json line = printed(12.5);
  EXPECT_EQ(line, nlohmann::json({{"metric", "lateness_p99"},
                                  {"value", 12.5},
                                  {"unit", "us"},
                                  {"params", {{"noise", "none"}}}}));
  EXPECT_TRUE(printed(std::numeric_limits<double>::quiet_NaN()).at("value").is_null());
}

}  // namespace
}  // namespace palpa::bench

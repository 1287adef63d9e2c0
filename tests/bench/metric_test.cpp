#include "apps/bench/metric.h"

#include <gtest/gtest.h>

#include <limits>
#include <numeric>

namespace palpa::bench {
namespace {

TEST(Quantile, IsTheNearestRankWhateverTheOrder) {
  std::vector<double> values(100);
  std::iota(values.rbegin(), values.rend(), 1.0);
  EXPECT_EQ(quantile(values, 0.5), 50);
  EXPECT_EQ(quantile(values, 0.99), 99);
  EXPECT_EQ(quantile(values, 0.991), 100);
  EXPECT_EQ(quantile(values, 1), 100);
  EXPECT_EQ(quantile(values, 0), 1);
  EXPECT_EQ(quantile({7}, 0.01), 7);
  EXPECT_EQ(quantile({}, 0.5), 0);
}

nlohmann::json printed(double value) {
  testing::internal::CaptureStdout();
  print("lateness_p99", value, "us", {{"noise", "none"}});
  const std::string line = testing::internal::GetCapturedStdout();
  EXPECT_EQ(line.find('\n'), line.size() - 1) << "one line";
  return nlohmann::json::parse(line);
}

TEST(Print, IsOneJsonObjectALine) {
  const nlohmann::json line = printed(12.5);
  EXPECT_EQ(line, nlohmann::json({{"metric", "lateness_p99"}, {"value", 12.5}, {"unit", "us"},
                                  {"params", {{"noise", "none"}}}}));
  EXPECT_TRUE(printed(std::numeric_limits<double>::quiet_NaN()).at("value").is_null());
}

}  // namespace
}  // namespace palpa::bench

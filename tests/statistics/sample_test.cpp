#include "apps/assess/statistics/sample.h"

#include <gtest/gtest.h>

#include <cmath>

#include "anatomy/base/error.h"
#include "anatomy/base/random.h"
#include "apps/assess/statistics/assumptions.h"
#include "apps/assess/statistics/bootstrap.h"

namespace palpa::statistics {
namespace {

BootstrapInterval meanInterval(const std::vector<double>& values,
                               const BootstrapSettings& settings = {}) {
  return bootstrapMeans({values}, settings).at(0);
}

TEST(Sample, Describes) {
  const Description d = describe({4, 1, 3, 2, 10});
  EXPECT_EQ(d.n, 5u);
  EXPECT_EQ(d.mean, 4);
  EXPECT_NEAR(d.sd, std::sqrt(50.0 / 4), 1e-12);
  EXPECT_EQ(d.median, 3);
  EXPECT_EQ(d.q1, 2);
  EXPECT_EQ(d.q3, 4);
  EXPECT_EQ(d.min, 1);
  EXPECT_EQ(d.max, 10);
  EXPECT_EQ(interpolatedQuantile({1, 2}, 0.25), 1.25);
  EXPECT_EQ(describe({}).n, 0u);
  EXPECT_TRUE(std::isnan(describe({}).mean));
  EXPECT_TRUE(std::isnan(describe({7}).sd));
  EXPECT_THROW(describe({1, INFINITY}), Error);
  EXPECT_THROW(momentsOf({1}), Error);
}

TEST(Sample, RanksShareTies) {
  const Ranks ranks = ranksOf({3, 1, 3, 2});
  EXPECT_EQ(ranks.of, (std::vector<double>{3.5, 1, 3.5, 2}));
  EXPECT_EQ(ranks.ties, 6);
}

// Shapiro and Wilk 1965: weights of eleven men, W = .79; p after Royston as in R 4: 0.006704.
TEST(Assumptions, ShapiroAndWilksMen) {
  const NormalityTest men = shapiroWilk({148, 154, 158, 160, 161, 162, 166, 170, 182, 195, 236});
  EXPECT_NEAR(men.w, 0.78881, 5e-6);
  EXPECT_NEAR(men.p, 0.006704, 5e-7);
}

// Royston's own code, as scipy 1.10 has it (single precision).
TEST(Assumptions, ShapiroWilkForAllSizes) {
  const auto expect = [](const std::vector<double>& values, double w, double p) {
    EXPECT_NEAR(shapiroWilk(values).w, w, 2e-6);
    EXPECT_NEAR(shapiroWilk(values).p, p, 1e-5);
  };
  expect({1, 2, 4}, 0.9642857, 0.6368869);
  expect({1, 2, 4, 9}, 0.8946863, 0.4051475);
  expect({1, 2, 4, 9, 10}, 0.8809645, 0.3137046);
  expect({4.17, 5.58, 5.18, 6.11, 4.50, 4.61, 5.17, 4.53, 5.33, 5.14}, 0.9566815, 0.7474745);
  expect({0.7, -1.6, -0.2, -1.2, -0.1, 3.4, 3.7, 0.8, 0.0, 2.0,
          1.9, 0.8,  1.1,  0.1,  -0.1, 4.4, 5.5, 1.6, 4.6, 3.4},
         0.9460727, 0.3113743);
  EXPECT_THROW(shapiroWilk({1, 2}), Error);
  EXPECT_THROW(shapiroWilk({1, 1, 1}), Error);
}

TEST(Assumptions, NormalValuesFailAsOftenAsSaid) {
  RandomStream random = RandomStream::ofSeed(7);
  int failed = 0;
  constexpr int kDraws = 2000;
  for (int i = 0; i < kDraws; ++i) {
    std::vector<double> values(20);
    for (double& v : values) v = random.openNormal();
    failed += shapiroWilk(values).p < 0.05;
  }
  EXPECT_GT(failed, 75);  // 5 % of 2000 is 100, three standard deviations 29
  EXPECT_LT(failed, 130);
}

TEST(Assumptions, SpreadOfPlants) {  // scipy 1.10, levene with medians
  EXPECT_NEAR(spreadDiffers({{4.17, 5.58, 5.18, 6.11, 4.50, 4.61, 5.17, 4.53, 5.33, 5.14},
                             {4.81, 4.17, 4.41, 3.59, 5.87, 3.83, 6.03, 4.89, 4.32, 4.69},
                             {6.31, 5.12, 5.54, 5.50, 5.37, 5.29, 4.92, 6.15, 5.80, 5.26}}),
              0.3412266, 1e-7);
}

TEST(Assumptions, AreSaidInWords) {
  const std::vector<std::string> names{"Novices", "Experts"};
  EXPECT_TRUE(concernsAbout({{1, 2, 3, 4, 5.5, 6}, {2, 3, 4.5, 5, 6, 7}}, names).empty());
  const auto has = [&](const std::vector<std::vector<double>>& groups, const char* words) {
    for (const std::string& c : concernsAbout(groups, names))
      if (c.find(words) != std::string::npos) return true;
    return false;
  };
  EXPECT_TRUE(has({{1, 2, 3}, {2, 3, 4, 5, 6}}, "Novices: only 3 values"));
  EXPECT_TRUE(has({{1, 2, 3, 4, 5, 400}, {2, 3, 4, 5, 6}}, "not spread like a bell"));
  EXPECT_TRUE(has({{1, 2, 3, 4, 5, 6, 7, 8, 9}, {100, 300, 500, 700, 900, 1100, 1300}},
                  "spread differently"));
  EXPECT_TRUE(has({{1, 2, 3, 4, 5}, {2, 2, 2, 2, 2}}, "Experts: nothing varies"));
  EXPECT_FALSE(concernsAbout({{}, {1}}, names).empty());
  EXPECT_FALSE(concernsAbout({{1, 3, 1, 3}, {1, 3, 1, 3}}, names)
                   .empty());  // as far from the median, all of them
}

TEST(Bootstrap, SameSeedSameInterval) {
  const std::vector<double> values{3, 5, 8, 1, 9, 4, 4, 7};
  const BootstrapInterval a = meanInterval(values), b = meanInterval(values);
  EXPECT_EQ(a.low, b.low);
  EXPECT_EQ(a.high, b.high);
  EXPECT_NE(meanInterval(values, {.seed = 2}).low, a.low);
  EXPECT_LT(a.low, a.value);
  EXPECT_GT(a.high, a.value);
  EXPECT_EQ(meanInterval({4, 4, 4}).low, 4);
  EXPECT_THROW(meanInterval({}), Error);
  EXPECT_THROW(meanInterval({1}, {.draws = 10}), Error);
}

/// Samples of all sizes, more than are drawn at once, in any order: as each alone, computed the
/// long way.
TEST(Bootstrap, MeansTogetherAreThoseOfEachAlone) {
  RandomStream random = RandomStream::ofSeed(12);
  Samples samples;
  for (int i = 0; i < 90; ++i) {
    samples.emplace_back(i % 3 ? 5 : 1 + static_cast<std::size_t>(i) % 40);
    for (double& v : samples.back())
      v = i % 2 ? std::floor(3 * random.openUniform()) : 1000 + random.openNormal();
  }
  const std::vector<BootstrapInterval> together = bootstrapMeans(samples);
  ASSERT_EQ(together.size(), samples.size());
  for (std::size_t i = 0; i < samples.size(); ++i) {
    const BootstrapInterval alone =
        bootstrap({samples[i]}, [](const Samples& s) { return meanOf(s[0]); });
    EXPECT_EQ(together[i].value, alone.value);
    EXPECT_NEAR(together[i].low, alone.low, 1e-9 * (1 + std::abs(alone.low))) << i;
    EXPECT_NEAR(together[i].high, alone.high, 1e-9 * (1 + std::abs(alone.high))) << i;
  }
  EXPECT_TRUE(bootstrapMeans({}).empty());
}

/// Share of drawn samples of a skewed distribution (exponential, mean 1) whose interval of the mean
/// holds 1.
TEST(Bootstrap, HoldsTheMeanOfASkewedDistributionNearlyAsOftenAsSaid) {
  RandomStream random = RandomStream::ofSeed(11);
  int held = 0;
  constexpr int kSamples = 400;
  for (int i = 0; i < kSamples; ++i) {
    std::vector<double> values(30);
    for (double& v : values) v = -std::log(random.openUniform());
    const BootstrapInterval interval =
        meanInterval(values, {.draws = 500, .seed = static_cast<std::uint64_t>(i)});
    held += interval.low <= 1 && 1 <= interval.high;
  }
  EXPECT_GT(held / static_cast<double>(kSamples),
            0.895);  // 95 % wanted; BCa with 30 skewed values comes to about 93
  EXPECT_LT(held / static_cast<double>(kSamples), 0.985);
}

TEST(Bootstrap, SeveralSamples) {
  const BootstrapInterval d =
      bootstrap({{1, 2, 3, 4, 5}, {11, 12, 13, 14, 15}},
                [](const Samples& s) { return meanOf(s[1]) - meanOf(s[0]); });
  EXPECT_EQ(d.value, 10);
  EXPECT_GT(d.low, 7);
  EXPECT_LT(d.high, 13);
}

}  // namespace
}  // namespace palpa::statistics

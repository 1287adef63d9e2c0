#include "calibration/parts/interactive_procedures.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "anatomy/base/error.h"
#include "anatomy/base/random.h"
#include "calibration/parts/agreement.h"
#include "tests/support/scratch_folder.h"

/// Features against motions worked out by hand; matching and profiles against planted ones.
namespace palpa::calibration {
namespace {

/// Seconds of steps made one by one.
template <typename Make>
std::vector<ToolStep> steps(double seconds, Make make) {
  std::vector<ToolStep> all;
  for (int i = 0; i < static_cast<int>(std::lround(seconds / kInteractionStep_s)); ++i)
    all.push_back(make(i * kInteractionStep_s));
  return all;
}

double feature(const std::vector<ToolStep>& all, double at_s, InteractionFeature which) {
  return interactionFeatures(all)(std::lround(at_s / kInteractionStep_s), which);
}

TEST(InteractionFeatures, StraightStrokeAcrossTheTool) {
  // 30 mm/s along x, the tool along -z, 0.5 N up against its tip.
  const auto stroke = steps(2, [](double t) {
    return ToolStep{.p_DT = {0.03 * t, 0, 0},
                    .axis_D = -Vec3::UnitZ(),
                    .f_D = {0, 0, 0.5},
                    .shaking = 0.1,
                    .buzzing = 0.05,
                    .contact = 1};
  });
  EXPECT_NEAR(feature(stroke, 1, kMoveSpeed), std::log(0.03), 1e-9);
  EXPECT_NEAR(feature(stroke, 1, kWalkSpeed), std::log(0.03), 1e-9);
  EXPECT_NEAR(feature(stroke, 1, kStraightness), 1, 1e-9);
  EXPECT_NEAR(feature(stroke, 1, kAlongTool), 0, 1e-9);
  EXPECT_NEAR(feature(stroke, 1, kPushed), std::log(0.5), 1e-9);
  EXPECT_NEAR(feature(stroke, 1, kPushedOnTool), -0.5 / 0.52, 1e-9);
  EXPECT_NEAR(feature(stroke, 1, kTouching), 1, 1e-9);
  EXPECT_NEAR(feature(stroke, 1, kTrembling), std::log(0.1), 1e-9);
  EXPECT_NEAR(feature(stroke, 1, kBuzzing), std::log(0.05), 1e-9);
  EXPECT_EQ(feature(stroke, 1, kReversals), 0);
  EXPECT_NEAR(feature(stroke, 1, kWayAcross), std::log(0.03), 1e-9);  // since 0 s
}

TEST(InteractionFeatures, ToAndFroTurnsBackAndGoesNowhere) {
  // 3 mm at 2 Hz: four turns a second, at a mean speed of 4 x 3 mm x 2 Hz.
  const auto rub = steps(3, [](double t) {
    return ToolStep{.p_DT = {0.003 * std::sin(4 * std::numbers::pi * t), 0, 0}, .contact = 1};
  });
  EXPECT_NEAR(feature(rub, 1.5, kReversals), 4, 1);
  EXPECT_LT(feature(rub, 1.5, kStraightness), 0.2);  // 500 ms are a whole period
}

TEST(InteractionFeatures, WayInCountsFromWhereTheContactBegan) {
  // In the air for 1 s, then 10 mm/s along the tool; after 1 s in contact the way in is 10 mm. A
  // gap of 200 ms is the same contact, one of 400 ms another.
  for (const double gap_s : {0.2, 0.4}) {
    const auto push = steps(4, [&](double t) {
      const bool gap = t >= 1.5 && t < 1.5 + gap_s;
      return ToolStep{.p_DT = {0, 0, 0.01 * std::max(0.0, t - 1)},
                      .axis_D = Vec3::UnitZ(),
                      .contact = t >= 1 && !gap ? 1.0 : 0.0};
    });
    const double began_s = gap_s < 0.3 ? 1 : 1.5 + gap_s;
    EXPECT_NEAR(feature(push, 3, kWayIn), std::log(0.01 * (3 - began_s)), 0.02) << gap_s;
    EXPECT_NEAR(feature(push, 0.5, kWayIn), std::log(0.5e-3), 1e-9);  // the least
    EXPECT_GT(feature(push, 3, kAlongTool), 0.8);
  }
}

/// Two procedures told apart by one feature, whatever the others are.
ProcedureLibrary slowAndFast() {
  ProcedureLibrary library;
  library.source = library.made_by = "a test";
  library.any.assign(static_cast<std::size_t>(kInteractionFeatures), {0, 1});
  for (const auto& [name, centre] : {std::pair("slow", -1.0), std::pair("fast", 1.0)}) {
    InteractiveProcedure p;
    p.name = p.means = p.source = name;
    p.cue = {"none", "nothing", "a test"};
    p.least_s = 0.2;
    p.mean_s = 1;
    ProcedureProfile profile{
        "written", 1, 0,
        std::vector<FeatureRange>(static_cast<std::size_t>(kInteractionFeatures), FeatureRange{})};
    profile.features[kReversals] = {centre, 0.5};
    p.profiles = {profile};
    library.procedures.push_back(p);
  }
  return library;
}

Eigen::MatrixXd planted(const std::vector<int>& truth, std::uint64_t seed) {
  RandomStream random = RandomStream::ofSeed(seed);
  Eigen::MatrixXd x(static_cast<Eigen::Index>(truth.size()),
                    static_cast<int>(kInteractionFeatures));
  for (Eigen::Index t = 0; t < x.rows(); ++t) {
    for (Eigen::Index d = 0; d < x.cols(); ++d) x(t, d) = random.openNormal();
    x(t, kReversals) = (truth[static_cast<std::size_t>(t)] ? 1 : -1) + 0.5 * random.openNormal();
  }
  return x;
}

TEST(InteractiveProcedures, MatchingFindsVisitsNoShorterThanTheLeast) {
  std::vector<int> truth;
  for (int i = 0; i < 1000; ++i) truth.push_back(i / 100 % 2);
  ProcedureLibrary library = slowAndFast();
  library.independent_s = 0.02;
  const std::vector<int> found = matchProcedures(library, planted(truth, 7));
  int right = 0;
  for (std::size_t i = 0; i < truth.size(); ++i) right += found[i] == truth[i];
  EXPECT_GT(right, 970);  // within three steps of each of nine changes
  std::size_t begin = 0;
  for (std::size_t i = 1; i <= found.size(); ++i)
    if (i == found.size() || found[i] != found[begin]) {
      EXPECT_GE(i - begin, 20u);
      begin = i;
    }
}

TEST(InteractiveProcedures, AFeatureThatAProfileDoesNotNameSaysNothing) {
  const ProcedureLibrary library = slowAndFast();
  Eigen::MatrixXd x = planted({0, 1, 0, 1}, 3);
  const Eigen::MatrixXd before = procedureLikelihoods(library, x);
  x.col(kPushed).array() += 2;
  const Eigen::MatrixXd after = procedureLikelihoods(library, x);
  EXPECT_LT(((after.col(1) - after.col(0)) - (before.col(1) - before.col(0))).cwiseAbs().maxCoeff(),
            1e-9);
}

TEST(InteractiveProcedures, ProfilesOfTwoFormsAreFoundAgain) {
  RandomStream random = RandomStream::ofSeed(5);
  Eigen::MatrixXd x(4000, static_cast<int>(kInteractionFeatures));
  for (Eigen::Index t = 0; t < x.rows(); ++t)
    for (Eigen::Index d = 0; d < x.cols(); ++d)
      x(t, d) = (t % 4 == 0 ? 4 : 0) + random.openNormal();
  const std::vector<FeatureRange> any = rangesOf({x});
  const auto profiles = fitProfiles(x, "planted", any, 2, 0.01, 1, 1);
  ASSERT_EQ(profiles.size(), 2u);
  const ProcedureProfile& rare = profiles[profiles[0].share < profiles[1].share ? 0 : 1];
  EXPECT_NEAR(rare.share, 0.25, 0.01);
  EXPECT_NEAR(rare.seconds, 10, 0.4);
  for (const FeatureRange& range : rare.features) {
    EXPECT_NEAR(range.centre, 4, 0.13);  // four standard errors of a thousand
    EXPECT_NEAR(range.spread, 1, 0.1);
  }
}

TEST(InteractiveProcedures, TheFileHoldsTheLibrary) {
  const palpa::test::ScratchFolder folder("interactive-procedures");
  ProcedureLibrary library = slowAndFast();
  library.labels.push_back({"search", {"scan"}, 2, "fast", "a test"});
  library.labels.push_back({"search", {}, -1, "", "says nothing"});
  writeProcedures(library, folder / "procedures.json");
  const ProcedureLibrary again = readProcedures(folder / "procedures.json");
  ASSERT_EQ(again.procedures.size(), 2u);
  EXPECT_EQ(again.indexOf("fast"), 1);
  EXPECT_EQ(again.indexOf("faster"), -1);
  EXPECT_NEAR(again.procedures[1].profiles[0].features[kReversals].centre, 1, 1e-3);
  EXPECT_NEAR(again.procedures[1].profiles[0].features[kReversals].spread, 0.5, 1e-3);
  EXPECT_EQ(again.procedures[1].profiles[0].features[kPushed].spread, 0);
  EXPECT_NEAR(again.any[kMoveSpeed].spread, 1, 1e-3);
  EXPECT_EQ(again.labels[0].part, 2);
  EXPECT_TRUE(again.labels[1].procedure.empty());
}

TEST(InteractiveProcedures, KappaByNameSeeksNoMatching) {
  Eigen::MatrixXi counts(2, 2);
  counts << 0, 50, 50, 0;  // alike but for names: as bad as can be
  EXPECT_NEAR(kappaByName(counts), -1, 1e-12);
  counts << 45, 5, 15, 35;  // p_o 0.8, p_e 0.5
  EXPECT_NEAR(kappaByName(counts), 0.6, 1e-12);
  EXPECT_THROW(kappaByName(Eigen::MatrixXi::Zero(2, 2)), Error);
}

}  // namespace
}  // namespace palpa::calibration

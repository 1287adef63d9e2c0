// The six common errors of subclavian access, in scripted trials with one thing wrong and the rest
// as good trials scatter. What is wrong is drawn from ranges written down before the thresholds
// were tried.
#include <gtest/gtest.h>

#include <cstdio>

#include "tests/competence/reference.h"
#include "tests/support/counts.h"

namespace palpa::competence::test {
namespace {

using palpa::test::kDeg;
using palpa::test::Script;

int variants() { return palpa::test::counted(50, 500); }

double between(RandomStream& draw, double low, double high) {
  return low + (high - low) * draw.openUniform();
}
double sign(RandomStream& draw) { return draw.openUniform() < 0.5 ? -1 : 1; }

bool names(const assess::TrialAssessment& a, const std::string& code) {
  return std::any_of(a.errors.begin(), a.errors.end(),
                     [&](const assess::TechnicalError& e) { return e.code == code; });
}

/// How many of the variants are recognised, and how many have another error named besides.
struct Recognised {
  int right = 0, besides = 0;
};

template <class Wrong>
Recognised recognised(const std::string& code, std::uint64_t first_seed, Wrong wrong) {
  Recognised r;
  for (int i = 0; i < variants(); ++i) {
    const std::uint64_t seed = first_seed + static_cast<std::uint64_t>(i);
    RandomStream draw = RandomStream::ofSeed(seed);
    Script script;
    wrong(script, draw);
    const assess::TrialAssessment a =
        judged(palpa::test::scattered(draw, shippedPath(), script), seed, draw);
    r.right += names(a, code);
    r.besides += a.errors.size() > (names(a, code) ? 1u : 0u);
  }
  std::printf("%s: %d of %d recognised; another error named in %d\n", code.c_str(), r.right,
              variants(), r.besides);
  return r;
}

void isRecognised(const Recognised& r) {
  EXPECT_GE(r.right, std::ceil(0.95 * variants()));
  EXPECT_LE(r.besides, 0.05 * variants());
}

TEST(SixErrors, WrongSiteRelativeToTheClavicle) {
  isRecognised(recognised("site", 10'000, [](Script& s, auto& draw) {
    s.across = sign(draw) > 0 ? between(draw, 0.011, 0.018) : -between(draw, 0.012, 0.030);
  }));
}

TEST(SixErrors, PoorLandmarksAlongTheBone) {
  isRecognised(recognised("landmarks", 20'000, [](Script& s, auto& draw) {
    s.along = sign(draw) * between(draw, 0.016, 0.040);
  }));
}

TEST(SixErrors, PoorLandmarksAimedBelowTheNotch) {
  isRecognised(recognised("landmarks", 30'000, [](Script& s, auto& draw) {
    s.cephalad = -between(draw, 21, 40) * kDeg, s.finds_vein = false;
  }));
}

TEST(SixErrors, ThroughThePeriosteum) {
  isRecognised(recognised("periosteum", 40'000, [](Script& s, auto& draw) {
    s.clavicle_N = between(draw, 12, 20),
    s.clavicle_s = between(draw, 0.4, 2);  // halved at worst by the scatter
    s.finds_vein = draw.openUniform() < 0.5;
  }));
}

TEST(SixErrors, TooShallow) {
  isRecognised(recognised("shallow", 50'000, [](Script& s, auto& draw) {
    s.steeper = -between(draw, 15, 28) * kDeg, s.finds_vein = draw.openUniform() < 0.3;
  }));
}

TEST(SixErrors, TooCephalad) {
  isRecognised(recognised("cephalad", 60'000, [](Script& s, auto& draw) {
    s.cephalad = between(draw, 15, 35) * kDeg, s.finds_vein = draw.openUniform() < 0.3;
  }));
}

TEST(SixErrors, NeedleLeavesTheVein) {
  isRecognised(recognised("left_vein", 70'000, [](Script& s, auto& draw) {
    s.loses_after_s = between(draw, 0.25, 0.85), s.lost_s = between(draw, 0.3, 3);
    s.through = draw.openUniform() < 0.5, s.found_again = draw.openUniform() < 0.5;
  }));
}

TEST(SixErrors, AreNotNamedInCleanTrials) {
  int named = 0;
  const int trials = 4 * variants();
  for (int i = 0; i < trials; ++i) {
    const std::uint64_t seed = 80'000 + static_cast<std::uint64_t>(i);
    RandomStream draw = RandomStream::ofSeed(seed);
    Script script;
    script.redirections = static_cast<int>(3 * draw.openUniform());
    const assess::TrialAssessment a =
        judged(palpa::test::scattered(draw, shippedPath(), script), seed, draw);
    EXPECT_TRUE(a.values.success);
    named += !a.errors.empty();
  }
  std::printf("clean trials: an error named in %d of %d\n", named, trials);
  EXPECT_LE(named, 0.05 * trials);
}

TEST(SixErrors, SayTheirMomentFigureAndThresholdInClinicalWords) {
  RandomStream draw = RandomStream::ofSeed(1);
  Script script;
  script.cephalad = 14 * kDeg;
  const assess::TrialAssessment a = judged(script, 2, draw);
  ASSERT_EQ(a.errors.size(), 1u);
  const assess::TechnicalError& e = a.errors[0];
  EXPECT_EQ(e.title, "Too cephalad");
  EXPECT_EQ(e.unit, "deg");
  EXPECT_NEAR(e.value, 14, 0.3);  // a tremor of 0.2 degrees
  EXPECT_NEAR(e.threshold, 10, 1e-2);
  EXPECT_NE(e.sentence.find("The needle was aimed 14° too far toward the head over "),
            std::string::npos)
      << e.sentence;
  EXPECT_NE(e.sentence.find("(an error from 10° on): there lies the artery"), std::string::npos)
      << e.sentence;
  EXPECT_GT(e.t_s, 2);  // 10 mm of approach and 10 mm of puncture, at 10 mm/s
}

TEST(SixErrors, AreFiguresToo) {
  RandomStream draw = RandomStream::ofSeed(1);
  Script script;
  script.across = 0.015;
  const assess::TrialAssessment a = judged(script, 2, draw);
  const Figures figures = figuresOf(a);
  EXPECT_EQ(figures("error_site"), 1);
  for (const char* none : {"error_landmarks", "error_periosteum", "error_shallow", "error_cephalad",
                           "error_left_vein"})
    EXPECT_EQ(figures(none), 0) << none;
  EXPECT_NEAR(*figures("entry_across_mm"), 15, 0.2);
  EXPECT_NEAR(*figures("entry_along_mm"), 0, 0.2);
}

/// Several errors in one trial are each named, and the worst of two occurrences is told.
TEST(SixErrors, TogetherAreAllNamed) {
  RandomStream draw = RandomStream::ofSeed(3);
  Script script;
  script.across = 0.015, script.along = -0.025, script.steeper = -18 * kDeg,
  script.cephalad = 20 * kDeg, script.clavicle_N = 9, script.loses_after_s = 0.5;
  const assess::TrialAssessment a = judged(script, 4, draw);
  std::vector<std::string> codes;
  for (const assess::TechnicalError& e : a.errors) codes.push_back(e.code);
  EXPECT_EQ(codes, (std::vector<std::string>{"landmarks", "site", "periosteum", "shallow",
                                             "cephalad", "left_vein"}));
}

}  // namespace
}  // namespace palpa::competence::test

#include "calibration/touch/contact_laws.h"

#include <gtest/gtest.h>

#include <cmath>

#include "anatomy/base/error.h"
#include "haptics/modulation/virtual_inclusion.h"

namespace palpa::calibration {
namespace {

constexpr double kLumpTick = 1e-3;
const haptics::HuntCrossley kBedOfLump{900, 200, 1.4}, kLumpAdds{4000, 900, 1.7},
    kGivesDown{700, 300, 1.1}, kGivesAside{400, 200, 1.05};

const Vec3 kLumpRests(0, 0, -0.014);
constexpr double kLumpTip = 0.008;  // m

haptics::VirtualInclusion trueLump() {
  return {0.014, kLumpAdds, {kGivesAside, kGivesAside, kGivesDown}};
}

SoftContact withoutLump() {
  SoftContact plain;
  plain.law = kBedOfLump;
  return plain;
}

/// Presses at `place`, faster and slower; the surface flat, the reaction that of bed and lump, the
/// lump's motion as its balance has it.
void press(const Vec3& place, std::vector<LumpSample>* samples) {
  haptics::InclusionState state;
  double before = 0;
  for (int i = 0; i < 6000; ++i) {
    const double t = i * kLumpTick, rhythm = t < 3 ? 0.5 : 1.5,
                 x = 0.0035 * (1 - std::cos(2 * M_PI * rhythm * t)),
                 rate = (x - before) / kLumpTick;
    before = x;
    const Vec3 p = place - x * Vec3::UnitZ();
    const std::array<haptics::InclusionContact, 2> tools{
        {{x > 0, p, Vec3::UnitZ(), x, kLumpTip}, {}}};
    const haptics::InclusionAnswer answer =
        haptics::feelInclusion(trueLump(), kLumpRests, tools, kLumpTick, &state);
    samples->push_back({p, Vec3::UnitZ(),
                        haptics::forceOf(kBedOfLump, x, rate) * Vec3::UnitZ() + answer.f_T[0], x,
                        rate, answer.d});
  }
}

std::vector<LumpSample> recorded() {
  std::vector<LumpSample> samples;
  for (const Vec3& place : {Vec3(0, 0, 0), Vec3(0.006, 0, 0), Vec3(0, -0.006, 0)})
    press(place, &samples);
  return samples;
}

void expectLaw(const haptics::HuntCrossley& found, const haptics::HuntCrossley& truth) {
  EXPECT_NEAR(found.m, truth.m, 0.02 * truth.m);
  for (const double x : {0.5e-3, 2e-3})
    EXPECT_NEAR(haptics::forceOf(found, x, 0), haptics::forceOf(truth, x, 0),
                0.03 * haptics::forceOf(truth, x, 0));
}

TEST(LumpContact, FindsTheLumpAndItsBed) {
  const LumpContact found =
      identifyLump(recorded(), withoutLump(), {}, kLumpRests, kLumpTip, kLumpTick);
  EXPECT_NEAR(found.l0, 0.014, 1e-6);
  expectLaw(found.H_T, kLumpAdds);
  expectLaw(found.G[2], kGivesDown);
  expectLaw(found.G[0], kGivesAside);
  expectLaw(found.G[1], kGivesAside);
  EXPECT_LT(found.relative_rms, 0.02);
  EXPECT_EQ(found.advice, "");
}

TEST(LumpContact, PressedFromAboveOnlySaysSo) {
  std::vector<LumpSample> samples;
  press(Vec3::Zero(), &samples);
  const LumpContact found =
      identifyLump(samples, withoutLump(), {}, kLumpRests, kLumpTip, kLumpTick);
  EXPECT_NE(found.advice.find("beside"), std::string::npos);
  EXPECT_EQ(found.G[0].k, found.G[2].k);
}

std::string lumpRefusal(const std::vector<LumpSample>& samples) {
  try {
    identifyLump(samples, withoutLump(), {}, kLumpRests, kLumpTip, kLumpTick);
  } catch (const Error& e) {
    return e.what();
  }
  return "";
}

TEST(LumpContact, DataThatCannotTellAreRefused) {
  EXPECT_NE(lumpRefusal({}).find("too few"), std::string::npos);
  std::vector<LumpSample> samples = recorded();
  samples[100].f_r.x() = NAN;
  EXPECT_NE(lumpRefusal(samples).find("not a number"), std::string::npos);
  samples = recorded();
  for (LumpSample& s : samples)
    s.f_r = haptics::forceOf(kBedOfLump, s.x, s.rate) * s.n;  // no lump at all
  EXPECT_NE(lumpRefusal(samples), "");
}

}  // namespace
}  // namespace palpa::calibration

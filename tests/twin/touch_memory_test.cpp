#include "apps/twin/touch_memory.h"

#include <gtest/gtest.h>

#include <cmath>

namespace palpa::twin {
namespace {

constexpr double kOrdinary = 0.004;  // m

/// How far a place gives way with a lump at the origin that takes off up to 30 %.
FeltPress pressAt(double x, double y) {
  const double less = 0.3 * std::exp(-(x * x + y * y) / (2 * 0.006 * 0.006));
  return {{x, y, 0}, {0.001, kOrdinary * (1 - less) / 3, kOrdinary * (1 - less)}, less > 0.1};
}

TouchMemory searched() {
  TouchMemory memory(3);
  for (int i = -3; i <= 3; ++i)
    for (int j = -3; j <= 3; ++j) memory.add(pressAt(0.008 * i, 0.008 * j));
  return memory;
}

std::vector<FeltPress> crossAbout(double x, double y) {
  constexpr double d = 0.004;
  return {pressAt(x, y), pressAt(x + d, y), pressAt(x - d, y), pressAt(x, y + d),
          pressAt(x, y - d)};
}

TEST(TouchMemory, TellsFirmFromOrdinary) {
  const TouchMemory memory = searched();
  EXPECT_NEAR(memory.firmness(pressAt(0, 0)), -std::log(0.7), 0.03);
  EXPECT_NEAR(memory.firmness(pressAt(0.024, 0.024)), 0, 0.01);
  EXPECT_EQ(TouchMemory(3).firmness(pressAt(0, 0)), 0) << "there is nothing to compare with";
}

TEST(TouchMemory, WhereItWasTouchedTellsNothing) {
  FeltPress press = pressAt(0, 0);
  press.depths[0] *= 3;
  EXPECT_EQ(searched().firmness(press), searched().firmness(pressAt(0, 0)));
}

TEST(TouchMemory, FindsTheTopOfTheHill) {
  const TouchMemory memory = searched();
  EXPECT_LE(memory.hillAbout(crossAbout(0.005, -0.004), {0.005, -0.004, 0}).top.norm(), 0.0015);
  EXPECT_LE(memory.hillAbout({}, {0.008, 0, 0}).top.norm(), 0.0025)
      << "what the search felt counts: presses 8 mm apart";
  const Vec3 plain(0.024, 0.024, 0);
  const TouchMemory::Hill none = TouchMemory(3).hillAbout({}, plain);
  EXPECT_LT((none.top - plain).norm(), 1e-12);
  EXPECT_EQ(none.explained, 0);
}

TEST(TouchMemory, AHillExplainsMoreThanASinglePressThatIsFirmByChance) {
  const TouchMemory memory = searched();
  const Vec3 apart(-0.024, 0.024, 0);
  FeltPress chance = pressAt(apart.x(), apart.y());
  for (double& depth : chance.depths) depth *= 0.85;
  EXPECT_GT(memory.hillAbout({}, Vec3::Zero()).explained,
            3 * memory.hillAbout({chance}, apart).explained);
}

TEST(TouchMemory, TheFirmestCloseBy) {
  const TouchMemory memory = searched();
  const FeltPress* firmest = memory.firmestAbout({0.008, 0.008, 0}, 0.012);
  ASSERT_TRUE(firmest);
  EXPECT_LT(firmest->p_P.norm(), 1e-12);
  EXPECT_EQ(memory.firmestAbout({0.1, 0.1, 0}, 0.012), nullptr);
}

/// By the deepest press 30 % less, by the others nothing: two thirds of that and more.
TEST(TouchMemory, DeeperPressuresTellMore) {
  const TouchMemory memory = searched();
  FeltPress press = pressAt(0.024, 0.024);
  press.depths[2] *= 0.7;
  EXPECT_GT(memory.firmness(press), -0.67 * std::log(0.7));
}

TEST(TouchMemory, AWiderLumpSpreadsWider) {
  const TouchMemory memory = searched();
  const double spread = memory.spreadAbout(Vec3::Zero(), crossAbout(0, 0));
  EXPECT_GT(spread, 0.004);
  EXPECT_LT(spread, 0.010);
}

}  // namespace
}  // namespace palpa::twin

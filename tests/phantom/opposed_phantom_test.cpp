#include "apps/twin/phantom/opposed_phantom.h"

#include <gtest/gtest.h>

#include <cmath>

#include "anatomy/base/error.h"
#include "apps/station/assets.h"
#include "tests/support/counts.h"

namespace palpa::twin {
namespace {

constexpr double kThick = 0.03;
const Fineness kRoughSlab{4e-3, 0.8, 15e-3};
const SiliconeLaw kElasticOnly{.relaxes = {0, 0}};

SoftBlock slab() {
  SoftBlock block;
  block.length = block.width = 0.06;
  block.height = kThick;
  block.framed = true;
  return block;
}

/// Both faces as one law has them: f = d'^1.5 (100 + 10000 d'_other), and a third of a tool's way
/// under it.
OpposedTable ofLaw() {
  OpposedTable table;
  table.aways = 3;
  table.depths = 5;
  for (int a = 0; a < table.aways; ++a)
    for (int i = 1; i <= table.depths; ++i) {
      const double di = i * table.depth_step, power = std::pow(di, 1.5);
      table.under.push_back(10 * power);
      for (int j = 0; j <= i; ++j) {
        const double dj = j * table.depth_step;
        table.cells.push_back({{Eigen::Vector2d(0, power * (100 + 1e4 * dj)),
                                Eigen::Vector2d(0, std::pow(dj, 1.5) * (100 + 1e4 * di))},
                               {0, 0.1 * (dj - di)}});
      }
    }
  return table;
}

TEST(OpposedTable, DepthsCountFromWhereTheOtherToolLeavesTheFace) {
  const OpposedTable table = ofLaw();
  const double first = 2.5e-3, second = 2e-3, met = first + 10 * std::pow(second, 1.5),
               met_second = second + 10 * std::pow(first, 1.5);
  const OpposedCell both = table.at(0.001, {first, second});
  EXPECT_NEAR(both.f[0].y(), std::pow(met, 1.5) * (100 + 1e4 * met_second), 1e-9);
  EXPECT_NEAR(both.f[1].y(), std::pow(met_second, 1.5) * (100 + 1e4 * met), 1e-9);
  EXPECT_NEAR(both.lump.y(), 0.1 * (met_second - met), 1e-12);
  const OpposedCell alone = table.at(0, {first, -kThick});
  EXPECT_NEAR(alone.f[0].y(), 100 * std::pow(first, 1.5), 1e-9);
  EXPECT_EQ(alone.f[1].y(), 0);
  // The first has pushed the far face toward the second, which waits just off it.
  EXPECT_GT(table.at(0, {first, -1e-3}).f[1].y(), 0);
  EXPECT_EQ(table.at(0, {first, -0.01}).f[1].y(), 0);
  EXPECT_NEAR(table.at(0, {first, second}, 0).f[0].y(), 100 * std::pow(first, 1.5), 1e-9)
      << "far apart each is alone";
}

TEST(OpposedPhantomTwin, WhatIsTurnedOverFeelsTheSameTurnedOver) {
  OpposedPhantomTwin one(ofLaw(), kElasticOnly), other(ofLaw(), kElasticOnly);
  const Vec3 above(0.002, 0.001, -4e-3), below(0.002, 0.001, -kThick + 2e-3);
  const auto touches = one.step({above, below}, 1e-3),
             turned =
                 other.step({mirroredInSlab(below, kThick), mirroredInSlab(above, kThick)}, 1e-3);
  EXPECT_GT(touches[0].f.z(), 0);
  EXPECT_LT(touches[1].f.z(), 0) << "the second is pushed down";
  EXPECT_NEAR(turned[0].f.z(), -touches[1].f.z(), 1e-12);
  EXPECT_NEAR(turned[1].f.z(), -touches[0].f.z(), 1e-12);
  EXPECT_NEAR(touches[1].x, 2e-3, 1e-12);
}

/// What two opposite tools take off each other: each holds the slab against the other.
TEST(FramedBlock, PinchedIsStifferThanPressedAloneAndTheLumpStaysInTheMiddle) {
  SoftBlock block = slab();
  block.lump = SoftBlock::Lump{{0, 0, -kThick / 2}, 0.007, 24e3};
  FiniteBlock solid(block, {0}, 0.008, kRoughSlab);
  const BlockResponse alone = solid.press({Vec3(0, 0, -4e-3)}),
                      both = solid.press({Vec3(0, 0, -4e-3), Vec3(0, 0, -kThick + 4e-3)});
  EXPECT_LT(alone.under, -0.3e-3) << "it bends";
  EXPECT_GT(both.f[0].z(), 1.2 * alone.f[0].z());
  EXPECT_NEAR(both.f[0].z(), -both.f[1].z(), 1e-3 * both.f[0].z());
  EXPECT_NEAR(both.lump.z(), 0, 1e-6);
}

TEST(OpposedTable, IsWhatTheElementsSay) {
  if (!test::fullCounts()) GTEST_SKIP() << "its elements take a minute: ./check --full";
  SoftBlock block = slab();
  block.lump = SoftBlock::Lump{{0, 0, -kThick / 2}, 0.007, 24e3};
  OpposedTable table;
  table.aways = 2;
  table.depths = 5;
  table = tabulateOpposed(block, table, kRoughSlab);
  FiniteBlock solid(block, {0}, table.tool_radius, kRoughSlab);
  for (const auto& depth : {std::array{4.4e-3, 4.4e-3}, {5e-3, 1e-3}, {5e-3, -0.5e-3}}) {
    const BlockResponse told = solid.press({Vec3(0, 0, -depth[0]), Vec3(0, 0, -kThick + depth[1])});
    const OpposedCell found = table.at(0, depth), turned = table.at(0, {depth[1], depth[0]});
    EXPECT_NEAR(found.f[0].y(), told.f[0].z(), 0.03 * told.f[0].z());
    EXPECT_NEAR(found.f[1].y(), -told.f[1].z(), 0.03 * told.f[0].z());
    // the elements are let go where 1e-6 of the force is left over
    EXPECT_NEAR(turned.f[1].y(), found.f[0].y(), 1e-5 * told.f[0].z());
  }
}

TEST(OpposedFile, TheShippedTablesAreOfTheShippedSlabs) {
  const auto slabs = readSolvedOpposed(station::assetFile("phantoms/opposed.json"),
                                       station::assetFile("phantoms/opposed.tables.json"));
  ASSERT_EQ(slabs.size(), 4u);
  const double plain = slabs[0].table.at(0, {4e-3, 4e-3}).f[0].y();
  EXPECT_GT(plain, 0.3);
  for (std::size_t i = 1; i < slabs.size(); ++i)
    EXPECT_GT(slabs[i].table.at(0, {4e-3, 4e-3}).f[0].y(), 1.1 * plain) << slabs[i].name;
}

}  // namespace
}  // namespace palpa::twin

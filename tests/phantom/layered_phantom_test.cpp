#include "apps/twin/phantom/layered_phantom.h"

#include <gtest/gtest.h>

#include <fstream>

#include "anatomy/base/error.h"
#include "tests/support/scratch_folder.h"

namespace palpa::twin {
namespace {

using Eigen::Vector2d;

constexpr double kTip = 0.008;
constexpr Fineness kVeryRough{6e-3, 1, 15e-3};

SoftBlock layered() {
  SoftBlock block;
  block.length = block.width = 0.06;
  block.height = 0.03;
  block.layers = {{2e-3, 0.02, 8e3}, {10e-3, 0, 1.5e3}};
  block.ribs = {{0.01, -0.016, 0.008, 60e3}};
  block.lump = SoftBlock::Lump{{-0.01, 0, -0.012}, 0.006, 24e3};
  return block;
}

TEST(LayeredBlock, HoldsWhatLiesAtEachPoint) {
  const SoftBlock block = layered();
  EXPECT_EQ(shearAt(block, {0, 0, -1e-3}), 8e3) << "skin";
  EXPECT_EQ(shearAt(block, {0.025, 0, -2.4e-3}), 8e3) << "thicker there";
  EXPECT_EQ(shearAt(block, {0, 0, -5e-3}), 1.5e3) << "fat";
  EXPECT_EQ(shearAt(block, {0, 0.02, -0.025}), block.shear) << "below all layers";
  EXPECT_EQ(shearAt(block, {0.01, 0.02, -0.016}), 60e3) << "a rib, from side to side";
  EXPECT_EQ(shearAt(block, {-0.01, 0, -0.012}), 24e3) << "the lump, in the fat";
  EXPECT_EQ(shearAt(block, {-0.01, 0.02, -0.011}), 1.5e3) << "beside it";
}

/// Where half of the block may be computed, the whole says the same.
TEST(LayeredBlock, WholeAndHalfAgree) {
  const SoftBlock block = layered();
  FiniteBlock half(block, {-0.006}, kTip, kVeryRough),
      whole = FiniteBlock::whole(block, {-0.006, 0}, kTip, kVeryRough);
  const Vec3 at(-0.006, 0, -3e-3);
  const BlockResponse a = half.press({at}), b = whole.press({at});
  EXPECT_NEAR(b.f[0].z(), a.f[0].z(), 0.03 * a.f[0].z()) << "not the same elements";
  EXPECT_NEAR(b.f[0].y(), 0, 1e-3 * a.f[0].z());
  EXPECT_NEAR(b.energy, a.energy, 0.03 * a.energy);
}

TEST(LayeredBlock, BothSidesOfTheMiddleAreAlikeAndARibIsFelt) {
  SoftBlock block = layered();
  block.lump.reset();  // needs finer elements
  const auto force = [&](double x, double y) {
    return FiniteBlock::whole(block, {x, y}, kTip, kVeryRough).press({Vec3(x, y, -3e-3)}).f[0];
  };
  const Vec3 left = force(0.01, -0.012), right = force(0.01, 0.012);
  EXPECT_NEAR(left.z(), right.z(), 0.02 * right.z());
  EXPECT_NEAR(left.y(), -right.y(), 0.02 * right.z());
  SoftBlock plain = block;
  plain.ribs.clear();
  const double without = FiniteBlock::whole(plain, {0.01, 0.012}, kTip, kVeryRough)
                             .press({Vec3(0.01, 0.012, -3e-3)})
                             .f[0]
                             .z();
  EXPECT_GT(right.z(), 1.05 * without);
}

constexpr char kSmallFile[] = R"({"version": 1, "tool_radius_mm": 8,
  "block": {"length_mm": 60, "width_mm": 60, "height_mm": 30, "bulk_over_shear": 50},
  "table": {"step_mm": 8, "sides": 2, "depth_step_mm": 2, "depths": 2, "finest_mm": 8, "growth": 1,
            "coarsest_mm": 15},
  "phantoms": [{"name": "one", "shear_kPa": 3, "layers": [{"thickness_mm": 3, "shear_kPa": 8}],
                "core": {"x_mm": 8, "depth_mm": 14, "diameter_mm": 22, "shear_kPa": 30},
                "friction": {"left": 0.5, "right": 2, "across_mm": 3}}]})";

struct SmallFile {
  explicit SmallFile(const std::string& text = kSmallFile)
      : folder("layered"), file(folder / "small.json"), tables(folder / "small.tables.json") {
    std::ofstream(file) << text;
  }
  test::ScratchFolder folder;
  std::filesystem::path file, tables;
};

const SmallFile& solvedOnce() {
  static const SmallFile small;
  static const bool solved = (solveLayered(small.file, small.tables, {}), true);
  EXPECT_TRUE(solved);
  return small;
}

TEST(LayeredFile, SolvedAndReadAgain) {
  const SmallFile& small = solvedOnce();
  EXPECT_TRUE(isLayered(small.file));
  const std::vector<LayeredPhantom> phantoms = readSolvedLayered(small.file, small.tables);
  ASSERT_EQ(phantoms.size(), 1u);
  const SurfaceTable& table = phantoms[0].table;
  const Vector2d p(8e-3, 8e-3);
  FiniteBlock solid =
      FiniteBlock::whole(phantoms[0].block, p, kTip, readLayered(small.file).fineness);
  const Vec3 f = solid.press({Vec3(p.x(), p.y(), -4e-3)}).f[0];
  EXPECT_LT((table.at(p, 4e-3) - f).norm(), 2e-5);
  const Vec3 mirrored = table.at({8e-3, -8e-3}, 4e-3);
  EXPECT_NEAR(mirrored.y(), -f.y(), 2e-5);
  EXPECT_NEAR(mirrored.z(), f.z(), 2e-5);
  EXPECT_EQ(table.at(p, 0), Vec3::Zero());
  EXPECT_GT(table.at({8e-3, 0}, 3e-3).z(), table.at({-16e-3, 0}, 3e-3).z()) << "the core";

  LayeredPhantomTwin twin(phantoms[0], SiliconeLaw{});
  PhantomTouch touch;
  for (int i = 0; i < 4000; ++i) touch = twin.step({-16e-3, 0, -3e-3}, 1e-3);
  EXPECT_NEAR(touch.f_n, table.at({-16e-3, 0}, 3e-3).norm(), 0.01 * touch.f_n)
      << "relaxed, the elements' force";
}

TEST(LayeredFile, FrictionIsOfTheSideThatIsTouched) {
  const RubbingSides rubs{0.5, 2, 1e-3};
  EXPECT_NEAR(rubs.at(-0.02), 0.5, 1e-6);
  EXPECT_NEAR(rubs.at(0), 1.25, 1e-9);
  EXPECT_NEAR(rubs.at(0.02), 2, 1e-6);
}

TEST(LayeredFile, WhatCannotBeIsRefused) {
  const auto refusal = [](const std::string& from, const std::string& to) {
    std::string text = kSmallFile;
    text.replace(text.find(from), from.size(), to);
    const SmallFile small(text);
    try {
      readLayered(small.file);
    } catch (const UsageError& e) {
      return std::string(e.what());
    }
    return std::string();
  };
  EXPECT_NE(refusal("\"sides\": 2", "\"sides\": 5").find("off the block"), std::string::npos);
  EXPECT_NE(refusal("\"thickness_mm\": 3", "\"thick_mm\": 3").find("thick_mm"), std::string::npos);
  const SmallFile& small = solvedOnce();
  std::string text = kSmallFile;
  text.replace(text.find("\"shear_kPa\": 3"), 14, "\"shear_kPa\": 4");
  const SmallFile changed(text);
  EXPECT_THROW(readSolvedLayered(changed.file, small.tables), UsageError);
}

}  // namespace
}  // namespace palpa::twin

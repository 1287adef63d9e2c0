#include "apps/twin/phantom/phantom_file.h"

#include <gtest/gtest.h>

#include <fstream>
#include <sstream>

#include "anatomy/base/error.h"
#include "apps/station/assets.h"
#include "tests/support/counts.h"
#include "tests/support/scratch_folder.h"

namespace palpa::twin {
namespace {

constexpr char kSmall[] = R"({"version": 1, "tool_radius_mm": 8,
  "block": {"length_mm": 60, "width_mm": 60, "height_mm": 40, "shear_kPa": 2.4, "bulk_over_shear": 50},
  "table": {"away_step_mm": 6, "depth_step_mm": 2, "aways": 2, "depths": 2, "finest_mm": 5, "growth": 1}, "pairs": {"apart_mm": 18, "shift_step_mm": 5, "shifts": 1, "depth_step_mm": 2, "depths": 1},
  "phantoms": [{"name": "plain"}, {"name": "one", "lump": {"depth_mm": 14, "diameter_mm": 16, "times_stiffer": 10}}]})";

struct Written {
  explicit Written(const std::string& text = kSmall)
      : folder("phantoms"), file(folder / "small.json"), tables(folder / "small.tables.json") {
    std::ofstream(file) << text;
  }
  test::ScratchFolder folder;
  std::filesystem::path file, tables;
};

std::string replaced(std::string text, const std::string& what, const std::string& by) {
  return text.replace(text.find(what), what.size(), by);
}

std::string refusal(const std::string& text) {
  const Written written(text);
  try {
    readPhantoms(written.file);
  } catch (const UsageError& e) {
    return e.what();
  }
  return "";
}

TEST(PhantomFile, SolvedAndReadAgain) {
  const Written written;
  int steps = 0;
  solvePhantoms(written.file, written.tables, [&](const std::string&, int, int) { ++steps; });
  EXPECT_EQ(steps, 2 * (4 + 1));
  const std::vector<Phantom> phantoms = readSolved(written.file, written.tables);
  ASSERT_EQ(phantoms.size(), 2u);
  EXPECT_EQ(phantoms[1].name, "one");
  EXPECT_NEAR(phantoms[1].block.lump->shear, 24e3, 1e-9);
  FiniteBlock solid(phantoms[1].block, {0}, 0.008, readPhantoms(written.file).fineness);
  EXPECT_NEAR(phantoms[1].table.at(0, 4e-3).f_up, solid.press({Vec3(0, 0, -4e-3)}).f[0].z(), 2e-5);
}

TEST(PhantomFile, TablesOfAnotherDescriptionAreRefused) {
  const Written written;
  solvePhantoms(written.file, written.tables, {});
  std::ofstream(written.file) << replaced(kSmall, "2.4", "2.5");
  EXPECT_THROW(readSolved(written.file, written.tables), UsageError);
}

TEST(PhantomFile, DamageIsNamed) {
  EXPECT_NE(
      refusal(replaced(kSmall, "\"depth_mm\": 14", "\"depth_mm\": 3")).find("outside the block"),
      std::string::npos);
  EXPECT_NE(refusal(replaced(kSmall, "\"shear_kPa\": 2.4", "\"shear_kPa\": -1")).find("shear_kPa"),
            std::string::npos);
  EXPECT_NE(refusal(replaced(kSmall, "\"aways\": 2", "\"aways\": 9")).find("off the block"),
            std::string::npos);
  EXPECT_NE(refusal(replaced(kSmall, "\"times_stiffer\": 10", "\"times\": 10")).find("entry 2"),
            std::string::npos);
}

/// Bytes lost or changed: read or refused, nothing else.
TEST(PhantomFile, DamagedTablesAreRefusedInWords) {
  const Written written;
  solvePhantoms(written.file, written.tables, {});
  std::stringstream whole;
  whole << std::ifstream(written.tables).rdbuf();
  const std::string text = whole.str();
  for (std::size_t cut = 0; cut < text.size(); cut += 37) {
    for (const std::string& damaged :
         {text.substr(0, cut), replaced(text, text.substr(cut, 1), "-"),
          text.substr(0, cut) + "9" + text.substr(cut)}) {
      std::ofstream(written.tables) << damaged;
      try {
        readSolved(written.file, written.tables);
      } catch (const Error& e) {
        EXPECT_GT(std::string(e.what()).size(), 10u);
      }
    }
  }
}

/// The shipped tables are what the shipped description gives today: one cell of each phantom, all
/// of one in full counts.
TEST(PhantomFile, ShippedTablesAreThoseOfTheShippedPhantoms) {
  const std::filesystem::path file = station::assetFile("phantoms/mockups.json");
  const std::vector<Phantom> phantoms =
      readSolved(file, station::assetFile("phantoms/mockups.tables.json"));
  ASSERT_EQ(phantoms.size(), 9u);
  const Fineness fineness = readPhantoms(file).fineness;
  for (std::size_t i = 0; i < phantoms.size(); i += test::counted<std::size_t>(8, 1)) {
    const PhantomTable& table = phantoms[i].table;
    const double away = (i % 3) * table.away_step;
    FiniteBlock solid(phantoms[i].block, {away}, table.tool_radius, fineness);
    const Vec3 f = solid.press({Vec3(away, 0, -3 * table.depth_step)}).f[0];
    const PhantomCell cell = table.at(away, 3 * table.depth_step);
    EXPECT_NEAR(cell.f_up, f.z(), 1e-4) << phantoms[i].name;
    EXPECT_NEAR(cell.f_out, f.x(), 1e-4) << phantoms[i].name;
    FiniteBlock pressed_twice(phantoms[i].block, {-0.005, 0.015}, table.tool_radius, fineness);
    const auto both = pressed_twice.press({Vec3(0.015, 0, -4e-3), Vec3(-0.005, 0, -2e-3)}).f;
    const PairCell pair = phantoms[i].both.at(table, 0.005, {4e-3, 2e-3});
    for (std::size_t t = 0; t < 2; ++t)
      EXPECT_NEAR(pair.f[t].y(), both[t].z(), 1e-4) << phantoms[i].name;
  }
}

}  // namespace
}  // namespace palpa::twin

#include <gtest/gtest.h>

#include <cmath>
#include <nlohmann/json.hpp>
#include <numbers>
#include <sstream>

#include "program.h"
#include "tests/support/test_data.h"

/// Patients as an educator makes and looks at them.
namespace palpa::cli_test {
namespace {

/// A closed spindle along x, as long as `length` in the file's unit.
std::string spindleObj(double length) {
  constexpr int kRings = 12, kSides = 16;
  std::ostringstream obj;
  obj << "v " << -length / 2 << " 0 0\n";
  for (int r = 1; r < kRings; ++r)
    for (int s = 0; s < kSides; ++s) {
      const double at = std::numbers::pi * r / kRings, round = 2 * std::numbers::pi * s / kSides;
      obj << "v " << -length / 2 * std::cos(at) << ' '
          << length / 12 * std::sin(at) * std::cos(round) << ' '
          << length / 12 * std::sin(at) * std::sin(round) << '\n';
    }
  const int last = 2 + (kRings - 1) * kSides;
  obj << "v " << length / 2 << " 0 0\n";
  const auto on = [](int r, int s) { return 2 + (r - 1) * kSides + s % kSides; };
  for (int s = 0; s < kSides; ++s) {
    obj << "f 1 " << on(1, s + 1) << ' ' << on(1, s) << '\n';
    for (int r = 1; r + 1 < kRings; ++r) {
      obj << "f " << on(r, s) << ' ' << on(r, s + 1) << ' ' << on(r + 1, s) << '\n';
      obj << "f " << on(r, s + 1) << ' ' << on(r + 1, s + 1) << ' ' << on(r + 1, s) << '\n';
    }
    obj << "f " << last << ' ' << on(kRings - 1, s) << ' ' << on(kRings - 1, s + 1) << '\n';
  }
  return obj.str();
}

std::string mapOf(const std::string& unit) {
  return nlohmann::json{
      {"format", "palpa-import-map"},
      {"version", 1},
      {"name", "one bone"},
      {"side", "right"},
      {"unit", unit},
      {"axes", "LPS"},
      {"licence", "CC0-1.0"},
      {"source", "this test"},
      {"entries", {{{"file", "bone.obj"}, {"id", "clavicle_right"}, {"organ", "clavicle"}}}}}
      .dump();
}

TEST(Patient, ThatWasDescribedIsBuiltAndTold) {
  const Folder here;
  const Outcome built = palpa({"patient", "build", "--sex", "f", "--height", "1.68", "--bmi", "24",
                               "--side", "left", "--seed", "3", "--out", "p.glb"},
                              here.path());
  ASSERT_EQ(built.exit_code, 0) << built.err;
  const Outcome told = palpa({"patient", "info", "p.glb"}, here.path());
  ASSERT_EQ(told.exit_code, 0) << told.err;
  for (const char* words :
       {"left side", "clavicle_left", "vein_target", "vein depth under the skin"})
    EXPECT_TRUE(says(told.out, words)) << words << "\n" << told.out;
  EXPECT_FALSE(says(told.out, "BAD")) << told.out;
}

TEST(Patient, IsNotPuncturedOnASideThatWasNotBuilt) {
  const Folder here;
  ASSERT_EQ(palpa({"patient", "build", "--seed", "3", "--out", "p.glb"}, here.path()).exit_code, 0);
  const Outcome refused = palpa(session({"--patient", "p.glb", "--side", "left"}), here.path());
  EXPECT_EQ(refused.exit_code, 2);
  EXPECT_EQ(refused.errLines(), 1) << refused.err;
  EXPECT_TRUE(says(refused.err, "--side") && says(refused.err, "right side")) << refused.err;
}

TEST(Patient, WhoCannotBeIsRefusedInOneLine) {
  const Folder here;
  for (const auto& stated : {std::pair{"--height", "3"}, std::pair{"--bmi", "90"}}) {
    const Outcome refused =
        palpa({"patient", "build", stated.first, stated.second, "--out", "p.glb"}, here.path());
    EXPECT_NE(refused.exit_code, 0);
    EXPECT_EQ(refused.errLines(), 1) << refused.err;
    EXPECT_TRUE(here.files().empty());
  }
}

TEST(Patient, PhantomIsBuiltWithItsInclusionAndIsNotToBePunctured) {
  const Folder here;
  for (const char* kind : {"breast", "abdomen"}) {
    const Outcome built = palpa({"patient", "build", "--phantom", kind, "--inclusion-mm", "20",
                                 "--depth-mm", "15", "--out", "b.glb"},
                                here.path());
    ASSERT_EQ(built.exit_code, 0) << built.err;
    const Outcome told = palpa({"patient", "info", "b.glb"}, here.path());
    EXPECT_TRUE(says(told.out, "inclusion")) << told.out;
    EXPECT_TRUE(says(told.out, "not to be punctured")) << told.out;
    const Outcome session =
        palpa({"subclavian", "--patient", "b.glb", "--fast", "--quiet"}, here.path());
    EXPECT_NE(session.exit_code, 0);
    EXPECT_EQ(session.errLines(), 1) << session.err;
  }
}

TEST(Patient, IsImportedFromFilesByAMap) {
  const Folder here;
  here.file("bone.obj", spindleObj(150));
  here.file("map.json", mapOf("mm"));
  const Outcome imported =
      palpa({"patient", "import", "--map", "map.json", ".", "--out", "p.glb"}, here.path());
  ASSERT_EQ(imported.exit_code, 0) << imported.err;
  EXPECT_TRUE(says(imported.out, "CC0-1.0")) << imported.out;
  const Outcome told = palpa({"patient", "info", "p.glb"}, here.path());
  EXPECT_TRUE(says(told.out, "clavicle_right")) << told.out;
  const Outcome drawn = palpa({"render", "--patient", "p.glb", "--out", "p.png"}, here.path());
  EXPECT_EQ(drawn.exit_code, 0) << drawn.err;
  EXPECT_GT(contentOf(here / "p.png").size(), 10'000u);
}

TEST(Patient, InTheWrongUnitIsRefusedWithTheLikelyOneNamed) {
  const Folder here;
  here.file("bone.obj", spindleObj(150));
  here.file("map.json", mapOf("m"));
  const Outcome refused =
      palpa({"patient", "import", "--map", "map.json", ".", "--out", "p.glb"}, here.path());
  EXPECT_NE(refused.exit_code, 0);
  EXPECT_EQ(refused.errLines(), 1) << refused.err;
  EXPECT_TRUE(says(refused.err, "millimetre")) << refused.err;
  const Outcome looked =
      palpa({"patient", "info", "bone.obj", "--unit", "m", "--organ", "clavicle"}, here.path());
  EXPECT_NE(looked.exit_code, 0);
  EXPECT_TRUE(says(looked.err, "--unit mm")) << looked.err;
}

TEST(Patient, OfARealCtIsPunctured) {
  const std::filesystem::path volume = testData("ct/chest_contrast_lidc2.mha");
  PALPA_NEED_DATA(volume);
  const Folder here;
  const Outcome built =
      palpa({"patient", "build", "--ct", volume.string(), "--ct-axes", "LAI", "--out", "ct.glb"},
            here.path());
  ASSERT_EQ(built.exit_code, 0) << built.err;
  EXPECT_TRUE(says(built.out + built.err, "leaves the volume"));
  const Outcome held = palpa(
      session({"--patient", "ct.glb", "--operator-knows", "patient", "--out", "A"}), here.path());
  ASSERT_EQ(held.exit_code, 0) << held.err;
  EXPECT_TRUE(says(held.out, "Trial 1 (not scored, simulated): success\n")) << held.out;
  EXPECT_TRUE(says(held.out, "Not scored: this patient's taught line is out of the range"))
      << held.out;
  EXPECT_TRUE(says(contentOf(here / "A/report.html"), "out of the range that can be scored"));
}

}  // namespace
}  // namespace palpa::cli_test

#include <gtest/gtest.h>

#include <cmath>
#include <nlohmann/json.hpp>
#include <sstream>

#include "program.h"
#include "tests/support/counts.h"

/// A sample's softness, friction and lumps, as an educator has them found.
namespace palpa::cli_test {
namespace {

using nlohmann::json;

double parameter(const json& file, const char* name) { return file["parameters"][name][0]; }

/// One run of a routine on the virtual palpation bench.
json found(const std::string& kind, const std::vector<std::string>& more, const Folder& here) {
  std::vector<std::string> arguments{"calibrate", kind, "--out", kind, "--quiet"};
  arguments.insert(arguments.end(), more.begin(), more.end());
  const Outcome outcome = palpa(arguments, here.path());
  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  if (outcome.exit_code != 0) return {};
  EXPECT_TRUE(says(outcome.out, "(simulated): pass")) << outcome.out;
  EXPECT_TRUE(says(contentOf(here / (kind + "/calibration.html")), "SIMULATED"));
  return json::parse(contentOf(here / (kind + "/" + kind + ".json")));
}

/// Judged by presses and strokes that were not used; and the figures are those of silicone of 7 kPa
/// under a tip of 8 mm, whose surface rubs with 0.35.
TEST(CalibrateFeel, OnTheVirtualBench) {
  for (int seed = 1; seed <= test::counted(1, 8); ++seed) {
    const Folder here;
    const std::string number = std::to_string(seed);
    const json material = found("material", {"--seed", number}, here),
               friction = found("friction", {"--seed", number}, here);
    ASSERT_FALSE(material.is_null() || friction.is_null());
    const double at_5_mm =
        parameter(material, "k_N_per_m_to_the_m") * std::pow(5e-3, parameter(material, "m"));
    EXPECT_GT(at_5_mm, 0.3) << seed;
    EXPECT_LT(at_5_mm, 0.7) << seed;
    EXPECT_GE(parameter(material, "m"), 1) << seed;
    EXPECT_LE(parameter(material, "m"), 2) << seed;
    EXPECT_NEAR(parameter(friction, "mu"), 0.35, 0.05) << seed;
    EXPECT_LE(double(material["checks"][0]["value"]), 7) << seed;
    EXPECT_LE(double(friction["checks"][0]["value"]), 7) << seed;
  }
}

/// What lies on the station was calibrated there: sessions go by that, not by the library of lumps.
TEST(CalibrateFeel, SessionsGoByTheStationsOwnSample) {
  const Folder here;
  ASSERT_FALSE(found("material", {"--seed", "2"}, here).is_null());
  ASSERT_FALSE(
      found("friction", {"--seed", "2", "--station", "material/station.json"}, here).is_null());
  const auto report = [&here](const std::string& out, std::vector<std::string> more) {
    more.insert(more.begin(), {"squeeze", "--operator", "expert", "--out", out});
    const Outcome outcome = palpa(quickly(more), here.path());
    EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
    return contentOf(here / (out + "/report.html"));
  };
  EXPECT_TRUE(says(report("shipped", {}), "the library of lumps"));
  const std::string own = report("own", {"--station", "friction/station.json"});
  EXPECT_TRUE(says(own, "calibration of 20"));
  EXPECT_FALSE(says(own, "the library of lumps")) << "both were calibrated";
}

TEST(CalibrateFeel, ALumpOnTheVirtualBench) {
  for (const char* mockup : {"middle", "hard", "large, deep"}) {
    const Folder here;
    const json lump = found("inclusion", {"--mockup", mockup}, here);
    ASSERT_FALSE(lump.is_null()) << mockup;
    EXPECT_LE(double(lump["checks"][0]["value"]), 12) << mockup;
    EXPECT_GT(parameter(lump, "H_T_k_N_per_m_to_the_m"), 0) << mockup;
    if (!test::fullCounts()) break;
  }
  const Folder here;
  EXPECT_EQ(
      palpa({"calibrate", "inclusion", "--mockup", "plain", "--out", "A", "--quiet"}, here.path())
          .exit_code,
      2);
}

/// Presses by a law of Hunt and Crossley: f(x, x') z, times rising evenly by a millisecond.
struct Presses {
  double k = 900, b = 500, m = 1.4, most_N = 1e9, slow_only = 0, sign = 1;
  std::string table() const {
    std::ostringstream csv;
    csv.precision(12);
    csv << "t_s,x_mm,y_mm,z_mm,force_x_N,force_y_N,force_z_N\n";
    double before = 0;
    for (int i = 0; i < 12000; ++i) {
      const double t = 1e-3 * i, f_Hz = slow_only > 0 ? slow_only : 0.5 + 0.1 * t;
      const double depth = (slow_only > 0 ? 5e-3 : 3e-3 + 4e-4 * t) * 0.5 *
                               (1 - std::cos(6.2831853 * f_Hz * t)) -
                           2e-4,
                   rate = (depth - before) / 1e-3;
      before = depth;
      const double f = depth > 0 ? std::max(0.0, std::pow(depth, m) * (k + b * rate)) : 0;
      csv << t << ",0,0," << -1e3 * depth << ",0,0," << sign * std::min(f, most_N) << '\n';
    }
    return csv.str();
  }
};

TEST(CalibrateFeel, MaterialFromRecordedPresses) {
  const Folder here;
  here.file("presses.csv", Presses{}.table());
  const Outcome outcome = palpa(
      {"calibrate", "material", "--presses", "presses.csv", "--out", "A", "--quiet"}, here.path());
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_FALSE(says(outcome.out, "simulated"));
  const json file = json::parse(contentOf(here / "A/material.json"));
  EXPECT_NEAR(parameter(file, "k_N_per_m_to_the_m"), 900, 9);
  EXPECT_NEAR(parameter(file, "m"), 1.4, 0.014);
  EXPECT_NEAR(parameter(file, "b_Ns_per_m_to_the_m_plus_1"), 500, 5);
}

/// What cannot tell a law, or is not what it says: one line, exit code 1, nothing written.
TEST(CalibrateFeel, RefusesWhatCannotTellALaw) {
  const auto refused = [](const std::string& table, const std::string& words) {
    const Folder here;
    here.file("presses.csv", table);
    const std::vector<std::string> before = here.files();
    const Outcome outcome =
        palpa({"calibrate", "material", "--presses", "presses.csv", "--out", "A", "--quiet"},
              here.path());
    EXPECT_EQ(outcome.exit_code, 1) << words;
    EXPECT_EQ(outcome.errLines(), 1) << outcome.err;
    EXPECT_TRUE(says(outcome.err, words)) << outcome.err;
    EXPECT_EQ(here.files(), before);
  };
  Presses one_speed, saturated, flipped;
  one_speed.slow_only = 0.1;
  saturated.most_N = 0.4;
  flipped.sign = -1;
  refused(one_speed.table(), "speeds");
  refused(saturated.table(), "saturated");
  refused(flipped.table(), "sign");
  refused("t_s,x_mm,y_mm,z_mm,force_x_N,force_y_N,force_z_N\n0,0,0,0,0,0,0\n", "fewer than two");
  refused(
      "t_s,x_mm,y_mm,z_mm,force_x_N,force_y_N,force_z_N\n0,0,0,0,0,0,0\n0.001,0,0,0,0,0,0\n0.010,0,"
      "0,0,0,0,0\n",
      "not even");
  refused("t_s,x,y,z,force_x_N,force_y_N,force_z_N\n0,0,0,0,0,0,0\n0.001,0,0,0,0,0,0\n", "x_m");
}

TEST(CalibrateFeel, ALumpThatNobodySawMoveIsRefused) {
  const Folder here;
  const std::string table = Presses{}.table();
  for (const char* name : {"without.csv", "above.csv", "check.csv"}) here.file(name, table);
  const std::vector<std::string> arguments{
      "calibrate", "inclusion",  "--without", "without.csv", "--above", "above.csv", "--check",
      "check.csv", "--depth-mm", "14",        "--out",       "A",       "--quiet"};
  const Outcome outcome = palpa(arguments, here.path());
  EXPECT_EQ(outcome.exit_code, 1);
  EXPECT_EQ(outcome.errLines(), 1) << outcome.err;
  EXPECT_TRUE(says(outcome.err, "lump_x_mm")) << outcome.err;
}

}  // namespace
}  // namespace palpa::cli_test

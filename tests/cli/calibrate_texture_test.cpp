#include <gtest/gtest.h>

#include <cmath>
#include <nlohmann/json.hpp>
#include <sstream>

#include "anatomy/base/random.h"
#include "program.h"

/// What shakes a tool on a rough surface, as an educator has it found.
namespace palpa::cli_test {
namespace {

using nlohmann::json;

TEST(CalibrateTexture, OnTheVirtualBench) {
  const Folder here;
  const Outcome outcome = palpa({"calibrate", "texture", "--surface", "wood", "--forces", "0.6,1",
                                 "--speeds", "70,90", "--out", "T", "--quiet"},
                                here.path());
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_TRUE(says(outcome.out, "(simulated): pass")) << outcome.out;
  const json file = json::parse(contentOf(here / "T/texture.json"));
  EXPECT_EQ(file["kind"], "texture");
  EXPECT_EQ(file["simulated"], true);
  const json& found = file["parameters"];
  EXPECT_EQ(found["leaky_sum_rms_N"].size(), 4u);
  EXPECT_EQ(found["reflection"].size(), 4 * found["order"][0].get<std::size_t>());
  EXPECT_NEAR(found["forces_N"][1].get<double>(), 1, 0.03);
  EXPECT_NEAR(found["speeds_m_per_s"][0].get<double>(), 0.07, 0.002);
  EXPECT_LE(file["checks"][0]["value"].get<double>(), 1.5);
}

TEST(CalibrateTexture, RefusesASurfaceThatIsNotThere) {
  const Folder here;
  const Outcome outcome = palpa(
      {"calibrate", "texture", "--surface", "sandpapr", "--out", "T", "--quiet"}, here.path());
  EXPECT_EQ(outcome.exit_code, 2);
  EXPECT_TRUE(says(outcome.err, "sandpaper")) << outcome.err;
}

/// White shaking of 20 mN at 0.5 N and 50 mm/s.
std::string table(double seconds, std::uint64_t seed, double step = 1e-3) {
  RandomStream random(seed, "calibrate_texture_test");
  std::ostringstream csv;
  csv.precision(12);
  csv << "t_s,force_N,speed_mm_per_s,acceleration_m_per_s2\n";
  for (int i = 0; i < static_cast<int>(seconds / step); ++i)
    csv << step * i << ",0.5,50," << random.normal(0, 0.4) << '\n';
  return csv.str();
}

TEST(CalibrateTexture, FromFiles) {
  const Folder here;
  here.file("strokes.csv", table(20, 1));
  here.file("check.csv", table(20, 2));
  here.file("slow.csv", table(20, 3, 2e-3));
  const auto run = [&](const std::string& strokes, std::vector<std::string> more) {
    std::vector<std::string> arguments{"calibrate", "texture",  "--strokes", strokes, "--check",
                                       "check.csv", "--forces", "0.5",       "--out", "F",
                                       "--quiet",   "--speeds", "50"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return palpa(arguments, here.path());
  };
  const Outcome good = run("strokes.csv", {"--mass-g", "50"});
  ASSERT_EQ(good.exit_code, 0) << good.err;
  const json file = json::parse(contentOf(here / "F/texture.json"));
  EXPECT_NEAR(file["parameters"]["strongest_rms_N"][0].get<double>(), 0.02, 0.001);
  EXPECT_TRUE(says(run("strokes.csv", {}).err, "--mass-g"));
  EXPECT_TRUE(says(run("slow.csv", {"--mass-g", "50"}).err, "1 kHz"));
}

}  // namespace
}  // namespace palpa::cli_test

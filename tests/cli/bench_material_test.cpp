#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <nlohmann/json.hpp>

#include "program.h"
#include "tests/support/counts.h"

/// What haptic augmented reality promises without noise, measured as anyone can.
namespace palpa::cli_test {
namespace {

using Lines = std::vector<nlohmann::json>;

/// Those without noise, and what hands do, which is with noise always: here behind the low-pass.
bool isJudged(const nlohmann::json& line) {
  return line["params"]["noise"] == "none" ||
         (line["params"].contains("hands") && line["params"]["cleared"] != "kalman");
}
bool isCleared(const nlohmann::json& line) { return line["params"]["cleared"] == "kalman"; }

Lines linesOf(const Outcome& outcome, bool (*wanted)(const nlohmann::json&)) {
  Lines lines;
  for (const nlohmann::json& line : jsonLines(outcome)) {
    EXPECT_EQ(line["params"]["data"], "simulated");
    if (wanted(line)) lines.push_back(line);
  }
  return lines;
}

/// With `contacts` tools; 0: all.
std::vector<double> valuesOf(const Lines& lines, const std::string& metric, int contacts = 0) {
  std::vector<double> values;
  for (const auto& line : lines)
    if (line["metric"] == metric && (contacts == 0 || line["params"]["contacts"] == contacts))
      values.push_back(line["value"]);
  return values;
}

double worst(const Lines& lines, const std::string& metric) {
  const std::vector<double> values = valuesOf(lines, metric);
  return values.empty() ? 1e9 : *std::max_element(values.begin(), values.end());
}

/// One tool or two over every mock-up: of eight at most one errs by more than 0.07, of two tools at
/// most two.
void expectLumps(const Lines& lines, int contacts) {
  const std::vector<double> errors = valuesOf(lines, "inclusion_force_rel_rms", contacts),
                            unrendered = valuesOf(lines, "inclusion_none_rel_rms", contacts);
  ASSERT_EQ(errors.size(), test::counted<std::size_t>(3, 8));
  EXPECT_LE(std::count_if(errors.begin(), errors.end(), [](double e) { return e > 0.07; }),
            contacts == 1 ? 1 : 2);
  for (std::size_t i = 0; i < errors.size(); ++i) {
    EXPECT_GE(unrendered[i], 0.15) << i;
    EXPECT_LE(errors[i], std::min(0.12, unrendered[i] / 3)) << i;
  }
  EXPECT_LE(worst(lines, "inclusion_position_error_mm"), 1);
  EXPECT_LE(worst(lines, "solver_iterations_max"), 24);
}

constexpr std::size_t kSlabs = 3;

/// Of every mock-up under two tools.
double worstOf(const Lines& lines, const std::string& motion,
               std::size_t mockups = test::counted<std::size_t>(3, 8)) {
  double most = 0;
  std::size_t count = 0;
  for (const auto& line : lines) {
    if (line["metric"] != "two_tools_rel_rms" || line["params"]["motion"] != motion) continue;
    most = std::max(most, line["value"].get<double>());
    ++count;
  }
  EXPECT_EQ(count, mockups) << motion;
  return most;
}

/// Of every texture, in third octaves.
double worstTexture(const Lines& lines, const std::string& at) {
  double most = 0;
  std::size_t count = 0;
  for (const auto& line : lines) {
    if (line["metric"] != "texture_worst_dB" || line["params"]["at"] != at) continue;
    most = std::max(most, line["value"].get<double>());
    ++count;
  }
  EXPECT_EQ(count, 4u) << at;
  return most;
}

TEST(BenchMaterial, HoldsWhatIsPromised) {
  const Folder here;
  std::vector<std::string> arguments{"bench", "material"};
  if (!test::fullCounts()) arguments.push_back("--quick");
  const Outcome outcome = palpa(arguments, here.path());
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  const Lines lines = linesOf(outcome, isJudged);
  EXPECT_LE(worst(lines, "hc_param_error"), 0.01);
  EXPECT_LE(worst(lines, "hc_force_rel_rms"), 0.07);
  EXPECT_LE(worst(lines, "dahl_force_rel_rms"), 0.07);
  EXPECT_LE(worst(lines, "null_modulation_n"), 0.05);
  EXPECT_EQ(valuesOf(lines, "stiffness_rel_error").size(), 12u);
  EXPECT_LE(worst(lines, "stiffness_rel_error"), 0.06);
  EXPECT_EQ(valuesOf(lines, "squeeze_rel_error").size(), 6u);
  EXPECT_LE(worst(lines, "squeeze_rel_error"), 0.02);
  EXPECT_LE(worst(lines, "friction_rel_error"), 0.07);
  EXPECT_LE(worstTexture(lines, "commanded"), 2);
  EXPECT_GT(worstTexture(lines, "the twin's hand"), 0) << "printed, not judged: drives are slow";
  EXPECT_EQ(worst(lines, "texture_limited"), 0) << "the limiter lets it all through";
  EXPECT_EQ(valuesOf(lines, "taken_lump_rel_rms").size(), test::counted<std::size_t>(3, 8));
  EXPECT_LE(worst(lines, "taken_lump_rel_rms"), 0.07);
  expectLumps(lines, 1);
  expectLumps(lines, 2);
  EXPECT_LE(worstOf(lines, "side by side"), 0.09);
  EXPECT_LE(worstOf(lines, "rolled"), 0.12);
  for (const char* motion : {"opposed", "opposed in turn", "opposed, stroked"})
    EXPECT_LE(worstOf(lines, motion, kSlabs), 0.12) << motion;
  for (const double without : valuesOf(lines, "two_tools_none_rel_rms")) EXPECT_GE(without, 0.1);
  EXPECT_EQ(valuesOf(lines, "estimated_force_rel_rms").size(), 6u);
  EXPECT_LE(worst(lines, "estimated_force_rel_rms"), 0.18) << "no sensor: rates are left out";
  EXPECT_EQ(valuesOf(lines, "har_tick_hot_median").size(), 1u);
  ASSERT_EQ(valuesOf(lines, "har_tick_pushed").size(), 1u);
  EXPECT_GE(valuesOf(lines, "har_tick_pushed")[0], 0.9) << "what was timed did something";
  // Two devices; eight modulations under one tool, six between two.
  constexpr std::size_t kHeldStill = 2 * (8 + 6);
  EXPECT_EQ(valuesOf(lines, "hand_still_mm_s").size(), kHeldStill);
  ASSERT_EQ(valuesOf(lines, "held_object_slid_mm").size(), 1u);
  EXPECT_LE(worst(lines, "held_object_slid_mm"), 6) << "it was held";
  EXPECT_LE(worst(lines, "hand_still_mm_s"), 2);  // nothing swings on and on: that would be tens
  EXPECT_LE(worst(lines, "hand_gained_mJ"), 0.1);
  EXPECT_LE(worst(lines, "hand_largest_force"), 8);
  EXPECT_EQ(valuesOf(lines, "pulse_rel_rms").size(), 6u);
  EXPECT_LE(worst(lines, "pulse_rel_rms"), 0.05);
  if (!test::fullCounts()) return;
  const Lines cleared = linesOf(outcome, isCleared);
  EXPECT_EQ(valuesOf(cleared, "stiffness_rel_error").size(), 12u);
  EXPECT_LE(worst(cleared, "stiffness_rel_error"), 0.07) << "with realistic noise, too";
  EXPECT_LE(worst(cleared, "friction_rel_error"), 0.07);
  EXPECT_EQ(valuesOf(cleared, "reaction_delay_ms").size(), 3u);
  EXPECT_LE(worst(cleared, "reaction_delay_ms"), 8);
  EXPECT_EQ(valuesOf(cleared, "squeeze_rel_error").size(), 6u);
  EXPECT_LE(worst(cleared, "squeeze_rel_error"), 0.07);
  expectLumps(cleared, 1);
  expectLumps(cleared, 2);
  for (const char* motion : {"side by side", "rolled", "stroked"})
    EXPECT_LE(worstOf(cleared, motion), 0.15) << motion;
  for (const char* motion : {"opposed", "opposed in turn", "opposed, stroked"})
    EXPECT_LE(worstOf(cleared, motion, kSlabs), 0.15) << motion;
  EXPECT_EQ(valuesOf(cleared, "hand_still_mm_s").size(), kHeldStill);
  EXPECT_LE(worst(cleared, "hand_still_mm_s"), 2);
  EXPECT_LE(worst(cleared, "hand_gained_mJ"), 0.1);
  EXPECT_EQ(valuesOf(cleared, "pulse_rel_rms").size(), 6u);
  EXPECT_LE(worst(cleared, "pulse_rel_rms"), 0.05);
}

}  // namespace
}  // namespace palpa::cli_test

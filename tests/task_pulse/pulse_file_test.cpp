#include "apps/task_pulse/pulse_file.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <set>

#include <nlohmann/json.hpp>

#include "anatomy/base/error.h"
#include "anatomy/base/json_text.h"
#include "apps/task_pulse/pulse_scene.h"
#include "tests/support/files.h"

namespace palpa::task_pulse {
namespace {

const std::string kPulseTask = std::string(PALPA_SOURCE_DIR) + "/assets/tasks/pulse.json";

TEST(PulseFile, TheShippedOneIsRead) {
  const PulseSettings s = readPulse(kPulseTask);
  EXPECT_EQ(s.arteries[0].name, "radial");
  EXPECT_GT(s.library.surface.k, 0);
  EXPECT_EQ(s.rules.count_s, 30);
  EXPECT_EQ(s.rules.count_within, 3);
  for (const haptics::PulseWave& wave : s.law.waves) {
    double largest = 0;
    for (double t = 0; t < 0.7; t += 1e-3) largest = std::max(largest, haptics::pulseWave(wave, t));
    EXPECT_NEAR(largest, 1, 1e-9);
    EXPECT_EQ(haptics::pulseWave(wave, 0.7), 0);
  }
}

std::string whyRefused(const nlohmann::json& change) {
  const std::filesystem::path folder = test::freshFolder("task_pulse", "refused");
  nlohmann::json task = parseJson(test::slurp(kPulseTask));
  task["lumps"] =
      (std::filesystem::path(kPulseTask).parent_path() / task["lumps"].get<std::string>()).string();
  task.merge_patch(change);
  std::ofstream(folder / "task.json") << task.dump();
  try {
    readPulse(folder / "task.json");
  } catch (const UsageError& e) {
    return e.what();
  }
  return "";
}

TEST(PulseFile, WhatCannotBeMeantIsRefused) {
  using nlohmann::json;
  EXPECT_NE(whyRefused({{"engine", "friction"}}), "");
  for (const auto& [change, why] : std::vector<std::pair<json, std::string>>{
           {{{"arteries", {{"radial", {{"valve", {1, 2, 3}}}}}}}, "four numbers"},
           {{{"arteries", {{"radial", {{"ejection", {0, 300, 200, 1}}}}}}}, "rising"},
           {{{"arteries", {{"radial", {{"least_depth_mm", 9}}}}}}, "most_depth_mm"},
           {{{"rhythms", {{"regular", {{"share", 0.9}}}}}}, "add up to 1"},
           {{{"heart", {{"fewest_between", 20}}}}, "most_between"},
           {{{"patients", {{"strength", {{"least", 3}}}}}}, "most"}}) {
    EXPECT_NE(whyRefused(change).find(why), std::string::npos) << why << ": " << whyRefused(change);
  }
}

TEST(PulseFile, PatientsAreDrawnFromTheSeed) {
  const PulseSettings s = readPulse(kPulseTask);
  const std::vector<PulseCase> all = casesOf(s, 5, 300), again = casesOf(s, 5, 300);
  double irregular = 0;
  std::set<std::string> names;
  for (std::size_t i = 0; i < all.size(); ++i) {
    EXPECT_EQ(caseText(all[i]), caseText(again[i]));
    const ArteryFigures& figures = s.arteries[all[i].artery.vessel - 1];
    EXPECT_EQ(all[i].name, figures.name);
    EXPECT_GE(all[i].artery.depth, figures.least_depth);
    EXPECT_LE(all[i].artery.depth, figures.most_depth);
    EXPECT_GE(all[i].rate_per_min, 45);
    EXPECT_LE(all[i].rate_per_min, 150);
    irregular += all[i].rhythm == assess::PulseRhythm::irregular;
    names.insert(all[i].name);
  }
  EXPECT_EQ(names.size(), 3u);
  EXPECT_NEAR(irregular / 300, 0.3, 0.09);
  EXPECT_NE(caseText(all[0]), caseText(casesOf(s, 6, 1)[0]));
}

TEST(PulseFile, ACaseIsWrittenAndReadAgain) {
  const PulseCase one = casesOf(readPulse(kPulseTask), 9, 1)[0];
  EXPECT_EQ(caseText(caseIn(caseText(one))), caseText(one));
  EXPECT_THROW(caseIn("{}"), Error);
  nlohmann::json other = parseJson(caseText(one));
  other["rhythm"] = "waltz";
  EXPECT_THROW(caseIn(other.dump()), Error);
}

TEST(PulseFile, BesideAnArteryIsAcrossItsLine) {
  haptics::PulsingArtery artery;
  artery.a_P = {0, 1, 0};
  artery.half_length = 0.02;
  EXPECT_NEAR(besideArtery(artery, {0.003, 0.01, -0.002}), 0.003, 1e-12);
  EXPECT_NEAR(besideArtery(artery, {0, 0.024, 0}), 0.004, 1e-12);
}

TEST(PulseScene, TheScreenSaysWhatIsToBeDone) {
  PulseStatus status;
  status.artery = "radial";
  status.part = PulsePart::find;
  EXPECT_EQ(taskText(status), "Find the radial pulse, mark it with the button, then [D]");
  status.part = PulsePart::count;
  status.count_left_s = 11.2;
  EXPECT_EQ(taskText(status), "Count the beats: 12 s left");
  status.part = PulsePart::number;
  status.typed = "3";
  EXPECT_EQ(taskText(status), "How many beats? 3_");
}

/// From ticks as a session records them.
class ListenedPulse {
 public:
  ListenedPulse() : listener_(config(), assess::PulseRules{}) { listener_.begin(1); }
  static haptics::TickConfig config() {
    haptics::TickConfig c;
    c.touch.tip_radius = 0.008;
    return c;
  }
  void run(double seconds, PulsePart part, double f_n, bool button = false) {
    for (int i = 0; i < static_cast<int>(1000 * seconds); ++i) {
      haptics::FlightRecord r;
      r.t_ns = now_ns_ += 1'000'000;
      r.reading.homed = 1;
      r.reading.buttons = button ? 1 : 0;
      r.reading.p_DE = {0.004, 0.01, 0.015};  // the tip hangs below E's z here: X_ET is none
      r.commands.trial = 1;
      r.commands.armed = 1;
      r.commands.subtask = static_cast<std::uint8_t>(part);
      r.commands.artery.best_N = 0.6;
      r.commands.artery.beats[0] = {now_ns_ / 1'000'000'000 * 1'000'000'000 + 500'000'000, 1};
      r.sensed.f_D = {0, 0, f_n};
      r.skin_force = f_n;
      listener_.add(r);
    }
  }
  assess::PulseTrial trial() const {
    PulseCase patient;
    patient.artery.a_P = {0, 1, 0};
    patient.artery.half_length = 0.02;
    PulseAnswer said;
    said.add(31);
    said.add(3);
    return judged({}, patient, listener_, said);
  }
  PulseListener listener_;

 private:
  std::int64_t now_ns_ = 0;
};

TEST(PulseListener, CountsTheBeatsDeliveredWhileItIsCounted) {
  ListenedPulse one;
  one.run(5, PulsePart::find, 0.5);
  one.run(0.2, PulsePart::find, 0.5, true);
  one.run(30.001, PulsePart::count, 0.5);
  one.run(3, PulsePart::number, 0);
  const assess::PulseTrial trial = one.trial();
  ASSERT_TRUE(trial.delivered);
  EXPECT_EQ(*trial.delivered, 30);
  EXPECT_EQ(trial.counted, 31);
  EXPECT_EQ(trial.said, assess::PulseRhythm::irregular);
  EXPECT_NEAR(*trial.off_m, 0.004, 1e-9);
  EXPECT_NEAR(*trial.found_s, 5, 0.01);
  EXPECT_EQ(trial.shut_pct, 0);
}

TEST(PulseListener, AMarkInTheAirIsNoneAndAShortCountIsNoCount) {
  ListenedPulse one;
  one.run(1, PulsePart::find, 0);
  one.run(0.2, PulsePart::find, 0, true);
  EXPECT_EQ(one.listener_.marks(), 0);
  one.run(10, PulsePart::count, 1.2);
  EXPECT_FALSE(one.trial().delivered);
  EXPECT_FALSE(one.trial().off_m);
}

TEST(PulseListener, WhatIsPressedShutIsSaid) {
  ListenedPulse one;
  one.run(15, PulsePart::count, 1.2);
  one.run(7.5, PulsePart::count, 0.5);
  one.run(7.6, PulsePart::count, 0);
  EXPECT_NEAR(one.trial().shut_pct, 50, 1);
  EXPECT_NEAR(one.trial().off_line_pct, 25, 1);
}

}  // namespace
}  // namespace palpa::task_pulse

#include "apps/station/task_sections.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <functional>
#include <string>

#include "anatomy/base/error.h"
#include "apps/station/calibration_file.h"

namespace palpa::station {
namespace {

using nlohmann::json;

json twoStates() {
  return {{"states", 2},
          {"step_s", 0.01},
          {"least_speed_m_per_s", 1e-3},
          {"least_force_N", 0.02},
          {"least_shaking_N", 0.005},
          {"start", {0.25, 0.75}},
          {"move_from_state_1", {0.9, 0.1}},
          {"move_from_state_2", {0.2, 0.8}},
          {"mean_log_speed", {-6.0, -3.0}},
          {"variance_log_speed", {0.5, 0.7}}};
}

json taskWith(const json& learned, const json& condition = {{"cue", "learned"}, {"is", 2}}) {
  json task{{"subtasks", {{{"name", "go"}, {"means", "for a test"}, {"on", {condition}}}}},
            {"augmentations", json::array()},
            {"hysteresis", 0.05},
            {"limit_share", 0.5}};
  if (!learned.is_null()) task["learned"] = learned;
  return task;
}

/// What is said against it; empty: it is read.
std::string refusal(const json& task) {
  try {
    readPlan(JsonFile(task, "task.json"));
    return {};
  } catch (const UsageError& e) {
    return e.what();
  }
}

void expectRefused(const std::function<void(json*)>& change, const std::string& words) {
  json learned = twoStates();
  change(&learned);
  EXPECT_NE(refusal(taskWith(learned)).find(words), std::string::npos)
      << words << ": " << refusal(taskWith(learned));
}

CalibrationFile calibrated() {
  CalibrationFile file;
  file.kind = CalibrationKind::subtasks;
  file.station = "bench";
  file.date = "2026-03-01T12:30:00Z";
  file.made_by = "a test";
  file.valid_days = 10;
  file.verdict = "pass";
  const json model = twoStates();
  for (const auto& [name, value] : model.items())
    file.parameters.push_back({name, value.is_array() ? value.get<std::vector<double>>()
                                                      : std::vector<double>{value.get<double>()}});
  file.parameters.push_back({"kappa", {0.3}});
  return file;
}

struct Task {
  std::filesystem::path folder = std::filesystem::temp_directory_path() / "palpa-learned-model";
  Task() {
    std::filesystem::remove_all(folder);
    std::filesystem::create_directories(folder / "parts");
    std::ofstream(folder / "task.json") << taskWith("parts/calibration.json");
  }
  ~Task() { std::filesystem::remove_all(folder); }
  JsonFile read() const { return readTaskFile(folder / "task.json"); }
};

TEST(LearnedModel, ReadsWhatTheTickNeeds) {
  const haptics::AugmentationPlan plan =
      readPlan(JsonFile(taskWith(twoStates()), "task.json")).plan;
  const haptics::LearnedModel& m = plan.learned;
  ASSERT_EQ(m.states, 2u);
  EXPECT_EQ(m.start[1], 0.75);
  EXPECT_EQ(m.transition[1][0], 0.2);
  EXPECT_EQ(m.mean[1][haptics::kLogSpeed], -3.0);
  EXPECT_EQ(m.variance[0][haptics::kLogSpeed], 0.5);
  for (const int unused : {haptics::kLogForce, haptics::kInContact, haptics::kLogShaking})
    EXPECT_EQ(m.mean[0][static_cast<std::size_t>(unused)],
              m.mean[1][static_cast<std::size_t>(unused)]);
  EXPECT_EQ(plan.subtasks.each[0].conditions[0].signal, haptics::Signal::learned);
  EXPECT_EQ(plan.subtasks.each[0].conditions[0].threshold, 2);
  EXPECT_EQ(learnedIn(JsonFile(taskWith(nullptr), "task.json")).states, 0u);
}

TEST(LearnedModel, RefusesWhatCannotBe) {
  EXPECT_EQ(refusal(taskWith(twoStates())), "");
  expectRefused([](json* m) { (*m)["states"] = 9; }, "learned/states");
  expectRefused([](json* m) { (*m)["start"] = {0.25, 0.25}; }, "does not add up to 1");
  expectRefused([](json* m) { (*m)["move_from_state_2"] = {0.2, 0.9}; }, "move_from_state_2");
  expectRefused([](json* m) { m->erase("move_from_state_1"); }, "must be a list of 2 numbers");
  expectRefused([](json* m) { (*m)["variance_log_speed"] = {0.5, 0}; }, "which cannot be");
  expectRefused([](json* m) { (*m)["mean_log_speed"] = {0.5, "much"}; }, "which cannot be");
  expectRefused([](json* m) { m->erase("variance_log_speed"); }, "go together");
  expectRefused([](json* m) { (*m)["step_s"] = 0.02; }, "differs from this program's");
  expectRefused([](json* m) { *m = 3; }, "is not a model");
  EXPECT_NE(refusal(taskWith(nullptr)).find("has no \"learned\""), std::string::npos);
  EXPECT_NE(refusal(taskWith(twoStates(), {{"cue", "learned"}, {"is", 3}})).find("1 to 2"),
            std::string::npos);
  EXPECT_NE(refusal(taskWith(twoStates(), {{"cue", "learned"}, {"is", 0}})).find("1 to 2"),
            std::string::npos);
  EXPECT_NE(refusal(taskWith(twoStates(), {{"cue", "learned"}, {"at_least", 1}})).find("1 to 2"),
            std::string::npos);
}

TEST(LearnedModel, ATasksFileTakesTheModelIn) {
  const Task task;
  writeCalibration(calibrated(), task.folder / "parts/calibration.json");
  const JsonFile file = task.read();
  json expected = twoStates();
  expected["from"] = "calibration.json";
  EXPECT_EQ(file.json().at("learned"), expected);
  EXPECT_EQ(learnedIn(file).states, 2u);
}

TEST(LearnedModel, RefusesCalibrationsOfOtherThings) {
  const Task task;
  EXPECT_THROW(task.read(), Error);  // there is none
  CalibrationFile file = calibrated();
  file.verdict = "its two halves differ";
  writeCalibration(file, task.folder / "parts/calibration.json");
  EXPECT_THROW(task.read(), UsageError);
  file = calibrated();
  file.kind = CalibrationKind::latency;
  writeCalibration(file, task.folder / "parts/calibration.json");
  EXPECT_THROW(task.read(), UsageError);
}

}  // namespace
}  // namespace palpa::station

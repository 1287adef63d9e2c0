#include <gtest/gtest.h>

#include <fstream>
#include <map>

#include "anatomy/base/error.h"
#include "anatomy/base/json_text.h"
#include "apps/task_comparison/comparison_scene.h"
#include "tests/support/files.h"

namespace palpa::task_comparison {
namespace {

const std::string kTask = std::string(PALPA_SOURCE_DIR) + "/assets/tasks/squeeze.json";

TEST(ComparisonFile, TheShippedOneIsRead) {
  const ComparisonSettings s = readSqueeze(kTask);
  EXPECT_EQ(s.stiffness.size(), 6u);
  EXPECT_EQ(s.weight.size(), 6u);
  EXPECT_NEAR(s.mass, 0.02, 1e-12);
  EXPECT_FALSE(s.taxonomy.haptic.empty());
  EXPECT_GT(s.library.surface.k, 0);
}

std::string whyRefused(const nlohmann::json& change) {
  const std::filesystem::path folder = test::freshFolder("task_squeeze", "refused");
  nlohmann::json task = parseJson(test::slurp(kTask));
  task["lumps"] = (std::filesystem::path(kTask).parent_path() / task["lumps"]).string();
  task.merge_patch(change);
  std::ofstream(folder / "task.json") << task.dump();
  try {
    readSqueeze(folder / "task.json");
  } catch (const UsageError& e) {
    return e.what();
  }
  return "";
}

TEST(ComparisonFile, WhatIsNoComparisonIsRefusedByName) {
  const auto expectRefused = [](const nlohmann::json& compare, const std::string& words) {
    const std::string why = whyRefused({{"compare", compare}});
    EXPECT_NE(why.find(words), std::string::npos) << compare << ": " << why;
  };
  EXPECT_EQ(whyRefused(nlohmann::json::object()), "");
  for (const nlohmann::json& none :
       {nlohmann::json(7), nlohmann::json("text"), nlohmann::json(true)})
    expectRefused(none, "field \"compare\" must hold \"stiffness\" or \"weight\"");
  for (const nlohmann::json& wrong : {nlohmann::json(2), nlohmann::json::array({"2"})})
    expectRefused({{"weight", wrong}}, "field \"compare/weight\" is not a list of numbers");
  expectRefused({{"weight", {1}}}, "field \"compare/weight\" must hold numbers from 0.3 to 3");
}

TEST(ComparisonFile, EveryDifferenceAsOftenAndEveryOrder) {
  const ComparisonSettings s = readSqueeze(kTask);
  std::map<std::pair<int, std::array<double, 2>>, int> times;
  for (const Comparison& c : comparisonsOf(s, 3, 72))
    ++times[{static_cast<int>(c.property), c.factors}];
  EXPECT_EQ(times.size(), 24u);
  for (const auto& [which, count] : times) EXPECT_EQ(count, 3);
  const auto one = comparisonsOf(s, 3, 16), same = comparisonsOf(s, 3, 16),
             other = comparisonsOf(s, 4, 16);
  bool differs = false;
  for (std::size_t i = 0; i < 16; ++i) {
    EXPECT_EQ(one[i].factors, same[i].factors);
    differs = differs || one[i].factors != other[i].factors;
  }
  EXPECT_TRUE(differs);
  EXPECT_EQ(comparisonsOf(s, 3, 5).size(), 5u);
}

TEST(ComparisonFile, AComparisonIsWrittenAndReadAgain) {
  const Comparison c{assess::ComparedProperty::weight, {1, 1.43}},
      again = comparisonIn(comparisonText(c));
  EXPECT_EQ(again.property, c.property);
  EXPECT_EQ(again.factors, c.factors);
  EXPECT_THROW(comparisonIn("[]"), Error);
  EXPECT_THROW(comparisonIn("nonsense"), Error);
}

/// What both tools tell of a tick.
void hear(ComparisonListener& listener, const Comparison& comparison, int thing,
          std::int64_t t_ms, double real_N, double device_N) {
  haptics::FlightRecord r;
  r.t_ns = t_ms * 1'000'000;
  r.commands.trial = 1;
  r.commands.armed = 1;
  commandLoop(comparison, thing, &r.commands);
  r.sensed.state = haptics::SensorState::valid;
  for (const std::uint8_t tool : {0, 1}) {
    r.tool = tool;
    const double side = tool == 0 ? 1 : -1;
    r.sensed.f_D = {side * real_N, 0, 0};
    r.f_command_D = {side * device_N, 0, 0};
    listener.add(r);
  }
}

TEST(ComparisonListener, CountsGripsOfEachAndFeelsBothForces) {
  const Comparison c{assess::ComparedProperty::stiffness, {1, 1.5}};
  ComparisonListener listener(0.1);
  listener.begin(1, c);
  std::int64_t t = 0;
  for (int i = 0; i < 300; ++i) hear(listener, c, 0, ++t, 0.6, 0);
  EXPECT_TRUE(listener.held());
  for (int i = 0; i < 100; ++i) hear(listener, c, 0, ++t, 0.0, 0);
  EXPECT_FALSE(listener.held());
  for (int i = 0; i < 300; ++i) hear(listener, c, 1, ++t, 0.6, 0.3);
  for (int i = 0; i < 100; ++i) hear(listener, c, 1, ++t, 0.0, 0);
  for (int i = 0; i < 50; ++i) hear(listener, c, 1, ++t, 0.6, 0.3);  // a touch, no grip
  EXPECT_EQ(listener.grips(), (std::array<int, 2>{1, 1}));
  EXPECT_NEAR(listener.peak(), 0.9, 1e-12);
  EXPECT_NEAR(listener.seconds(), 0.849, 1e-9);
}

TEST(ComparisonListener, OneFingerIsNoGripAndAPauseIsNoTime) {
  const Comparison c;
  ComparisonListener listener(0.1);
  listener.begin(1, c);
  haptics::FlightRecord r;
  r.commands.trial = 1;
  r.commands.armed = 1;
  for (int i = 0; i < 500; ++i) {
    r.t_ns = 1'000'000LL * i;
    r.sensed.state = haptics::SensorState::valid;
    r.tool = 0;
    r.sensed.f_D = {0.6, 0, 0};
    listener.add(r);
    r.tool = 1;
    r.sensed.f_D = {0, 0, 0};
    listener.add(r);
  }
  EXPECT_EQ(listener.grips()[0] + listener.grips()[1], 0);
  EXPECT_EQ(listener.peak(), 0);
  const double seconds = listener.seconds();
  r.commands.armed = 0;
  r.t_ns += 60'000'000'000;
  listener.add(r);
  EXPECT_EQ(listener.seconds(), seconds);
}

/// 1 N of squeezing along x and 0.2 N of weight, shared; the devices add 0.3 N of each way.
std::array<ShownTool, 2> squeezing() {
  std::array<ShownTool, 2> tools;
  tools[0].X_AT.translation() = Vec3(0.03, 0, 0);
  tools[1].X_AT.translation() = Vec3(-0.03, 0, 0);
  tools[0].tool.f_sensed_D = {1, 0, -0.1};
  tools[1].tool.f_sensed_D = {-1, 0, -0.1};
  tools[0].tool.f_command_D = {0.3, 0, -0.15};
  tools[1].tool.f_command_D = {-0.3, 0, -0.15};
  return tools;
}

std::map<scene::ForceKind, Vec3> firstOnes(const std::vector<scene::ForceArrow>& arrows) {
  std::map<scene::ForceKind, Vec3> first;
  for (const scene::ForceArrow& arrow : arrows) first.emplace(arrow.kind, arrow.f_A);
  return first;
}

TEST(ComparisonForces, InASessionSqueezingAndWeightAreDrawnAsTheyAreFelt) {
  const std::vector<scene::ForceArrow> arrows = squeezeForces(squeezing(), false);
  ASSERT_EQ(arrows.size(), 4u) << "nothing that tells the devices' part";
  const auto first = firstOnes(arrows);
  EXPECT_LT((first.at(scene::ForceKind::reaction) - Vec3(1.3, 0, 0)).norm(), 1e-12);
  EXPECT_LT((first.at(scene::ForceKind::weight) - Vec3(0, 0, -0.25)).norm(), 1e-12);
  EXPECT_LT((arrows[2].f_A - Vec3(-1.3, 0, 0)).norm(), 1e-12) << "the second tool's";
}

TEST(ComparisonForces, ApartTheyAreTheRealThingsTheDevicesAndTheirSum) {
  const std::vector<scene::ForceArrow> arrows = squeezeForces(squeezing(), true);
  ASSERT_EQ(arrows.size(), 8u);
  const auto first = firstOnes(arrows);
  EXPECT_LT((first.at(scene::ForceKind::reaction) - Vec3(1, 0, 0)).norm(), 1e-12);
  EXPECT_LT((first.at(scene::ForceKind::weight) - Vec3(0, 0, -0.1)).norm(), 1e-12);
  EXPECT_LT((first.at(scene::ForceKind::device) - Vec3(0.3, 0, -0.15)).norm(), 1e-12);
  EXPECT_LT((first.at(scene::ForceKind::felt) - Vec3(1.3, 0, -0.25)).norm(), 1e-12);
}

TEST(ComparisonScene, WhatIsHeldMovesWithTheFingers) {
  const Vec3 middle(0, 0.03, 0), first(0.025, 0.03, 0.02), second(-0.025, 0.03, 0.02);
  EXPECT_LT((heldPlace(first, second, middle, true).translation() - Vec3(0, 0, 0.02)).norm(),
            1e-12);
  EXPECT_TRUE(heldPlace(first, second, middle, false).matrix().isIdentity());
}

}  // namespace
}  // namespace palpa::task_comparison

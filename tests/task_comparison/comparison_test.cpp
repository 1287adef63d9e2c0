#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>
#include <map>

#include "anatomy/base/error.h"
#include "anatomy/base/json_text.h"
#include "apps/task_comparison/comparison_scene.h"
#include "tests/support/files.h"

namespace palpa::task_comparison {
namespace {

const std::string kTasks = std::string(PALPA_SOURCE_DIR) + "/assets/tasks/",
                  kTask = kTasks + "squeeze.json", kStroked = kTasks + "friction.json";

TEST(ComparisonFile, TheShippedOneIsRead) {
  const ComparisonSettings s = readSqueeze(kTask);
  EXPECT_EQ(s.stiffness.size(), 6u);
  EXPECT_EQ(s.weight.size(), 6u);
  EXPECT_NEAR(s.mass, 0.02, 1e-12);
  EXPECT_FALSE(s.taxonomy.haptic.empty());
  EXPECT_GT(s.library.surface.k, 0);
}

std::string whyRefused(const nlohmann::json& change, const std::string& file = kTask) {
  const std::filesystem::path folder = test::freshFolder("task_comparison", "refused");
  nlohmann::json task = parseJson(test::slurp(file));
  task["lumps"] = (std::filesystem::path(file).parent_path() / task["lumps"]).string();
  task.merge_patch(change);
  std::ofstream(folder / "task.json") << task.dump();
  try {
    if (file == kTask)
      readSqueeze(folder / "task.json");
    else
      readFriction(folder / "task.json");
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
  std::map<std::pair<int, std::vector<double>>, int> times;
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
  EXPECT_THROW(comparisonIn(R"({"property": "colour", "factors": [1, 2]})"), Error);
  EXPECT_THROW(comparisonIn(R"({"property": "friction", "factors": [1]})"), Error);
}

TEST(FrictionFile, TheShippedOneIsReadAndWhatIsNoneIsRefusedByName) {
  const ComparisonSettings s = readFriction(kStroked);
  EXPECT_EQ(s.friction.size(), 6u);
  EXPECT_EQ(s.sorted.size(), 6u);
  EXPECT_EQ(s.sorts, 4);
  EXPECT_GT(s.sort_limit_s, s.time_limit_s);
  EXPECT_GT(s.library.friction.mu, 0);
  EXPECT_TRUE(s.stiffness.empty() && s.weight.empty());
  EXPECT_EQ(whyRefused(nlohmann::json::object(), kStroked), "");
  const std::pair<nlohmann::json, const char*> wrong[] = {
      {{{"compare", {{"friction", nlohmann::json::array()}}}}, "must hold \"friction\""},
      {{{"compare", {{"friction", {1}}}}}, "must hold numbers from 0.3 to 3, but not 1"},
      {{{"sort", {{"friction", {0.5, 1, 1, 2}}}}}, "has the same number twice"},
      {{{"sort", {{"friction", {0.1, 0.5, 1, 2}}}}}, "must hold numbers from 0.3 to 3"},
      {{{"sort", {{"friction", {0.5, 1, 2}}}}}, "at least as many numbers as"},
      {{{"engine", "squeeze"}}, "here it must be friction"}};
  for (const auto& [change, words] : wrong) {
    const std::string why = whyRefused(change, kStroked);
    EXPECT_NE(why.find(words), std::string::npos) << change << ": " << why;
  }
}

TEST(FrictionFile, SurfacesToSortAreDrawnWithoutRepeatAndAlikeForASeed) {
  const ComparisonSettings s = readFriction(kStroked);
  std::map<double, int> times;
  std::map<std::vector<double>, int> orders;
  for (const Comparison& c : sortingsOf(s, 3, 300)) {
    ASSERT_EQ(c.factors.size(), 4u);
    EXPECT_EQ(c.property, assess::ComparedProperty::friction);
    std::vector<double> rising = c.factors;
    std::sort(rising.begin(), rising.end());
    EXPECT_EQ(std::adjacent_find(rising.begin(), rising.end()), rising.end());
    for (const double factor : c.factors) ++times[factor];
    ++orders[c.factors];
  }
  ASSERT_EQ(times.size(), 6u);
  // 300 of 6 choose 4: each in 200 of them; four standard deviations of a binomial are 33.
  for (const auto& [factor, count] : times) EXPECT_NEAR(count, 200, 33) << factor;
  EXPECT_GT(orders.size(), 150u) << "of 360";
  EXPECT_EQ(sortingsOf(s, 3, 2)[1].factors, sortingsOf(s, 3, 5)[1].factors);
  EXPECT_NE(sortingsOf(s, 3, 2)[0].factors, sortingsOf(s, 4, 2)[0].factors);
}

TEST(FrictionFile, ComparisonsAreOfFrictionAndGoThroughCommandsAndText) {
  const ComparisonSettings s = readFriction(kStroked);
  for (const Comparison& c : comparisonsOf(s, 3, 12)) {
    EXPECT_EQ(c.property, assess::ComparedProperty::friction);
    EXPECT_EQ(comparisonIn(comparisonText(c)).factors, c.factors);
  }
  const Comparison four{assess::ComparedProperty::friction, {0.5, 2, 1, 1.4}};
  ComparisonListener listener(0.1, 1);
  listener.begin(1, four);
  for (int thing = 0; thing < 4; ++thing) {
    haptics::TickCommands commands;
    commandLoop(four, thing, &commands);
    EXPECT_EQ(listener.thing(commands), thing);
    EXPECT_EQ(commands.squeeze_stiffness, 1);
    EXPECT_EQ(commands.squeeze_weight, 1);
  }
}

/// What both tools tell of a tick.
void hear(ComparisonListener& listener, const Comparison& comparison, int thing, std::int64_t t_ms,
          double real_N, double device_N) {
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
  ComparisonListener listener(0.1, 2);
  listener.begin(1, c);
  std::int64_t t = 0;
  for (int i = 0; i < 300; ++i) hear(listener, c, 0, ++t, 0.6, 0);
  EXPECT_TRUE(listener.touching());
  for (int i = 0; i < 100; ++i) hear(listener, c, 0, ++t, 0.0, 0);
  EXPECT_FALSE(listener.touching());
  for (int i = 0; i < 300; ++i) hear(listener, c, 1, ++t, 0.6, 0.3);
  for (int i = 0; i < 100; ++i) hear(listener, c, 1, ++t, 0.0, 0);
  for (int i = 0; i < 50; ++i) hear(listener, c, 1, ++t, 0.6, 0.3);  // a touch, no grip
  EXPECT_EQ(listener.touches(), (std::vector<int>{1, 1}));
  EXPECT_NEAR(listener.peak(), 0.9, 1e-12);
  EXPECT_NEAR(listener.seconds(), 0.849, 1e-9);
}

TEST(ComparisonListener, OneFingerIsNoGripAndAPauseIsNoTime) {
  const Comparison c;
  ComparisonListener listener(0.1, 2);
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
  EXPECT_EQ(listener.allTouches(), 0);
  EXPECT_EQ(listener.peak(), 0);
  const double seconds = listener.seconds();
  r.commands.armed = 0;
  r.t_ns += 60'000'000'000;
  listener.add(r);
  EXPECT_EQ(listener.seconds(), seconds);
}

TEST(ComparisonListener, OfOneToolEachSurfacesTouchesAreItsOwn) {
  const Comparison four{assess::ComparedProperty::friction, {0.5, 2, 1, 1.4}};
  ComparisonListener listener(0.1, 1);
  listener.begin(1, four);
  haptics::FlightRecord r;
  r.commands.trial = 1;
  r.commands.armed = 1;
  r.sensed.state = haptics::SensorState::valid;
  const auto stroke = [&](int thing, int ms, double real_N, double device_N) {
    commandLoop(four, thing, &r.commands);
    r.sensed.f_D = {0, 0, real_N};
    r.f_command_D = {device_N, 0, 0};
    for (int i = 0; i < ms; ++i, r.t_ns += 1'000'000) listener.add(r);
  };
  for (const int thing : {0, 2, 3}) {
    stroke(thing, 300, 0.3, 0.4);
    stroke(thing, 100, 0, 0);
  }
  EXPECT_FALSE(listener.touchedAll());
  stroke(1, 50, 0.3, 0);  // too short
  stroke(1, 100, 0, 0);
  EXPECT_FALSE(listener.touchedAll());
  stroke(1, 200, 0.3, 0);
  EXPECT_TRUE(listener.touching());
  EXPECT_TRUE(listener.touchedAll());
  EXPECT_EQ(listener.touches(), (std::vector<int>{1, 1, 1, 1}));
  EXPECT_NEAR(listener.peak(), 0.5, 1e-12) << "of the surface and the device together";
}

TEST(Answer, IsReadFromItsEvents) {
  Answer two, order;
  two.add(2, false);
  EXPECT_EQ(two.more, 2);
  two.add(7, false);
  EXPECT_EQ(two.more, 0);
  for (const double number : {3.0, 1.0, 2.0}) order.add(number, true);
  EXPECT_EQ(order.order, (std::vector<int>{3, 1, 2}));
}

TEST(ComparisonScore, OfAnOrderHasTauAndIsAConditionOfItsOwn) {
  assess::ComparisonTrial facts;
  facts.outcome = training::Outcome::done;
  const Comparison four{assess::ComparedProperty::friction, {0.5, 2, 1, 1.4}};
  ComparisonListener listener(0.1, 1);
  listener.begin(1, four);
  const nlohmann::json score =
      parseJson(scoreJson(judged(facts, four, listener, {0, {1, 3, 2, 4}})));
  EXPECT_EQ(score.at("RIGHT"), 0);
  EXPECT_NEAR(score.at("TAU").get<double>(), 4.0 / 6, 1e-12);
  EXPECT_EQ(score.at("ORDER"), (std::vector<int>{1, 3, 2, 4}));
  EXPECT_EQ(score.at("TOUCHES"), (std::vector<int>{0, 0, 0, 0}));
  EXPECT_EQ(score.at("MODE"), "put in order");
  EXPECT_FALSE(parseJson(scoreJson(judged(facts, four, listener, {}))).contains("TAU"));
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

/// Pressed with 1 N, rubbed with 0.3 N to the left; the device adds 0.3 N to that.
TEST(StrokeForces, WhatPressesAndWhatRubsAsFeltAndApart) {
  ShownTool tool;
  tool.tool.f_sensed_D = {-0.3, 0, 1};
  tool.tool.f_command_D = {-0.3, 0, 0};
  const auto felt = strokeForces(tool, Vec3::UnitZ(), false),
             apart = strokeForces(tool, Vec3::UnitZ(), true);
  ASSERT_EQ(felt.size(), 2u) << "nothing that tells the device's part";
  EXPECT_EQ(felt[0].kind, scene::ForceKind::reaction);
  EXPECT_LT((felt[0].f_A - Vec3(0, 0, 1)).norm(), 1e-12);
  EXPECT_LT((felt[1].f_A - Vec3(-0.6, 0, 0)).norm(), 1e-12);
  ASSERT_EQ(apart.size(), 4u);
  const auto first = firstOnes(apart);
  EXPECT_LT((first.at(scene::ForceKind::friction) - Vec3(-0.3, 0, 0)).norm(), 1e-12);
  EXPECT_LT((first.at(scene::ForceKind::device) - Vec3(-0.3, 0, 0)).norm(), 1e-12);
  EXPECT_LT((first.at(scene::ForceKind::felt) - Vec3(-0.6, 0, 1)).norm(), 1e-12);
}

TEST(ComparisonScene, AsksForWhatIsToBeAnswered) {
  ComparisonStatus status;
  status.property = assess::ComparedProperty::friction;
  status.thing = 1;
  EXPECT_EQ(questionText(status), "Which one is rougher? The second");
  status.things = 4;
  EXPECT_EQ(questionText(status), "From the smoothest to the roughest: surface 2 of 4");
  status.order = {3, 1};
  EXPECT_EQ(questionText(status),
            "From the smoothest to the roughest: surface 2 of 4; said so far 3, 1");
}

TEST(ComparisonScene, WhatIsHeldMovesWithTheFingers) {
  const Vec3 middle(0, 0.03, 0), first(0.025, 0.03, 0.02), second(-0.025, 0.03, 0.02);
  EXPECT_LT((heldPlace(first, second, middle, true).translation() - Vec3(0, 0, 0.02)).norm(),
            1e-12);
  EXPECT_TRUE(heldPlace(first, second, middle, false).matrix().isIdentity());
}

}  // namespace
}  // namespace palpa::task_comparison

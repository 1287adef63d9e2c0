#include "apps/station/task_sections.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include "anatomy/base/error.h"
#include "anatomy/geometry/local_geometry.h"
#include "apps/station/station_file.h"
#include "haptics/flight_record.h"

namespace palpa::station {
namespace {

using haptics::Augmentation;
using haptics::AugmentationKind;
using haptics::Condition;
using haptics::Signal;
using nlohmann::json;
using Trigger = Augmentation::Trigger;
using Way = Augmentation::Way;

json conditionOf(const char* cue, const char* compare, const json& value) {
  return {{"cue", cue}, {compare, value}};
}

json partOf(const char* name, const json& conditions) {
  return {{"name", name}, {"means", "for a test"}, {"on", conditions}};
}

/// Of the part "go", pushing; with what is given besides.
json addedOf(const char* kind, const json& more = json::object()) {
  json added{{"name", "added"}, {"means", "for a test"}, {"kind", kind},
             {"subtask", "go"}, {"way", "up"},           {"force_N", 2}};
  added.update(more);
  return added;
}

json planWith(const json& augmentations) {
  return {{"subtasks",
           json::array({partOf("go", json::array({conditionOf("floor_speed", "at_least", 400)}))})},
          {"augmentations", augmentations},
          {"hysteresis", 0.05},
          {"limit_share", 0.5}};
}

NamedPlan planIn(const json& task) { return readPlan(JsonFile(task, "task.json")); }

Augmentation onlyOne(const char* kind, const json& more) {
  return planIn(planWith(json::array({addedOf(kind, more)}))).plan.each[0];
}

Condition onlyCondition(const json& condition) {
  json task = planWith(json::array());
  task["subtasks"][0]["on"] = json::array({condition});
  return planIn(task).plan.subtasks.each[0].conditions[0];
}

TEST(AugmentationPlan, TheShippedSearchReadsAsItIsStated) {
  const NamedPlan named =
      readPlan(JsonFile(std::filesystem::path(PALPA_SOURCE_DIR) / "assets/tasks/search.json"));
  const haptics::AugmentationPlan& plan = named.plan;
  ASSERT_EQ(named.subtasks.size(), 3u);
  ASSERT_EQ(named.augmentations.size(), 3u);
  ASSERT_EQ(plan.subtasks.count, 3u);
  ASSERT_EQ(plan.count, 3u);
  EXPECT_EQ(named.limit_share, 0.5);
  EXPECT_FALSE(named.empty());
  struct Stated {
    const char* part;
    std::vector<Condition> on;
  };
  constexpr auto kAtLeast = Condition::Compare::at_least;
  const std::vector<Stated> stated{
      {"scan", {{Signal::floor_speed, kAtLeast, 100, {}, 468.75, 0.05}}},
      {"shape",
       {{Signal::floor_speed, Condition::Compare::below, 0, 100, 468.75, 0.05},
        {Signal::floor_contact, kAtLeast, 100, {}, 1, 0.05}}},
      {"identify",
       {{Signal::floor_contact, kAtLeast, 100, {}, 1, 0.05},
        {Signal::floor_texture, kAtLeast, 100, {}, 1, 0.05},
        {Signal::floor_speed, kAtLeast, 100, {}, 400, 0.05}}}};
  for (std::size_t i = 0; i < 3; ++i) {
    EXPECT_EQ(named.subtasks[i].name, stated[i].part);
    EXPECT_FALSE(named.subtasks[i].means.empty());
    ASSERT_EQ(plan.subtasks.each[i].count, stated[i].on.size());
    for (std::size_t k = 0; k < stated[i].on.size(); ++k) {
      const Condition &read = plan.subtasks.each[i].conditions[k], &want = stated[i].on[k];
      EXPECT_EQ(read.signal, want.signal) << i << k;
      EXPECT_EQ(read.compare, want.compare) << i << k;
      EXPECT_EQ(read.threshold, want.threshold) << i << k;
      EXPECT_EQ(read.hysteresis, want.hysteresis) << i << k;
      EXPECT_EQ(read.hold_ms, want.hold_ms) << i << k;
      EXPECT_EQ(read.after_ms, want.after_ms) << i << k;
    }
  }
  const Augmentation &edge = plan.each[0], &valley = plan.each[1], &bump = plan.each[2];
  EXPECT_EQ(named.augmentations[0].name, "edge");
  EXPECT_EQ(edge.kind, AugmentationKind::pulse);
  EXPECT_EQ(edge.trigger, Trigger::rise);
  EXPECT_EQ(edge.way, Way::up);
  EXPECT_EQ(edge.amplitude, 0.8);
  EXPECT_DOUBLE_EQ(edge.width_s, 0.010);
  EXPECT_EQ(valley.kind, AugmentationKind::attraction);
  EXPECT_EQ(valley.amplitude, 10);
  EXPECT_EQ(named.reach_U, (std::vector<double>{0, 5, 0}));
  EXPECT_EQ(bump.kind, AugmentationKind::relief);
  EXPECT_EQ(bump.trigger, Trigger::bump);
  EXPECT_EQ(bump.amplitude, 0.8);
  for (std::uint8_t i = 0; i < 3; ++i) EXPECT_EQ(plan.each[i].subtask, i);
}

TEST(AugmentationPlan, ATaskWithoutPartsHasNone) {
  const NamedPlan named = planIn({{"limit_share", 0.3}});
  EXPECT_TRUE(named.empty());
  EXPECT_EQ(named.plan.count + named.plan.subtasks.count, 0u);
}

TEST(AugmentationPlan, EveryKindWithItsFields) {
  const Augmentation pulse = onlyOne(
      "pulse", {{"trigger", "begin"}, {"width_ms", 12}, {"way", "along_tool"}, {"blend_ms", 5}});
  EXPECT_EQ(pulse.kind, AugmentationKind::pulse);
  EXPECT_EQ(pulse.amplitude, 2);
  EXPECT_DOUBLE_EQ(pulse.width_s, 0.012);
  EXPECT_EQ(pulse.way, Way::along_tool);
  EXPECT_DOUBLE_EQ(pulse.blend_s, 0.005);
  EXPECT_EQ(pulse.subtask, 0);
  const Augmentation hum = onlyOne("vibration", {{"frequency_Hz", 80}, {"way", "against_motion"}});
  EXPECT_EQ(hum.kind, AugmentationKind::vibration);
  EXPECT_EQ(hum.frequency_Hz, 80);
  EXPECT_EQ(hum.wavelength, 0);
  EXPECT_EQ(hum.way, Way::against_motion);
  EXPECT_EQ(hum.trigger, Trigger::none);
  const Augmentation grating =
      onlyOne("vibration", {{"wavelength_mm", 1.5}, {"trigger", "bump"}, {"decay_ms", 40}});
  EXPECT_DOUBLE_EQ(grating.wavelength, 0.0015);
  EXPECT_DOUBLE_EQ(grating.tau_s, 0.040);
  const Augmentation pull = onlyOne("attraction", {{"reach_mm", 3}});
  EXPECT_EQ(pull.kind, AugmentationKind::attraction);
  EXPECT_EQ(pull.amplitude, 2);
  EXPECT_DOUBLE_EQ(pull.reach, 0.003);
  const Augmentation more = onlyOne("exaggeration", {{"times", 1.5}, {"tau_ms", 30}});
  EXPECT_EQ(more.kind, AugmentationKind::exaggeration);
  EXPECT_EQ(more.amplitude, 1.5);
  EXPECT_DOUBLE_EQ(more.tau_s, 0.030);
  const Augmentation line = onlyOne("fixture", {{"stiffness_N_per_m", 300}});
  EXPECT_EQ(line.kind, AugmentationKind::fixture);
  EXPECT_EQ(line.amplitude, 300);
  EXPECT_EQ(line.reach + line.fades, 0);
  const Augmentation guide =
      onlyOne("fixture", {{"stiffness_N_per_m", 150}, {"reach_mm", 15}, {"fades", true}});
  EXPECT_DOUBLE_EQ(guide.reach * guide.fades, 0.015);
  const Augmentation wall = onlyOne("keep_out", {{"stiffness_N_per_m", 600}, {"fades", true}});
  EXPECT_EQ(wall.kind, AugmentationKind::keep_out);
  EXPECT_EQ(wall.amplitude * wall.fades, 600);
  const Augmentation steady =
      onlyOne("steadying", {{"damping_Ns_per_m", 20}, {"from_Hz", 8}, {"to_Hz", 12}});
  EXPECT_EQ(steady.kind, AugmentationKind::steadying);
  EXPECT_EQ(steady.amplitude, 20);
  EXPECT_EQ(steady.to_Hz - steady.from_Hz, 4);
  const Augmentation relief = onlyOne("relief", {{"way", "against_tool"}, {"subtask", "any"}});
  EXPECT_EQ(relief.kind, AugmentationKind::relief);
  EXPECT_EQ(relief.amplitude, 2);
  EXPECT_EQ(relief.trigger, Trigger::bump);
  EXPECT_EQ(relief.way, Way::against_tool);
  EXPECT_EQ(relief.subtask, haptics::kAnySubtask);
}

TEST(AugmentationPlan, EveryTriggerByItsName) {
  const auto triggered = [](const char* name) {
    return onlyOne("pulse", {{"trigger", name}, {"width_ms", 10}});
  };
  EXPECT_EQ(triggered("begin").trigger, Trigger::begin);
  EXPECT_EQ(triggered("rise").trigger, Trigger::rise);
  EXPECT_EQ(triggered("bump").trigger, Trigger::bump);
  const std::pair<const char*, std::uint32_t> events[]{{"skin_punctured", haptics::kSkinPunctured},
                                                       {"withdrawn", haptics::kWithdrawn},
                                                       {"wall_punctured", haptics::kWallPunctured},
                                                       {"bone_touched", haptics::kBoneTouched},
                                                       {"bone_left", haptics::kBoneLeft}};
  for (const auto& [name, bit] : events) {
    EXPECT_EQ(triggered(name).trigger, Trigger::event) << name;
    EXPECT_EQ(triggered(name).events, bit) << name;
  }
}

TEST(AugmentationPlan, ConditionsAreInTheUnitsOfTheirCues) {
  const Condition edge = onlyCondition(conditionOf("lump_edge", "below", -4));
  EXPECT_EQ(edge.signal, Signal::lump_edge);
  EXPECT_EQ(edge.compare, Condition::Compare::below);
  EXPECT_DOUBLE_EQ(edge.threshold, -0.004);
  EXPECT_EQ(edge.hysteresis, 0.05);
  EXPECT_EQ(onlyCondition(conditionOf("wall_force", "at_least", 0.5)).threshold, 0.5);
  const Condition inserted = onlyCondition(conditionOf("phase", "is", "inserted"));
  EXPECT_EQ(inserted.compare, Condition::Compare::equal);
  EXPECT_EQ(inserted.threshold, static_cast<double>(haptics::NeedlePhase::inserted));
  EXPECT_EQ(onlyCondition(conditionOf("tissue", "is", "muscle")).threshold,
            static_cast<double>(Tissue::muscle));
  EXPECT_EQ(onlyCondition(conditionOf("part", "is", 2)).threshold, 2);
}

/// Refused in words that name the field and what stands there.
void expectNamed(const json& task, const std::string& field, const std::string& said = "") {
  try {
    planIn(task);
    ADD_FAILURE() << field << ' ' << said << " was taken for valid";
  } catch (const UsageError& e) {
    const std::string text = e.what();
    EXPECT_NE(text.find("\"" + field + "\""), std::string::npos) << text;
    EXPECT_NE(text.find(said), std::string::npos) << text;
    EXPECT_NE(text.find("task.json"), std::string::npos) << text;
  }
}

void expectNamedIn(const char* kind, const json& more, const std::string& field,
                   const std::string& said = "") {
  expectNamed(planWith(json::array({addedOf(kind, more)})), field, said);
}

TEST(AugmentationPlan, WordsThatAreNoneAreNamed) {
  expectNamedIn("kick", json::object(), "kind", "kick");
  expectNamedIn("none", json::object(), "kind", "none");
  expectNamedIn("pulse", {{"trigger", "whim"}, {"width_ms", 10}}, "trigger", "whim");
  expectNamedIn("pulse", {{"trigger", "rise"}, {"width_ms", 10}, {"way", "sideways"}}, "way",
                "sideways");
  expectNamedIn("pulse", {{"trigger", "rise"}, {"width_ms", 10}, {"subtask", "sleep"}}, "subtask",
                "sleep");
  json task = planWith(json::array());
  task["subtasks"][0]["on"] = json::array({conditionOf("smell", "at_least", 1)});
  expectNamed(task, "cue", "smell");
  task["subtasks"][0]["on"] = json::array({conditionOf("none", "at_least", 1)});
  expectNamed(task, "cue", "none");
  task["subtasks"][0]["on"] = json::array({conditionOf("phase", "is", "asleep")});
  expectNamed(task, "is", "asleep");
  task["subtasks"][0]["on"] = json::array({conditionOf("depth", "is", "muscle")});
  expectNamed(task, "is", "depth");
  task["subtasks"][0]["on"] = json::array({conditionOf("speed", "about", 1)});
  expectNamed(task, "cue", "at_least");
}

TEST(AugmentationPlan, WhatIsMissingIsNamed) {
  expectNamedIn("pulse", {{"width_ms", 10}}, "kind", "trigger");
  expectNamedIn("pulse", {{"trigger", "rise"}}, "width_ms");
  expectNamedIn("vibration", json::object(), "frequency_Hz");
  expectNamedIn("vibration", {{"frequency_Hz", 80}, {"trigger", "rise"}}, "decay_ms");
  expectNamedIn("attraction", json::object(), "reach_mm");
  expectNamedIn("exaggeration", {{"tau_ms", 30}}, "times");
  expectNamedIn("exaggeration", {{"times", 2}}, "tau_ms");
  expectNamedIn("fixture", json::object(), "stiffness_N_per_m");
  expectNamedIn("keep_out", json::object(), "stiffness_N_per_m");
  expectNamedIn("steadying", {{"from_Hz", 8}, {"to_Hz", 12}}, "damping_Ns_per_m");
  expectNamedIn("steadying", {{"damping_Ns_per_m", 9}, {"from_Hz", 8}, {"to_Hz", 8}}, "to_Hz",
                "more than");
  for (const char* kind : {"vibration", "attraction", "relief"}) {
    json task = planWith(json::array({addedOf(kind, {{"frequency_Hz", 80}, {"reach_mm", 3}})}));
    task["augmentations"][0].erase("force_N");
    expectNamed(task, "force_N");
  }
  for (const char* field : {"kind", "subtask", "name", "means"}) {
    json task = planWith(json::array({addedOf("relief")}));
    task["augmentations"][0].erase(field);
    expectNamed(task, field);
  }
  for (const char* field : {"name", "means"}) {
    json task = planWith(json::array());
    task["subtasks"][0].erase(field);
    expectNamed(task, field);
  }
  for (const char* kind : {"pulse", "vibration", "relief"}) {
    json task = planWith(json::array({addedOf(
        kind, {{"frequency_Hz", 80}, {"trigger", "begin"}, {"width_ms", 10}, {"decay_ms", 10}})}));
    task["augmentations"][0].erase("way");
    expectNamed(task, "way");
  }
  expectNamedIn("vibration", {{"frequency_Hz", 80}, {"decay_ms", 10}}, "decay_ms", "trigger");
  expectNamed({{"augmentations", json::array()}, {"limit_share", 0.5}}, "augmentations",
              "subtasks");
  expectNamedIn("relief", {{"trigger", "rise"}}, "trigger", "no meaning");
  expectNamedIn("pulse", {{"trigger", "begin"}, {"width_ms", 10}, {"subtask", "any"}}, "trigger",
                "of no part");
  for (const char* field : {"limit_share", "hysteresis"}) {
    json task = planWith(json::array());
    task.erase(field);
    expectNamed(task, field);
  }
}

TEST(AugmentationPlan, FiguresOutOfAllProportionAreNamed) {
  expectNamedIn("relief", {{"force_N", 1e9}}, "force_N");
  expectNamedIn("relief", {{"force_N", -1}}, "force_N");
  expectNamedIn("relief", {{"blend_ms", -1}}, "blend_ms");
  expectNamedIn("pulse", {{"trigger", "rise"}, {"width_ms", 0}}, "width_ms");
  expectNamedIn("vibration", {{"frequency_Hz", 5000}}, "frequency_Hz");
  expectNamedIn("vibration", {{"wavelength_mm", 0}}, "wavelength_mm");
  expectNamedIn("attraction", {{"reach_U", 0}}, "reach_U");
  expectNamedIn("exaggeration", {{"times", 50}, {"tau_ms", 30}}, "times");
  expectNamedIn("fixture", {{"stiffness_N_per_m", 1e9}}, "stiffness_N_per_m");
  json task = planWith(json::array());
  task["limit_share"] = 1.1;
  expectNamed(task, "limit_share");
  task["limit_share"] = 0.5;
  task["hysteresis"] = 1;
  expectNamed(task, "hysteresis");
}

TEST(AugmentationPlan, TooManyOrNoneAreNamed) {
  const json relief = addedOf("relief"), condition = conditionOf("speed", "at_least", 1);
  const json part = planWith(json::array())["subtasks"][0];
  EXPECT_EQ(planIn(planWith(json(haptics::kMostAugmentations, relief))).plan.count,
            haptics::kMostAugmentations);
  expectNamed(planWith(json(haptics::kMostAugmentations + 1, relief)), "augmentations");
  json task = planWith(json::array());
  task["subtasks"] = json(haptics::kMostSubtasks, part);
  EXPECT_EQ(planIn(task).plan.subtasks.count, haptics::kMostSubtasks);
  task["subtasks"] = json(haptics::kMostSubtasks + 1, part);
  expectNamed(task, "subtasks");
  task = planWith(json::array());
  task["subtasks"][0]["on"] = json(haptics::kMostConditions, condition);
  EXPECT_EQ(planIn(task).plan.subtasks.each[0].count, haptics::kMostConditions);
  task["subtasks"][0]["on"] = json(haptics::kMostConditions + 1, condition);
  expectNamed(task, "on");
  task["subtasks"][0]["on"] = json::array();
  expectNamed(task, "on");
}

TEST(AugmentationPlan, OnADeviceItHasItsLimitsAndLengths) {
  const NamedPlan named = planIn(planWith(json::array({addedOf("attraction", {{"reach_U", 5}}),
                                                       addedOf("attraction", {{"reach_mm", 3}}),
                                                       addedOf("relief", {{"force_N", 30}})})));
  Station station;
  station.safety.max_force_N = 15;
  station.device.capabilities.stable_stiffness = 50'000;
  station.coupling.stiffness = 5250;
  const haptics::AugmentationPlan plan = onDevice(named, station, 60e-6);
  EXPECT_DOUBLE_EQ(plan.largest, 7.5);
  EXPECT_EQ(plan.steepest, 50'000) << "as steep as the device holds, whatever the floor is";
  EXPECT_DOUBLE_EQ(plan.each[0].reach, 300e-6);
  EXPECT_DOUBLE_EQ(plan.each[1].reach, 0.003);
  EXPECT_EQ(plan.each[2].amplitude, 30) << "what one alone is told; all together are bounded";
  EXPECT_DOUBLE_EQ(onDevice(named, station, 250e-6).each[0].reach, 1.25e-3);
  station.safety.max_force_N = 8;
  EXPECT_DOUBLE_EQ(onDevice(named, station, 60e-6).largest, 4);
  EXPECT_THROW(onDevice(named, station), UsageError) << "units of no floor";
}

}  // namespace
}  // namespace palpa::station

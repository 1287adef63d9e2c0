#include "apps/task_search/floors.h"

#include <gtest/gtest.h>

#include <array>
#include <nlohmann/json.hpp>
#include <numbers>
#include <set>

#include "anatomy/base/error.h"
#include "tests/task_search/shipped_search.h"

namespace palpa::task_search {
namespace {

using assess::SearchMode;

TEST(Episodes, TheSameSeedGivesTheSameStimuliInEveryMode) {
  const auto real = episodesOf(5, 40, SearchMode::real),
             degraded = episodesOf(5, 40, SearchMode::degraded),
             other = episodesOf(6, 40, SearchMode::real);
  int same = 0;
  std::array<int, 3> targets{};
  for (std::size_t i = 0; i < real.size(); ++i) {
    EXPECT_EQ(real[i].stimulus.orientation, degraded[i].stimulus.orientation);
    EXPECT_EQ(real[i].stimulus.target, degraded[i].stimulus.target);
    EXPECT_EQ(degraded[i].mode, SearchMode::degraded);
    EXPECT_GE(real[i].stimulus.orientation, 0);
    EXPECT_LT(real[i].stimulus.orientation, 2 * std::numbers::pi / 3);
    same += real[i].stimulus.orientation == other[i].stimulus.orientation;
    ++targets.at(static_cast<std::size_t>(real[i].stimulus.target));
  }
  EXPECT_EQ(same, 0);
  for (const int t : targets) EXPECT_GT(t, 4);
}

TEST(Episodes, BumpsAreMadeOnceForASession) {
  const SearchSettings task = shippedSearch();
  const auto episodes = episodesOf(5, 2, SearchMode::real);
  const haptics::SearchSurface a = surfaceOf(task.spec, episodes[0]),
                               b = surfaceOf(task.spec, episodes[1]);
  const auto& first = a.texture(a.stimulus().target).bumps();
  const auto& second = b.texture(b.stimulus().target).bumps();
  ASSERT_EQ(first.size(), second.size());
  for (std::size_t i = 0; i < first.size(); ++i) {
    EXPECT_EQ(first[i].x, second[i].x);
    EXPECT_EQ(first[i].y, second[i].y);
  }
}

TEST(Episodes, BlocksAreTheStudysAndNoStimulusComesTwice) {
  const SearchSettings task = shippedSearch();
  const auto all = blocksOf(task, 3, SearchMode::augmented);
  ASSERT_EQ(all.size(), 160u);
  EXPECT_EQ(all[0].block, "baseline");
  EXPECT_EQ(all[59].mode, SearchMode::real);
  EXPECT_EQ(all[60].block, "training");
  EXPECT_EQ(all[60].mode, SearchMode::augmented);
  EXPECT_EQ(all[99].mode, SearchMode::augmented);
  EXPECT_EQ(all[100].block, "evaluation");
  EXPECT_EQ(all[159].mode, SearchMode::real);
  std::set<double> orientations;
  for (const Episode& e : all) orientations.insert(e.stimulus.orientation);
  EXPECT_EQ(orientations.size(), all.size());
}

TEST(Episodes, AreReadAsTheyWereWritten) {
  const Episode e = episodesOf(5, 1, SearchMode::augmented)[0];
  const Episode again = episodeIn(episodeText(e));
  EXPECT_EQ(again.stimulus.orientation, e.stimulus.orientation);
  EXPECT_EQ(again.stimulus.target, e.stimulus.target);
  EXPECT_EQ(again.seed, e.seed);
  EXPECT_EQ(again.mode, e.mode);
  for (const char* damaged :
       {"", "{}", "[1]", R"({"block":"","mode":"odd","orientation":0,"target":0,"seed":1})",
        R"({"block":"","mode":"real","orientation":0,"target":3,"seed":1})"})
    EXPECT_THROW(episodeIn(damaged), Error) << damaged;
}

TEST(SearchFile, WhatIsShippedIsTheSource) {
  const SearchSettings s = shippedSearch();
  EXPECT_EQ(s.spec.side, 240);
  EXPECT_NEAR(s.spec.circle, 200.0 / 3, 1e-12);
  EXPECT_EQ(s.spec.target.spacing, 7);
  EXPECT_EQ(s.spec.distractor.jitter, 2.4);
  EXPECT_EQ(s.rendering.real.stiffness, 5250);
  EXPECT_EQ(s.rendering.real.damping, 20);
  EXPECT_EQ(s.dwell_s, 0.5);
  ASSERT_EQ(s.augmentations.subtasks.size(), 3u);
  EXPECT_EQ(s.augmentations.plan.subtasks.each[0].conditions[0].threshold, 468.75);
  EXPECT_EQ(s.augmentations.plan.subtasks.each[2].conditions[2].threshold, 400);
  EXPECT_EQ(s.augmentations.plan.subtasks.each[0].conditions[0].hysteresis, 0.05);
  EXPECT_EQ(s.augmentations.plan.each[1].amplitude, 10);
  EXPECT_EQ(s.augmentations.reach_U[1], 5);
}

TEST(SearchFile, OnADeviceThatHoldsLessRealIsWhatItHoldsAndDegradedAFifth) {
  const SearchSettings s = shippedSearch();
  station::Station station = station::readStation(station::assetFile("stations/search_bench.json"));
  EXPECT_EQ(renderingOn(s, station).real.stiffness, 5250);
  EXPECT_EQ(renderingOn(s, station).degraded.stiffness, 1050);
  EXPECT_EQ(renderingOn(s, station).degraded.damping, 4);
  station.coupling.stiffness = 1000;
  EXPECT_EQ(renderingOn(s, station).real.stiffness, 1000);
  EXPECT_NEAR(renderingOn(s, station).degraded.stiffness, 200, 1e-9);
  station.floor.reset();
  EXPECT_THROW(renderingOn(s, station), UsageError);
}

/// The shipped task with one field changed.
void refuses(const std::string& pointer, const nlohmann::json& value, const std::string& named) {
  nlohmann::json json = JsonFile(station::assetFile("tasks/search.json")).json();
  json[nlohmann::json::json_pointer(pointer)] = value;
  try {
    readSearch(JsonFile(json, "task.json"));
    ADD_FAILURE() << pointer;
  } catch (const UsageError& e) {
    EXPECT_NE(std::string(e.what()).find(named), std::string::npos) << e.what();
  }
}

TEST(SearchFile, WhatCannotBeMeantIsNamed) {
  refuses("/engine", "needle", "engine");
  refuses("/stimulus/side_U/value", 1e9, "side_U");
  refuses("/stimulus/distractor/jitter_U", 100, "too many bumps");
  refuses("/rises/map_px/value", 1001, "map_px");
  refuses("/subtasks/0/on/0/cue", "smell", "smell");
  refuses("/subtasks/0/on", nlohmann::json::array(), "on");
  refuses("/augmentations/0/kind", "kick", "kick");
  refuses("/augmentations/0/subtask", "sleep", "sleep");
  refuses("/augmentations/0/trigger", "whim", "whim");
  refuses("/augmentations/0/force_N", 1e9, "force_N");
  refuses("/limit_share/value", 7, "limit_share");
  refuses("/blocks/0/episodes", 0, "episodes");
}

}  // namespace
}  // namespace palpa::task_search

#include "apps/console/task_choices.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "anatomy/base/error.h"

/// What an educator may choose of each shipped task, and the command that follows.
namespace palpa::console {
namespace {

SessionWish wishOf(const std::string& task) {
  SessionWish wish;
  wish.task = task;
  wish.performer = "expert";
  return wish;
}

bool has(const std::vector<std::string>& arguments, const std::string& one) {
  return std::find(arguments.begin(), arguments.end(), one) != arguments.end();
}

bool offers(const std::string& task, const std::string& option) {
  const nlohmann::json all = described(taskChoice(task)).at("options");
  return std::find(all.begin(), all.end(), option) != all.end();
}

std::size_t surfacesOf(const std::string& task) {
  return described(taskChoice(task)).at("surfaces").size();
}

TEST(TaskChoices, TheNeedleComesFirstAndEachTaskSaysWhatItIs) {
  const std::vector<TaskChoice> all = taskChoices();
  ASSERT_GE(all.size(), 15u);
  EXPECT_EQ(all.front().id, "paracentesis");
  for (const TaskChoice& task : all) {
    EXPECT_GT(described(task).at("about").get<std::string>().size(), 20u) << task.id;
    const auto arguments = argumentsOf(task, wishOf(task.id));
    EXPECT_TRUE(has(arguments, task.file.string())) << task.id;
    EXPECT_FALSE(has(arguments, "--tools")) << "as the task has it";
    EXPECT_FALSE(has(arguments, "--surface"));
  }
  EXPECT_THROW(taskChoice("nothing"), UsageError);
}

TEST(TaskChoices, WhatATaskCannotDoIsNotOffered) {
  EXPECT_TRUE(offers("palpation-breast", "fingers"));
  EXPECT_FALSE(offers("palpation-neck", "fingers")) << "its top is curved";
  EXPECT_FALSE(offers("palpation-taken", "fingers"));
  EXPECT_FALSE(offers("paracentesis", "fingers"));
  EXPECT_TRUE(offers("paracentesis", "patient_seed"));
  EXPECT_FALSE(offers("bone_pin", "patient_seed")) << "a block is no patient";
  EXPECT_EQ(surfacesOf("palpation-breast"), 4u);
  EXPECT_EQ(surfacesOf("friction"), 4u);
  EXPECT_EQ(surfacesOf("pulse"), 4u);
  EXPECT_EQ(surfacesOf("palpation-taken"), 0u) << "its lump lies in one silicone";
  EXPECT_EQ(surfacesOf("squeeze"), 0u);
  EXPECT_EQ(surfacesOf("paracentesis"), 0u);
}

TEST(TaskChoices, WhatIsChosenIsInTheCommand) {
  SessionWish wish = wishOf("palpation-breast");
  wish.fingers = 2;
  wish.surface = "oiled gel";
  auto arguments = argumentsOf(taskChoice(wish.task), wish);
  EXPECT_TRUE(has(arguments, "--tools"));
  EXPECT_TRUE(has(arguments, "oiled gel"));
  for (const char* none : {"gel", "--fast", "ribs"}) {
    wish.surface = none;
    EXPECT_THROW(argumentsOf(taskChoice(wish.task), wish), UsageError) << none;
  }
  wish = wishOf("paracentesis");
  wish.side = "left";
  wish.fingers = 2;
  arguments = argumentsOf(taskChoice(wish.task), wish);
  EXPECT_TRUE(has(arguments, "left"));
  EXPECT_FALSE(has(arguments, "--tools")) << "it has no fingers";
}

}  // namespace
}  // namespace palpa::console

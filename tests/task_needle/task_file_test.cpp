#include "apps/task_needle/task_file.h"

#include <gtest/gtest.h>

#include "anatomy/base/error.h"
#include "apps/station/assets.h"

/// A task read from its file, and from the text that a recording keeps of it.
namespace palpa::task_needle {
namespace {

TaskSettings fromText(const TaskSettings& task) {
  return readTask(JsonFile::ofText(task.source, "the text"));
}

TEST(TaskFile, ItsTextGivesTheSameTask) {
  for (const char* name : {"tasks/paracentesis.json", "tasks/bone_pin.json"}) {
    const TaskSettings file = readTask(station::assetFile(name)), text = fromText(file);
    EXPECT_EQ(text.source, file.source) << name;
    EXPECT_EQ(text.id, file.id);
    EXPECT_EQ(text.title, file.title);
    EXPECT_EQ(text.time_limit_s, file.time_limit_s);
    EXPECT_EQ(text.goal.has_value(), file.goal.has_value());
    EXPECT_EQ(text.block.has_value(), file.block.has_value());
    EXPECT_EQ(text.words.organ, file.words.organ);
    EXPECT_EQ(text.words.tissue, file.words.tissue);
    EXPECT_EQ(text.rules.weights.vein, file.rules.weights.vein);
    EXPECT_EQ(text.rules.errors.aim_travel, file.rules.errors.aim_travel);
    EXPECT_EQ(text.augmentations.subtaskNames(), file.augmentations.subtaskNames());
  }
}

TEST(TaskFile, PathsAreRelativeToTheFolderOfTheFile) {
  const std::filesystem::path name = station::assetFile("tasks/paracentesis.json");
  const TaskSettings file = readTask(name), text = fromText(file);
  EXPECT_EQ(file.materials, name.parent_path() / text.materials);
  EXPECT_EQ(file.expert_path, name.parent_path() / text.expert_path);
  EXPECT_TRUE(text.expert_path.is_relative());
}

TEST(TaskFile, MessagesNameTheText) {
  try {
    readTask(JsonFile::ofText(R"({"version": 1, "engine": "squeeze"})", "the text"));
    ADD_FAILURE() << "a task of another engine was taken";
  } catch (const UsageError& e) {
    EXPECT_EQ(std::string(e.what()).rfind("the text: ", 0), 0u) << e.what();
  }
}

}  // namespace
}  // namespace palpa::task_needle

#include "layers.h"

#include <gtest/gtest.h>

#include <set>

#include "source_tree.h"

namespace palpa::house {
namespace {

std::string folderOfLayer(const std::string& path) {
  const Layer* layer = layerOf(path);
  return layer ? layer->folder : "";
}

TEST(Layers, EveryProductFileHasOne) {
  for (const SourceFile& file : sourceTree(PALPA_SOURCE_DIR))
    EXPECT_TRUE(layerOf(file.path) || !file.isProduct()) << file.path;
}

TEST(Layers, EveryOneHoldsFiles) {
  std::set<std::string> used;
  for (const SourceFile& file : sourceTree(PALPA_SOURCE_DIR)) used.insert(folderOfLayer(file.path));
  for (const Layer& layer : layers()) EXPECT_TRUE(used.count(layer.folder)) << layer.folder;
}

TEST(Layers, EveryFolderNamedIsReal) {
  const std::vector<SourceFile>& tree = sourceTree(PALPA_SOURCE_DIR);
  const auto isReal = [&](const std::string& folder) {
    const std::string begin = folder.substr(0, folder.find('*'));
    for (const SourceFile& file : tree)
      if (file.path.rfind(begin, 0) == 0) return true;
    return false;
  };
  for (const Layer& layer : layers())
    for (const std::vector<std::string>* names : {&layer.ours, &layer.never})
      for (const std::string& name : *names) EXPECT_TRUE(isReal(name)) << layer.folder << name;
}

TEST(Layers, TheLongestFolderDecides) {
  EXPECT_EQ(folderOfLayer("anatomy/patient.h"), "anatomy");
  EXPECT_EQ(folderOfLayer("anatomy/base/error.h"), "anatomy/base");
  EXPECT_EQ(folderOfLayer("haptics/loop/tick.h"), "haptics");
  EXPECT_EQ(folderOfLayer("haptics/devices/falcon/falcon_driver.h"), "haptics/devices");
  EXPECT_EQ(folderOfLayer("apps/study/protocol.h"), "apps/study");
  EXPECT_EQ(folderOfLayer("apps/study/run/session.h"), "apps/study/run");
  EXPECT_EQ(folderOfLayer("apps/task_needle/task_file.h"), "apps/task_*");
  EXPECT_EQ(folderOfLayer("tests/house/layers.h"), "");
}

}  // namespace
}  // namespace palpa::house

#include <gtest/gtest.h>

#include <map>

#include "source_tree.h"

namespace palpa::house {
namespace {

/// A folder with more files is a corridor: it gets rooms.
constexpr int kMostInAFolder = 45;

TEST(Rooms, NoFolderHoldsMoreThanItShows) {
  std::map<std::string, int> count;
  for (const SourceFile& file : sourceTree(PALPA_SOURCE_DIR))
    if (file.isCode() && file.path.rfind("tests/", 0) != 0)
      ++count[file.path.substr(0, file.path.rfind('/'))];
  EXPECT_GT(count.size(), 30u) << "the walk has lost the tree";
  for (const auto& [folder, files] : count) EXPECT_LE(files, kMostInAFolder) << folder;
}

}  // namespace
}  // namespace palpa::house

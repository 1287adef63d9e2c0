#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <numeric>
#include <sstream>

#include "source_tree.h"

namespace palpa::house {
namespace {

/// A folder with more files is a corridor: it gets rooms.
constexpr int kMostInAFolder = 45;

/// Lines of each source of the product, the shortest first.
std::vector<long> linesOfProduct() {
  std::vector<long> lines;
  for (const SourceFile& file : sourceTree(PALPA_SOURCE_DIR))
    if (file.isProduct()) lines.push_back(std::count(file.text.begin(), file.text.end(), '\n'));
  std::sort(lines.begin(), lines.end());
  return lines;
}

/// The share of `sorted` below `limit`.
double shareBelow(long limit, const std::vector<long>& sorted) {
  const auto end = std::lower_bound(sorted.begin(), sorted.end(), limit);
  return static_cast<double>(end - sorted.begin()) / static_cast<double>(sorted.size());
}

/// Lines that begin with '#', apart from those in blocks of code.
int headingsOf(const std::string& page) {
  int headings = 0;
  bool is_code = false;
  std::istringstream lines(page);
  for (std::string line; std::getline(lines, line);) {
    if (line.rfind("```", 0) == 0) is_code = !is_code;
    if (!is_code && line.rfind('#', 0) == 0) ++headings;
  }
  return headings;
}

TEST(Rooms, NoFolderHoldsMoreThanItShows) {
  std::map<std::string, int> count;
  for (const SourceFile& file : sourceTree(PALPA_SOURCE_DIR))
    if (file.isProduct()) ++count[file.path.substr(0, file.path.rfind('/'))];
  EXPECT_GT(count.size(), 30u) << "the walk has lost the tree";
  for (const auto& [folder, files] : count) EXPECT_LE(files, kMostInAFolder) << folder;
}

TEST(Rooms, AFileIsARoomNotAGrain) {
  const std::vector<long> lines = linesOfProduct();
  ASSERT_GT(lines.size(), 200u) << "the walk has lost the tree";
  const long all = std::accumulate(lines.begin(), lines.end(), 0L);
  EXPECT_GE(all / static_cast<long>(lines.size()), 120)
      << "lines a file, on average: join small ones to their neighbours";
  const long median = lines[lines.size() / 2];
  EXPECT_GE(median, 70);
  EXPECT_LE(median, 120);
  EXPECT_LE(shareBelow(25, lines), 0.05) << "files shorter than 25 lines: join them to a neighbour";
  EXPECT_GE(shareBelow(301, lines), 0.9) << "files longer than 300 lines: part them";
}

TEST(Rooms, TheReadmeIsShort) {
  std::string readme;
  for (const SourceFile& file : sourceTree(PALPA_SOURCE_DIR))
    if (file.path == "README.md") readme = file.text;
  ASSERT_FALSE(readme.empty());
  EXPECT_LE(readme.size(), 8192u) << "bytes: what is more goes to docs/";
  EXPECT_LE(headingsOf(readme), 9);
}

TEST(Rooms, HeadingsInCodeDoNotCount) {
  EXPECT_EQ(headingsOf("# A\ntext\n```sh\n# a comment\n```\n## B\n#"), 3);
}

}  // namespace
}  // namespace palpa::house

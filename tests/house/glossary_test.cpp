#include <gtest/gtest.h>

#include <algorithm>
#include <set>
#include <sstream>

#include "source_tree.h"

namespace palpa::house {
namespace {

std::string trimmed(const std::string& cell) {
  const std::size_t begin = cell.find_first_not_of(' ');
  return begin == std::string::npos ? ""
                                    : cell.substr(begin, cell.find_last_not_of(' ') + 1 - begin);
}

/// A table's row, cell by cell; empty: no row, or the line below a header.
std::vector<std::string> cellsOf(const std::string& line) {
  std::vector<std::string> cells;
  if (line.rfind("| ", 0) != 0 || line.rfind("| ---", 0) == 0) return cells;
  std::istringstream row(line.substr(1));
  for (std::string cell; std::getline(row, cell, '|');) cells.push_back(trimmed(cell));
  return cells;
}

std::vector<std::vector<std::string>> rowsOf(const std::string& page) {
  std::vector<std::vector<std::string>> rows;
  std::istringstream lines(page);
  for (std::string line; std::getline(lines, line);)
    if (std::vector<std::string> cells = cellsOf(line); !cells.empty()) rows.push_back(cells);
  return rows;
}

/// The terms of docs/glossary.md; the headers of its tables left out.
std::vector<std::vector<std::string>> terms() {
  std::vector<std::vector<std::string>> rows;
  for (const SourceFile& file : sourceTree(PALPA_SOURCE_DIR))
    if (file.path == "docs/glossary.md") rows = rowsOf(file.text);
  std::erase_if(rows, [](const auto& row) { return row.back() == "where"; });
  return rows;
}

TEST(Glossary, EveryTermIsExplainedOnce) {
  std::set<std::string> seen;
  for (const std::vector<std::string>& row : terms())
    EXPECT_TRUE(seen.insert(row.front()).second) << row.front();
  EXPECT_GE(seen.size(), 60u);
}

TEST(Glossary, EveryPlaceIsReal) {
  const std::vector<SourceFile>& tree = sourceTree(PALPA_SOURCE_DIR);
  for (const std::vector<std::string>& row : terms()) {
    ASSERT_GT(row.back().size(), 2u) << row.front();
    const std::string place = row.back().substr(1, row.back().size() - 2);  // `...`
    EXPECT_TRUE(std::any_of(tree.begin(), tree.end(),
                            [&](const SourceFile& file) {
                              return file.path == place || file.path.rfind(place + "/", 0) == 0;
                            }))
        << row.front() << " is not in " << place;
  }
}

TEST(Glossary, RowsAreParted) {
  EXPECT_EQ(cellsOf("| a | b | | `c` |"), (std::vector<std::string>{"a", "b", "", "`c`"}));
  EXPECT_TRUE(cellsOf("| --- | --- |").empty());
  EXPECT_TRUE(cellsOf("text").empty());
}

}  // namespace
}  // namespace palpa::house

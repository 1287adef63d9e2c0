#pragma once

#include <gtest/gtest.h>

#include <map>
#include <sstream>
#include <string>
#include <vector>

namespace palpa::cli_test {

using Row = std::map<std::string, std::string>;

inline std::vector<std::string> cellsOf(const std::string& line) {
  std::vector<std::string> all;
  std::istringstream stream(line);
  for (std::string cell; std::getline(stream, cell, ',');) all.push_back(cell);
  return all;
}

/// Rows of a CSV without quotes, by column.
inline std::vector<Row> rowsOf(const std::string& csv) {
  std::istringstream lines(csv);
  std::string line;
  std::getline(lines, line);
  const std::vector<std::string> header = cellsOf(line);
  std::vector<Row> rows;
  while (std::getline(lines, line)) {
    const std::vector<std::string> values = cellsOf(line);
    EXPECT_LE(values.size(), header.size()) << line;
    Row row;
    for (std::size_t i = 0; i < std::min(values.size(), header.size()); ++i)
      row[header[i]] = values[i];
    rows.push_back(row);
  }
  return rows;
}

}  // namespace palpa::cli_test

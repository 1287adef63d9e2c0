#include "apps/calibrate/sample_table.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <fstream>
#include <sstream>

#include "anatomy/geometry/error.h"

namespace palpa::calibrate {
namespace {

constexpr std::uintmax_t kLargestTable = 64 << 20;
constexpr std::size_t kMostColumns = 64;

std::string trimmedCell(std::string cell) {
  const auto blank = [](char c) { return c == ' ' || c == '\t' || c == '\r' || c == '"'; };
  while (!cell.empty() && blank(cell.back())) cell.pop_back();
  const auto first = std::find_if_not(cell.begin(), cell.end(), blank);
  return {first, cell.end()};
}

std::vector<std::string> cellsOf(const std::string& line) {
  std::vector<std::string> cells;
  std::istringstream stream(line);
  for (std::string cell; std::getline(stream, cell, ',') && cells.size() <= kMostColumns;)
    cells.push_back(trimmedCell(cell));
  return cells;
}

}  // namespace

SampleTable::SampleTable(const std::filesystem::path& file) : name_(file.string()) {
  std::error_code error;
  const auto size = std::filesystem::file_size(file, error);
  if (error) throw Error("cannot be read (" + error.message() + ")", name_, "Check the name");
  if (size > kLargestTable) throw Error("is larger than 64 MB", name_, "Record for a shorter time");
  std::ifstream stream(file);
  std::size_t number = 0;
  for (std::string line; std::getline(stream, line);) {
    ++number;
    if (trimmedCell(line).empty() || line[0] == '#') continue;
    std::vector<std::string> cells = cellsOf(line);
    if (header_.empty()) {
      if (cells.size() > kMostColumns)
        throw Error("has more than 64 columns", name_, "Is it a table of samples?");
      header_ = std::move(cells);
      continue;
    }
    if (cells.size() != header_.size())
      throw Error("has " + std::to_string(cells.size()) + " cells where the header has " +
                      std::to_string(header_.size()),
                  name_ + ", line " + std::to_string(number), "Correct the line, or leave it out");
    cells_.push_back(std::move(cells));
    line_.push_back(number);
  }
  if (!stream.eof()) throw Error("cannot be read", name_, "Check its permissions");
  if (cells_.empty())
    throw Error("holds no samples", name_,
                "The first line names the columns, each further line is a sample");
}

bool SampleTable::has(const std::string& column) const {
  return std::find(header_.begin(), header_.end(), column) != header_.end();
}

std::size_t SampleTable::place(const std::string& column) const {
  const auto found = std::find(header_.begin(), header_.end(), column);
  if (found != header_.end()) return static_cast<std::size_t>(found - header_.begin());
  std::string names;
  for (const std::string& name : header_) names += (names.empty() ? "" : ", ") + name;
  throw Error("has no column \"" + column + "\"", name_, "It has: " + names.substr(0, 200));
}

void SampleTable::refuse(std::size_t row, const std::string& column,
                         const std::string& what) const {
  throw Error(what, name_ + ", line " + std::to_string(line_[row]) + ", column \"" + column + "\"",
              "Correct it, or leave the line out");
}

std::string SampleTable::text(std::size_t row, const std::string& column) const {
  return cells_[row][place(column)];
}

double SampleTable::number(std::size_t row, const std::string& column) const {
  const std::string& cell = cells_[row][place(column)];
  char* end = nullptr;
  const double value = std::strtod(cell.c_str(), &end);
  if (cell.empty() || *end != 0 || !std::isfinite(value))
    refuse(row, column, "\"" + cell.substr(0, 30) + "\" is not a number");
  return value;
}

Vec3 SampleTable::place(std::size_t row, const std::string& prefix) const {
  const bool mm = has(prefix + "x_mm");
  if (!mm && !has(prefix + "x_m") && has(prefix + "x"))
    throw Error("column \"" + prefix + "x\" does not say its unit", name_,
                "Call it \"" + prefix + "x_m\" or \"" + prefix + "x_mm\"");
  const std::string unit = mm ? "_mm" : "_m";
  Vec3 p;
  for (int i = 0; i < 3; ++i) p[i] = number(row, prefix + "xyz"[i] + unit);
  return mm ? Vec3(1e-3 * p) : p;
}

Quat SampleTable::turn(std::size_t row, const std::string& prefix) const {
  const double w = number(row, prefix + "q_w"), x = number(row, prefix + "q_x"),
               y = number(row, prefix + "q_y"), z = number(row, prefix + "q_z");
  const Quat q(w, x, y, z);
  if (std::abs(q.norm() - 1) > 1e-3)
    refuse(row, prefix + "q_w", "the four numbers are no unit quaternion");
  return q.normalized();
}

Pose SampleTable::pose(std::size_t row, const std::string& prefix) const {
  return makePose(turn(row, prefix).toRotationMatrix(), place(row, prefix));
}

}  // namespace palpa::calibrate

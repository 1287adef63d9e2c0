#include "apps/study/analysis/study_row.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <limits>
#include <set>
#include <tuple>

#include "anatomy/base/error.h"
#include "apps/training/trial_words.h"

namespace palpa::study_analysis {
namespace {

/// Numbers things as they first appear.
class Appearance {
 public:
  int of(const std::string& name) {
    return order_.emplace(name, static_cast<int>(order_.size())).first->second;
  }

 private:
  std::map<std::string, int> order_;
};

using Place = std::tuple<int, int, int, int>;  // subject, session, block, trial

std::vector<Place> placesOf(const std::vector<StudyRow>& rows) {
  Appearance subjects;
  std::map<std::pair<std::string, int>, Appearance> blocks;
  std::vector<Place> places;
  for (const StudyRow& r : rows)
    places.emplace_back(subjects.of(r.subject), r.session,
                        blocks[{r.subject, r.session}].of(r.block), r.trial);
  return places;
}

void requireOneGroup(const std::vector<StudyRow>& rows, const std::string& where) {
  std::map<std::string, std::string> groups;
  for (const StudyRow& r : rows)
    if (const auto known = groups.emplace(r.subject, r.group).first; known->second != r.group)
      throw UsageError("is in two groups, \"" + known->second + "\" and \"" + r.group + "\"",
                       where + ", subject " + r.subject, "Correct one of them");
}

void requireOnce(const std::vector<StudyRow>& rows, const std::vector<Place>& places,
                 const std::string& where) {
  std::set<Place> seen;
  for (std::size_t i = 0; i < rows.size(); ++i)
    if (!seen.insert(places[i]).second)
      throw UsageError("trial " + std::to_string(rows[i].trial) +
                           (rows[i].block.empty() ? "" : " of block " + rows[i].block) +
                           " occurs twice",
                       where + ", subject " + rows[i].subject, "Leave one of them out");
}

}  // namespace

double StudyRow::metric(const std::string& name) const {
  const auto found = metrics.find(name);
  return found == metrics.end() ? std::numeric_limits<double>::quiet_NaN() : found->second;
}

void orderAndNumber(std::vector<StudyRow>& rows, const std::string& where) {
  requireOneGroup(rows, where);
  const std::vector<Place> places = placesOf(rows);
  requireOnce(rows, places, where);
  std::vector<std::pair<Place, StudyRow>> sorted;
  for (std::size_t i = 0; i < rows.size(); ++i) sorted.emplace_back(places[i], std::move(rows[i]));
  std::sort(sorted.begin(), sorted.end(),
            [](const auto& a, const auto& b) { return a.first < b.first; });
  rows.clear();
  for (auto& [place, row] : sorted) {
    const StudyRow* before =
        rows.empty() || rows.back().subject != row.subject ? nullptr : &rows.back();
    row.overall = before ? before->overall + 1 : 1;
    row.trial = before && before->session == row.session && before->block == row.block
                    ? before->trial + 1
                    : 1;
    rows.push_back(std::move(row));
  }
}

namespace {

constexpr char kColumns[] =
    "The first line is SUBJECT,GROUP,CONDITION,BLOCK,TRIAL and the names of the figures";

}  // namespace

CsvReader::CsvReader(const std::string& text, std::string where)
    : text_(text), where_(std::move(where)) {
  if (text_.starts_with("\xef\xbb\xbf")) at_ = 3;  // a byte order mark of a spreadsheet
}

bool CsvReader::next(Line& line) {
  do {
    if (at_ >= text_.size()) return false;
    line = {number_, {}};
    readLine(line.fields);
  } while (line.fields.size() == 1 && line.fields[0].empty());
  return true;
}

void CsvReader::readLine(std::vector<std::string>& fields) {
  do fields.push_back(readField());
  while (at_ < text_.size() && text_[at_++] == ',');
  if (at_ > 0 && text_[at_ - 1] == '\r' && at_ < text_.size() && text_[at_] == '\n') ++at_;
  ++number_;
}

std::string CsvReader::readField() {
  std::string field;
  if (at_ < text_.size() && text_[at_] == '"') {
    readQuoted(field);
    return field;
  }
  while (at_ < text_.size() && text_[at_] != ',' && text_[at_] != '\n' && text_[at_] != '\r')
    field += text_[at_++];
  return field;
}

void CsvReader::readQuoted(std::string& field) {
  for (++at_; at_ < text_.size(); ++at_) {
    if (text_[at_] == '"' && (at_ + 1 >= text_.size() || text_[at_ + 1] != '"')) break;
    if (text_[at_] == '"') ++at_;
    if (text_[at_] == '\n') ++number_;
    field += text_[at_];
  }
  if (at_ >= text_.size())
    throw UsageError("a quoted text has no end", where_, "Correct the table");
  ++at_;
  if (at_ < text_.size() && text_[at_] != ',' && text_[at_] != '\n' && text_[at_] != '\r')
    throw UsageError("something follows a quoted text",
                     where_ + ", line " + std::to_string(number_),
                     "Double the quotes within a text");
}

namespace {

using Fields = std::vector<std::string>;
using Line = CsvReader::Line;

/// The cells of a line, by the names in the header.
class Cells {
 public:
  Cells(const Fields& header, const Line& line, const std::string& where)
      : header_(header), line_(line), where_(where + ", line " + std::to_string(line.number)) {
    if (line.fields.size() != header.size())
      throw UsageError("has " + std::to_string(line.fields.size()) +
                           " cells where the header has " + std::to_string(header.size()),
                       where_, "Correct the line");
  }

  std::string text(const std::string& column) const {
    for (std::size_t i = 0; i < header_.size(); ++i)
      if (header_[i] == column) return line_.fields[i];
    return "";
  }

  double number(std::size_t i) const {
    const std::string& cell = line_.fields[i];
    double value = 0;
    const auto end = std::from_chars(cell.data(), cell.data() + cell.size(), value);
    if (end.ec != std::errc() || end.ptr != cell.data() + cell.size() || !std::isfinite(value))
      throw UsageError("column " + header_[i] + ": \"" + cell + "\" is not a number", where_,
                       "Write 12.5; leave the cell empty where a figure does not apply");
    return value;
  }

  int whole(const std::string& column, int otherwise, int low) const {
    for (std::size_t i = 0; i < header_.size(); ++i) {
      if (header_[i] != column || line_.fields[i].empty()) continue;
      const double value = number(i);
      if (value != std::floor(value) || value < low || value > 1e6)
        throw UsageError("column " + column + " must be a whole number from " + std::to_string(low),
                         where_, "Correct the line");
      return static_cast<int>(value);
    }
    return otherwise;
  }

  std::size_t size() const { return header_.size(); }
  const std::string& name(std::size_t i) const { return header_[i]; }
  bool empty(std::size_t i) const { return line_.fields[i].empty(); }
  const std::string& where() const { return where_; }

 private:
  const Fields& header_;
  const Line& line_;
  std::string where_;
};

bool isFigure(const std::string& column) {
  for (const char* name : {"SUBJECT", "GROUP", "CONDITION", "BLOCK", "TRIAL", "SESSION",
                           "SIMULATED", "SOFTWARE", "ROLE", "OUTCOME"})
    if (column == name) return false;
  return true;
}

StudyRow rowOf(const Cells& cells) {
  StudyRow row{cells.text("SUBJECT"),
               cells.text("GROUP"),
               cells.text("CONDITION"),
               cells.text("BLOCK"),
               cells.whole("SESSION", 1, 1),
               cells.whole("TRIAL", 0, 1),
               0,
               cells.whole("SIMULATED", 0, 0) != 0,
               cells.text("SOFTWARE"),
               {}};
  if (row.subject.empty())
    throw UsageError("has no subject", cells.where(), "Say whose trial it is");
  if (row.trial == 0)
    throw UsageError("has no trial number", cells.where(), "Number the trials of a block from 1");
  for (std::size_t i = 0; i < cells.size(); ++i)
    if (isFigure(cells.name(i)) && !cells.empty(i)) row.metrics[cells.name(i)] = cells.number(i);
  return row;
}

void requireHeader(const Fields& header, const std::string& where) {
  for (const char* needed : {"SUBJECT", "GROUP", "CONDITION", "BLOCK", "TRIAL"}) {
    const auto times = std::count(header.begin(), header.end(), needed);
    if (times != 1)
      throw UsageError(std::string(times ? "has more than one column " : "has no column ") + needed,
                       where, kColumns);
  }
  if (std::none_of(header.begin(), header.end(), isFigure))
    throw UsageError("has no figures", where, kColumns);
  for (const std::string& name : header)
    if (name.empty() || std::count(header.begin(), header.end(), name) > 1)
      throw UsageError(name.empty() ? "has a column without a name" : "has two columns " + name,
                       where, kColumns);
}

}  // namespace

std::vector<StudyRow> rowsOfCsv(const std::string& text, const std::string& where) {
  CsvReader reader(text, where);
  Line header, line;
  if (!reader.next(header)) throw UsageError("is empty", where, kColumns);
  requireHeader(header.fields, where);
  std::vector<StudyRow> rows;
  while (reader.next(line)) {
    const Cells cells(header.fields, line, where);
    const training::Role role = training::roleNamed(cells.text("ROLE"));
    if (role == training::Role::familiarisation || training::isVoid(cells.text("OUTCOME")))
      continue;
    rows.push_back(rowOf(cells));
  }
  if (rows.empty())
    throw UsageError("holds no scored trial", where, "Each line after the first is a trial");
  orderAndNumber(rows, where);
  return rows;
}

}  // namespace palpa::study_analysis

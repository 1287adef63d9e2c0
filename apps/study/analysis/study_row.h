#pragma once

#include <map>
#include <string>
#include <vector>

namespace palpa::study_analysis {

/// A scored trial of a study.
struct StudyRow {
  std::string subject, group, condition, block;
  int session = 1;  ///< 1, 2, ... of this subject in this study
  int trial = 0;    ///< 1, 2, ... in its session and block
  int overall = 0;  ///< 1, 2, ... of this subject, over all blocks
  bool simulated = false;
  std::string software;                          ///< that recorded it; empty: not told
  std::map<std::string, double> metrics;         ///< by name; without those that do not apply
  double metric(const std::string& name) const;  ///< not a number where it does not apply
};

/// Orders rows by subject (as they first appear), session, block (as it first appears in the
/// session) and trial; then numbers `trial` and `overall` from 1. Throws UsageError, naming
/// `where`, for a trial that is there twice and for a subject in two groups.
void orderAndNumber(std::vector<StudyRow>& rows, const std::string& where);

/// Rows of a table "SUBJECT,GROUP,CONDITION,BLOCK,TRIAL,<figure>,..." (RFC 4180; any order),
/// figures named as in the table of metrics ("time_s", "total", "success") or as their owner names
/// them; an empty cell: does not apply. Optional columns: SESSION, SIMULATED (0, 1), SOFTWARE, ROLE
/// and OUTCOME: rows whose role is "familiarisation" or whose outcome is "void" are left out.
/// Throws UsageError, naming `where` and the line, for what it cannot read.
std::vector<StudyRow> rowsOfCsv(const std::string& text, const std::string& where);

/// The lines of a table, RFC 4180: quotes around what holds commas, quotes or line ends; blank
/// lines are passed over. Throws UsageError, naming `where` and the line.
class CsvReader {
 public:
  struct Line {
    std::size_t number = 0;  ///< in the text, from 1
    std::vector<std::string> fields;
  };
  CsvReader(const std::string& text, std::string where);  ///< the text stays where it is
  bool next(Line& line);                                  ///< false: there is none

 private:
  void readLine(std::vector<std::string>& fields);
  std::string readField();
  void readQuoted(std::string& field);

  const std::string& text_;
  std::string where_;
  std::size_t at_ = 0, number_ = 1;
};

}  // namespace palpa::study_analysis

#pragma once

#include <limits>
#include <map>
#include <string>
#include <vector>

namespace palpa::competence {

/// A figure of metric_table between limits, both included. Without limits ("applies" in the file):
/// that there is one at all.
struct Rule {
  std::string metric;
  double at_least = -std::numeric_limits<double>::infinity(),
         at_most = std::numeric_limits<double>::infinity();
  bool holds(double value) const { return value >= at_least && value <= at_most; }
};

/// Something that must be done. Judged from the trial's figures where there are rules (all must
/// hold), else by a rater.
struct ChecklistItem {
  std::string id, text;
  bool major = true;
  std::vector<Rule> rules;
  /// a figure that does not apply: it did not arise; else it was not done
  bool may_not_arise = false;
  bool byRater() const { return rules.empty(); }
};

/// What no share of items makes up for: it happened when the rule holds.
struct CriticalError {
  std::string id, text;  ///< "the pleura was punctured"
  Rule rule;
};

struct Level {
  int major = 0, minor = 0;  ///< items at least
};

struct Checklist {
  std::string id, title, source;
  std::vector<ChecklistItem> items;
  std::vector<CriticalError> critical;
  /// shares of items that may be asked for; the first unless said otherwise
  std::vector<double> standards;
  Level competent, borderline;
  std::string levels_source;
};

/// An aspect that a rater grades from 1 to 5, with words for 1, 3 and 5.
struct RatingItem {
  std::string id, text, low, middle, high;
};
struct GlobalRating {
  std::string id, title, source;
  std::vector<RatingItem> items;
  double mean_at_least = 3;
  int none_below = 1;
};
inline constexpr int kBestGrade = 5;

/// From a file's text; `where` names it. Throw UsageError with file and field: of a newer version,
/// not JSON, a figure that there is not, an id twice.
Checklist parseChecklist(const std::string& text, const std::string& where);
GlobalRating parseGlobalRating(const std::string& text, const std::string& where);

/// What a rater said, by item. Of a checklist: kDone, kNotDone, kDidNotArise; of a global rating: 1
/// to 5.
using Answers = std::map<std::string, int>;
inline constexpr int kDone = 1, kNotDone = 0, kDidNotArise = -1;

/// "item,value" a line, as it is typed in from paper: done, not done, did not arise, or 1 to 5. A
/// first line "item,value" is a heading; what follows # is a remark. Throws UsageError with the
/// line for an item that neither form has, a value that it cannot have, an item twice.
struct FormAnswers {
  Answers checklist, global;
};
FormAnswers parseAnswers(const std::string& text, const std::string& where,
                         const Checklist& checklist, const GlobalRating* global);

/// "done", "not done", "did not arise".
const char* answerWords(int answer);

}  // namespace palpa::competence

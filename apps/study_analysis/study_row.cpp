#include "apps/study_analysis/study_row.h"

#include <algorithm>
#include <limits>
#include <set>
#include <tuple>

#include "anatomy/geometry/error.h"

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
                           " is there twice",
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

}  // namespace palpa::study_analysis

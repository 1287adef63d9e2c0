#include "apps/study/analysis/study_design.h"

#include <algorithm>

#include "anatomy/base/error.h"
#include "apps/assess/statistics/power.h"
#include "apps/study/analysis/exhibit.h"
#include "apps/study/analysis/pilot.h"
#include "apps/study/analysis/search_study.h"

namespace palpa::study_analysis {
namespace {

std::vector<std::string> levelsOf(const std::vector<StudyRow>& rows,
                                  const std::vector<std::string>& first,
                                  std::string StudyRow::*of) {
  std::vector<std::string> levels;
  for (const std::string& name : first)
    if (std::any_of(rows.begin(), rows.end(), [&](const StudyRow& r) { return r.*of == name; }))
      addOnce(levels, name);
  for (const StudyRow& r : rows) addOnce(levels, r.*of);
  return levels;
}

}  // namespace

StudyKind studyKindNamed(const std::string& name, const std::string& where) {
  if (name.empty() || name == "general") return StudyKind::general;
  if (name == "paracentesis pilot") return StudyKind::paracentesis_pilot;
  if (name == "search study") return StudyKind::search_study;
  throw UsageError("\"" + name + "\" is not a kind of analysis", where,
                   "There are: general, paracentesis pilot, search study");
}

std::string inWords(const StudyDesign& design, const std::string& name) {
  const auto found = design.words.find(name);
  return found != design.words.end() && !found->second.empty() ? found->second : name;
}

std::vector<std::string> groupsOf(const std::vector<StudyRow>& rows, const StudyDesign& design) {
  return levelsOf(rows, design.groups, &StudyRow::group);
}
std::vector<std::string> conditionsOf(const std::vector<StudyRow>& rows,
                                      const StudyDesign& design) {
  return levelsOf(rows, design.conditions, &StudyRow::condition);
}

StudyResult analyseStudy(const std::vector<StudyRow>& rows, const StudyDesign& design) {
  if (rows.empty())
    throw UsageError("no scored trial to analyse", design.title,
                     "Bring sessions of the study into the records first");
  const auto analyse = design.kind == StudyKind::paracentesis_pilot ? analysePilot
                       : design.kind == StudyKind::search_study     ? analyseSearchStudy
                                                                    : analyseGeneral;
  StudyResult result = analyse(rows, design);
  for (std::string& finding : result.findings) finding = capitalised(finding);
  for (Exhibit& exhibit : result.exhibits) exhibit.title = capitalised(exhibit.title);
  return result;
}

StudyResult framedResult(const std::vector<StudyRow>& rows, const StudyDesign& design,
                         const std::string& kind) {
  StudyResult result;
  result.title = design.title;
  result.kind = kind;
  for (const std::string& group : groupsOf(rows, design))
    result.groups.push_back(inWords(design, group));
  for (const std::string& condition : conditionsOf(rows, design))
    result.conditions.push_back(inWords(design, condition));
  std::vector<std::string> subjects;
  for (const StudyRow& r : rows) {
    addOnce(subjects, r.subject);
    if (!r.software.empty()) addOnce(result.software, r.software);
    result.simulated_trials += r.simulated ? 1 : 0;
  }
  result.subjects = subjects.size();
  result.trials = rows.size();
  return result;
}

std::vector<std::string> cautionsOf(const StudyResult& result, std::size_t smallest) {
  std::vector<std::string> cautions;
  if (smallest >= 2)
    cautions.push_back(
        "With " + std::to_string(smallest) +
        " subjects to a group, four of five studies like this one see a difference only if it is "
        "as large as " +
        number(smallestVisibleEffect(smallest), 1) +
        " standard deviations between subjects. What was not found here may still be there.");
  else
    cautions.push_back("With fewer than two subjects to a group nothing can be tested.");
  cautions.push_back(
      "A p-value above 0.05 does not show that there is no difference; the interval says which "
      "differences are compatible with what was seen.");
  if (result.simulated_trials > 0 && result.simulated_trials < result.trials)
    cautions.push_back(
        std::to_string(result.simulated_trials) + " of " + std::to_string(result.trials) +
        " trials are simulated, the others are people's: the two must not be mixed.");
  if (result.software.size() > 1)
    cautions.push_back(
        "The trials were recorded with several versions: " + joined(result.software) +
        ". Whether they score alike was not checked here.");
  return cautions;
}

std::vector<std::string> publishedWords() {
  return {
      "The tests of Tzafestas et al. 2008 take every trial as if it came from another person: n = "
      "subjects × trials. Trials of one subject are alike, so there are fewer independent values "
      "than that.",
      "Between groups this counts too many degrees of freedom: differences between a few people "
      "pass for certain, and chance is called an effect far more often than one time in twenty.",
      "Within subjects it forgets that the same people are compared with themselves: the "
      "differences between them stay in the error, and learning that is there is missed. So the "
      "learning test is too timid, the group test too bold; the p-values here serve to compare "
      "with that publication, not to decide."};
}

double smallestVisibleEffect(std::size_t n, double power) {
  double none = 0, enough = 1;
  const auto count = static_cast<double>(n);
  while (statistics::powerOfTwoGroups(enough, count, count) < power) enough *= 2;
  for (int i = 0; i < 40; ++i) {
    const double middle = (none + enough) / 2;
    (statistics::powerOfTwoGroups(middle, count, count) < power ? none : enough) = middle;
  }
  return enough;
}

}  // namespace palpa::study_analysis

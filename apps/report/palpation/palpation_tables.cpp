#include "apps/report/palpation/palpation_sections.h"

#include <cmath>

#include "apps/assess/palpation/coverage_map.h"
#include "apps/assess/palpation/palpation_words.h"
#include "apps/report/page/page_parts.h"
#include "apps/report/palpation/palpation_charts.h"

namespace palpa::report {
namespace {

using assess::CaseLump;
using assess::LumpMark;

constexpr double kSameSize = 0.5e-3;  // m: nobody grades finer
constexpr const char* kHardnessWords[] = {"soft", "hard"};
constexpr const char* kMobilityWords[] = {"fixed", "mobile"};

std::string percentText(double share) {
  return std::isfinite(share) ? assess::percentWords(share) : "–";
}
std::string mmText(double metres, int decimals) { return fixed(1000 * metres, decimals) + " mm"; }

std::string gradeWord(int grade, const char* const (&words)[2]) {
  return grade == 1 || grade == 2 ? words[grade - 1] : "unknown";
}

std::string gradedText(int said, int truth, const char* const (&words)[2]) {
  if (said == 0) return "not graded; it is " + gradeWord(truth, words);
  if (said == truth) return "right: " + gradeWord(truth, words);
  return "wrong: said " + gradeWord(said, words) + ", is " + gradeWord(truth, words);
}

std::string sizeErrorText(const LumpMark& mark, double error) {
  if (!(mark.diameter > 0)) return "not graded";
  if (std::abs(error) < kSameSize) return "right";
  return mmText(std::abs(error), 1) + (error > 0 ? " too large" : " too small");
}

void writeFoundCells(Html& html, const CaseLump& lump, const assess::LumpVerdict& verdict,
                     const LumpMark& mark) {
  html.element("td", "found by mark " + std::to_string(verdict.mark + 1));
  html.element("td", mmText(verdict.error, 1));
  html.element("td", sizeErrorText(mark, verdict.size_error));
  html.element("td", gradedText(mark.hardness, lump.hardness, kHardnessWords));
  html.element("td", gradedText(mark.mobility, lump.mobility, kMobilityWords));
}

void writeLumpRow(Html& html, const PalpationPage& page, std::size_t index) {
  const assess::PalpationAssessment& trial = page.assessment;
  const CaseLump& lump = trial.lumps[index];
  const auto row = html.in("tr");
  html.element("th", {{"scope", "row"}}, lumpName(index));
  html.element("td", assess::placeWords(page.rules.area, lump.p_P) + ", " +
                         mmText(-lump.p_P.z(), 0) + " deep");
  html.element("td", mmText(lump.diameter, 0));
  const assess::LumpVerdict verdict =
      index < trial.score.lumps.size() ? trial.score.lumps[index] : assess::LumpVerdict{};
  const auto mark = static_cast<std::size_t>(verdict.mark);
  if (verdict.mark >= 0 && mark < trial.marks.size())
    return writeFoundCells(html, lump, verdict, trial.marks[mark]);
  html.element("td", {{"class", "missed-word"}}, "missed");
  for (int i = 0; i < 2; ++i) html.element("td", "–");
  html.element("td", gradeWord(lump.hardness, kHardnessWords));
  html.element("td", gradeWord(lump.mobility, kMobilityWords));
}

/// "2 of them lie on the liver's edge, which is normal here."
std::string normalText(const PalpationPage& page) {
  const int count = page.assessment.score.of_normal, alarms = page.assessment.score.false_alarms;
  std::string names;
  for (const assess::NormalAnatomy& normal : page.rules.normal)
    names += (names.empty() ? "" : ", ") + normal.name;
  if (names.empty()) return "";
  if (count == 0) return " Felt in every case, and normal: " + names + ".";
  const std::string which =
      alarms == 1       ? "It lies"
      : count == alarms ? "They lie"
                        : std::to_string(count) + " of them " + (count == 1 ? "lies" : "lie");
  return ' ' + which + " on what is normal here: " + names + ".";
}

std::string marksText(const assess::PalpationScore& score) {
  std::string text =
      score.false_alarms == 0
          ? "No false alarm."
          : std::to_string(score.false_alarms) +
                (score.false_alarms == 1 ? " mark is a false alarm." : " marks are false alarms.");
  if (score.repeated > 0)
    text += ' ' + std::to_string(score.repeated) +
            (score.repeated == 1 ? " mark repeats" : " marks repeat") +
            " a lump that had been found; that costs nothing.";
  return text;
}

std::string patternText(const assess::SearchedPattern& pattern) {
  return assess::nameOf(pattern.pattern);
}

std::vector<Fact> coverageFigures(const assess::PalpationScore& s,
                                  const assess::PalpationRules& rules) {
  const auto from = [&](std::size_t level) {
    return "pressed with " + trimmed(rules.levels[level], 2) + " N or more";
  };
  const bool known = s.pattern.pattern != assess::SearchPattern::none;
  return {{"Area felt", percentText(s.coverage[0]), from(0)},
          {"Area felt with medium pressure or more", percentText(s.coverage[1]), from(1)},
          {"Area felt deeply", percentText(s.coverage[2]), from(2)},
          {"Area felt twice", percentText(s.twice),
           "come back to after " + trimmed(assess::CoverageMap::kAnew_s, 1) + " s or more"},
          {"Search pattern", patternText(s.pattern),
           known ? "kept in " + fixed(100 * s.pattern.kept, 0) + " % of the moves" : ""},
          {"Presses", std::to_string(s.presses), ""}};
}

std::vector<Fact> forceFigures(const assess::PalpationScore& s,
                               const assess::PalpationRules& rules) {
  const std::string touching =
      "of the time of touching (" + trimmed(rules.touch, 2) + " N or more), ";
  return {{"Largest force", fixed(s.peak, 2) + " N", ""},
          {"Mean force", fixed(s.mean, 2) + " N", "while touching"},
          {"Too light", percentText(s.too_light),
           touching + "below " + trimmed(rules.levels[0], 2) + " N"},
          {"Too hard", percentText(s.too_hard),
           touching + "above " + trimmed(rules.too_hard, 2) + " N"},
          {"Force of closer looks", s.closer_force > 0 ? fixed(s.closer_force, 2) + " times" : "–",
           s.closer_force > 0 ? "the force of the search; 1.15 is usual for those who find"
                              : "no closer look was taken"}};
}

}  // namespace

void writeLumpTable(Html& html, const PalpationPage& page) {
  const assess::PalpationAssessment& trial = page.assessment;
  html.element("h3", "Lumps and marks");
  if (!trial.lumps.empty()) {
    const auto scroll = html.in("div", {{"class", "scroll"}});
    const auto table = html.in("table", {{"class", "lumps"}});
    {
      const auto head = html.in("thead");
      const auto row = html.in("tr");
      for (const char* name : {"Lump", "Where", "Size", "Result", "Position error", "Size error",
                               "Hardness", "Mobility"})
        html.element("th", {{"scope", "col"}}, name);
    }
    const auto body = html.in("tbody");
    for (std::size_t i = 0; i < trial.lumps.size(); ++i) writeLumpRow(html, page, i);
  } else {
    html.element("p", "There was no lump in this case.");
  }
  html.element("p", marksText(trial.score) + normalText(page));
}

void writePalpationFigures(Html& html, const PalpationPage& page) {
  const assess::PalpationScore& score = page.assessment.score;
  std::vector<Fact> facts = coverageFigures(score, page.rules);
  for (const Fact& fact : forceFigures(score, page.rules)) facts.push_back(fact);
  facts.push_back({"Time", fixed(score.seconds, 1) + " s", ""});
  facts.push_back({"Guided", percentText(page.assessment.facts.guided),
                   "of the time something on the screen led the hand"});
  writeFactTable(html, facts);
}

}  // namespace palpa::report

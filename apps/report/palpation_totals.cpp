#include "apps/report/palpation_totals.h"

#include <cmath>
#include <utility>

#include "apps/assess/palpation/palpation_judgement.h"
#include "apps/assess/statistics/wilson.h"
#include "apps/report/numbers.h"
#include "apps/report/page_parts.h"

namespace palpa::report {
namespace {

struct PalpationSums {
  int trials = 0, left_out = 0, passed = 0, found = 0, lumps = 0, false_alarms = 0, clear = 0,
      wrong = 0;
};

PalpationSums sumsOf(const std::vector<PalpationPage>& trials) {
  PalpationSums sums;
  for (const PalpationPage& page : trials) {
    const assess::PalpationAssessment& trial = page.assessment;
    if (!assess::counts(trial)) {
      ++sums.left_out;
      continue;
    }
    ++sums.trials;
    sums.passed += trial.passed;
    sums.found += trial.score.found;
    sums.lumps += trial.score.found + trial.score.missed;
    sums.false_alarms += trial.score.false_alarms;
    sums.clear += trial.score.clear_quadrants;
    sums.wrong += trial.score.wrong_quadrants;
  }
  return sums;
}

std::string numberOf(int n, const char* one, const char* many) {
  return std::to_string(n) + ' ' + (n == 1 ? one : many);
}

/// "71 %" and "95 % interval: 36 % to 92 %".
Fact shareFact(const char* name, int hits, int of, const std::string& what) {
  if (of == 0) return {name, "–", "nothing to tell it from"};
  const statistics::ShareInterval share = statistics::wilson(hits, of);
  const auto percent = [](double value) { return fixed(100 * value, 0) + " %"; };
  return {name, percent(share.share),
          "95 % interval " + percent(share.low) + " to " + percent(share.high) + "; " + what};
}

std::string totalsSentence(const PalpationSums& sums) {
  const std::string trials = numberOf(sums.trials, "scored trial", "scored trials"),
                    alarms = numberOf(sums.false_alarms, "false alarm", "false alarms");
  const std::string found = sums.lumps == 0 ? "No lump was to be found in " + trials + "; "
                                            : "Found " + std::to_string(sums.found) + " of " +
                                                  numberOf(sums.lumps, "lump", "lumps") + " in " +
                                                  trials + "; ";
  return found + alarms + ".";
}

Fact judgementFact(const std::vector<PalpationPage>& pages,
                   const assess::PalpationStandard& standard) {
  std::vector<assess::PalpationAssessment> trials;
  for (const PalpationPage& page : pages) trials.push_back(page.assessment);
  const assess::PalpationJudgement judgement = assess::judgementOf(trials, standard);
  using Verdict = assess::PalpationJudgement::Verdict;
  if (judgement.lumps == 0) return {"Passed?", "not judged", "no lump was there to be found"};
  if (judgement.verdict == Verdict::too_few_cases)
    return {"Passed?", "not judged",
            "that takes " + std::to_string(assess::kEnoughCases) + " cases or more; here " +
                std::to_string(judgement.cases) + ": so few tell little of a person"};
  const auto percent = [](double value) { return fixed(100 * value, 0) + " %"; };
  return {"Passed?", judgement.verdict == Verdict::passed ? "yes" : "no",
          percent(standard.sensitivity) + " of the lumps and " + percent(standard.coverage) +
              " of the area are asked for; felt on average: " +
              percent(std::floor(100 * judgement.coverage) / 100)};
}

}  // namespace

void writePalpationTotals(Html& html, const std::vector<PalpationPage>& trials,
                          const assess::PalpationStandard& standard) {
  const PalpationSums sums = sumsOf(trials);
  const auto section = html.in("section", {{"class", "card"}, {"id", "totals"}});
  html.element("h2", "All trials");
  if (sums.trials == 0) {
    html.element("p", "No trial counts: none was both scored and finished.");
    return;
  }
  html.element("p", totalsSentence(sums));
  writeFactTable(
      html, {{"Lumps found", std::to_string(sums.found) + " of " + std::to_string(sums.lumps), ""},
             shareFact("Sensitivity", sums.found, sums.lumps, "of the lumps, those found"),
             shareFact("Specificity", sums.clear - sums.wrong, sums.clear,
                       "of the quarters without a lump, those left clear"),
             {"False alarms", std::to_string(sums.false_alarms), "marks where no lump is"},
             {"At the standard",
              std::to_string(sums.passed) + " of " + numberOf(sums.trials, "trial", "trials"), ""},
             judgementFact(trials, standard)});
  std::string note =
      "The intervals take all lumps, and all quarters, as independent of each other: read them as "
      "a lower bound of the doubt.";
  if (sums.left_out > 0)
    note = numberOf(sums.left_out, "trial is", "trials are") +
           " not counted here: void, not finished, or not scored. " + note;
  html.element("p", {{"class", "muted small"}}, note);
}

void writePalpationGlossary(Html& html) {
  static constexpr std::pair<const char*, const char*> kWords[] = {
      {"Sensitivity",
       "Of the lumps that were there, the share that was found. Every lump missed lowers it."},
      {"Specificity",
       "Of the quarters of the area without a lump near them, the share in which none was marked. "
       "False alarms lower it."},
      {"Coverage",
       "The share of the area that was felt, at each pressure or a deeper one. Where nothing was "
       "felt, nothing can be found."},
      {"False alarm", "A mark with no lump near it."},
      {"At the standard",
       "In this trial enough lumps were found and enough of the area was felt, as the task asks. "
       "One trial passes or fails nobody."},
      {"Closer look", "Several presses about one place, in contrast to the search, which goes on."},
      {"95 % interval", "What the true share may well be, as few trials tell little (Wilson)."}};
  html.element("h2", "What these words mean");
  {
    const auto list = html.in("dl", {{"class", "glossary"}});
    for (const auto& [word, meaning] : kWords) {
      html.element("dt", word);
      html.element("dd", meaning);
    }
  }
  html.element(
      "p", {{"class", "muted"}},
      "Sources: vertical strips miss least: M. B. Barton, R. Harris, S. W. Fletcher, JAMA 282, "
      "1999. Clinicians who find press about 15 % more when they look closer: PMC10980574. "
      "The interval: E. B. Wilson, J. Am. Stat. Assoc. 22, 1927.");
}

}  // namespace palpa::report

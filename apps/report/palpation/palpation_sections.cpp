#include "apps/report/palpation/palpation_sections.h"

#include <cmath>
#include <utility>

#include "apps/assess/palpation/palpation_assessment.h"
#include "apps/assess/palpation/palpation_words.h"
#include "apps/assess/statistics/sample.h"
#include "apps/report/page/page_parts.h"
#include "apps/report/palpation/palpation_charts.h"
#include "apps/training/trial_words.h"

namespace palpa::report {

using training::Outcome;

namespace {

void drawVerdictSign(Html& html, Tone tone) {
  const auto svg =
      html.in("svg", {{"class", "sign"}, {"viewBox", "0 0 40 40"}, {"aria-hidden", "true"}});
  html.empty("circle", {{"cx", "20"}, {"cy", "20"}, {"r", "19"}});
  html.empty("path", {{"d", tone == Tone::good  ? "M10 21l7 7 13-15"
                            : tone == Tone::bad ? "M12 12l16 16M28 12l-16 16"
                                                : "M11 20h18"}});
}

void writeLumpsFound(Html& html, const assess::PalpationAssessment& trial) {
  const auto box = html.in("div", {{"class", "total"}});
  const int lumps = trial.score.found + trial.score.missed;
  const bool counts = trial.facts.outcome != Outcome::voided && lumps > 0;
  html.element("strong",
               counts ? std::to_string(trial.score.found) + " of " + std::to_string(lumps) : "–");
  html.element("span", counts       ? (lumps == 1 ? "lump found" : "lumps found")
                       : lumps == 0 ? "no lump to find"
                                    : "not judged");
}

void writePalpationTiles(Html& html, const assess::PalpationAssessment& trial) {
  const auto tiles = html.in("ul", {{"class", "tiles"}});
  const auto tile = [&](const char* name, const std::string& value) {
    const auto item = html.in("li");
    html.element("span", name);
    html.element("strong", value);
  };
  tile("Duration", fixed(trial.score.seconds, 1) + " s");
  tile("Area felt", assess::percentWords(trial.score.coverage.front()));
  tile("Felt deeply", assess::percentWords(trial.score.coverage.back()));
  tile("False alarms", std::to_string(trial.score.false_alarms));
  tile("Force feedback", trial.facts.force_feedback ? "on" : "off");
  tile("Seed", std::to_string(trial.facts.seed));
}

void writePalpationVerdict(Html& html, const assess::PalpationAssessment& trial) {
  const Tone tone = toneOfPalpation(trial);
  const auto box = html.in("div", {{"class", std::string("verdict ") + cssClass(tone)}});
  drawVerdictSign(html, tone);
  {
    const auto words = html.in("div", {{"class", "finding"}});
    {
      const auto line = html.in("p", {{"class", "outcome"}});
      html.text(palpationVerdict(trial));
      if (trial.facts.simulated) html.element("span", {{"class", "badge"}}, "simulated");
    }
    html.element("p", trial.summary);
  }
  writeLumpsFound(html, trial);
}

void writeAdvice(Html& html, const assess::PalpationAssessment& trial) {
  if (trial.facts.outcome == Outcome::voided) return;
  html.element("h3", "What to do better");
  if (trial.advice.empty()) {
    html.element("p", "These measures show nothing to do better.");
    return;
  }
  const auto list = html.in("ol", {{"class", "advice"}});
  for (const std::string& sentence : trial.advice) html.element("li", sentence);
}

}  // namespace

std::string palpationVerdict(const assess::PalpationAssessment& trial) {
  const Outcome outcome = trial.facts.outcome;
  if (outcome == Outcome::voided) return "Not judged: void";
  if (outcome == Outcome::none) return "Not judged: not finished";
  if (!assess::counts(trial))
    return "Not counted: " + (trial.facts.augmented ? std::string("cues were added to the forces")
                                                    : training::nameOf(trial.facts.role));
  if (trial.passed) return "At the standard";
  std::vector<std::string> why;
  if (outcome == Outcome::aborted) why.push_back("stopped early");
  if (outcome == Outcome::time) why.push_back("time limit reached");
  for (const assess::Shortfall below : trial.below) why.push_back(assess::wordsOf(below));
  return "Below the standard: " + assess::joinedWords(why);
}

Tone toneOfPalpation(const assess::PalpationAssessment& trial) {
  if (!assess::counts(trial)) return Tone::neutral;
  return trial.passed ? Tone::good : Tone::bad;
}

void writePalpationSection(Html& html, const PalpationPage& page) {
  const assess::PalpationAssessment& trial = page.assessment;
  const std::string number = std::to_string(trial.facts.trial);
  const auto section = html.in("section", {{"class", "card trial"}, {"id", "trial-" + number}});
  {
    const auto heading = html.in("h2");
    html.text("Trial " + number);
    if (const std::string& role = training::nameOf(trial.facts.role); !role.empty())
      html.element("span", {{"class", "role"}}, role);
  }
  writePalpationVerdict(html, trial);
  writePalpationTiles(html, trial);
  writeAdvice(html, trial);
  html.element("h3", "What was felt, and where the lumps are");
  html.element("p",
               "The searched area from above, with you at its lower edge. The stronger the colour "
               "of a cell and the more dots in it, the more firmly it was felt.");
  writeCoverageChart(html, page);
  writeLumpTable(html, page);
  html.element("h3", "Pressing force");
  writePressingChart(html, page);
  html.element("h3", "Figures");
  writePalpationFigures(html, page);
  writePictures(html, page.pictures);
}

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
  if (of == 0) return {name, "–", "no case here tells it"};
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

assess::PalpationJudgement judged(const std::vector<PalpationPage>& pages,
                                  const assess::PalpationStandard& standard) {
  std::vector<assess::PalpationAssessment> trials;
  for (const PalpationPage& page : pages) trials.push_back(page.assessment);
  return assess::judgementOf(trials, standard);
}

std::string reachedWords(const assess::PalpationJudgement& judgement) {
  const assess::PalpationReached& r = judgement.reached;
  return assess::percentWords(r.sensitivity) + " of the lumps, " +
         assess::percentWords(r.coverage) + " of the area, " +
         assess::percentWords(r.deep_coverage) + " deeply, " + fixed(r.false_alarms, 1) +
         " false alarms a case";
}

Fact judgementFact(const assess::PalpationJudgement& judgement,
                   const assess::PalpationStandard& standard) {
  using assess::PalpationVerdict;
  switch (judgement.verdict) {
    case PalpationVerdict::no_lump:
      return {"Passed?", "not judged", "no lump was there to be found"};
    case PalpationVerdict::too_few_cases:
      return {"Passed?", "not judged",
              "that takes " + std::to_string(assess::kEnoughCases) + " cases or more; here " +
                  std::to_string(judgement.cases) + ": so few tell little of a person"};
    case PalpationVerdict::no_clear_case:
      return {"Passed?", "not judged", "no case was without a lump: nothing could be left alone"};
    default:
      break;
  }
  std::vector<std::string> below;
  for (const assess::Shortfall one : judgement.below) below.push_back(assess::wordsOf(one));
  const bool passed = judgement.verdict == PalpationVerdict::passed;
  return {
      "Passed?", passed ? "yes" : "no: " + assess::joinedWords(below),
      "asked for: " + assess::standardWords(standard) + "; reached: " + reachedWords(judgement)};
}

/// "2.4" and what it and the criterion mean.
Fact discriminationFact(const assess::PalpationJudgement& judgement) {
  const statistics::Detections& quarters = judgement.quarters;
  if (judgement.cases < assess::kEnoughCases)
    return {"d′", "–", "given from " + std::to_string(assess::kEnoughCases) + " cases on"};
  const statistics::Discrimination told = statistics::discriminationOf(quarters);
  if (!std::isfinite(told.d)) return {"d′", "–", "no case here tells it"};
  return {"d′", fixed(told.d, 1),
          std::to_string(quarters.signals) + " quarters with a lump told from " +
              std::to_string(quarters.rest) +
              " clear ones: 0 by chance, 3 nearly always; few quarters keep it low. Criterion " +
              fixed(told.criterion, 1) + ": above 0 marks too little, below 0 too readily"};
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
  const assess::PalpationJudgement judgement = judged(trials, standard);
  html.element("p", totalsSentence(sums));
  writeFactTable(
      html, {{"Lumps found", std::to_string(sums.found) + " of " + std::to_string(sums.lumps), ""},
             shareFact("Sensitivity", sums.found, sums.lumps, "of the lumps, those found"),
             shareFact("Specificity", sums.clear - sums.wrong, sums.clear,
                       "of the quarters without a lump, those left clear"),
             {"False alarms", std::to_string(sums.false_alarms), "marks where no lump is"},
             discriminationFact(judgement),
             {"At the standard",
              std::to_string(sums.passed) + " of " + numberOf(sums.trials, "trial", "trials"), ""},
             judgementFact(judgement, standard)});
  std::string note =
      "The intervals take all lumps, and all quarters, as independent of each other. In truth the "
      "doubt is larger.";
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
       "A false alarm in one of them lowers it; one in a quarter that has a lump does not."},
      {"Coverage",
       "The share of the area that was felt, at each pressure or a deeper one. Where nothing was "
       "felt, nothing can be found."},
      {"False alarm", "A mark with no lump near it."},
      {"At the standard",
       "In this trial enough lumps were found, enough of the area was felt, lightly and deeply, "
       "and "
       "there were no more false alarms than the task allows. One trial passes or fails nobody."},
      {"d′",
       "How well quarters with a lump are told from clear ones, whichever way doubt is settled: "
       "marking everything finds every lump but does not raise it."},
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
      "The interval: E. B. Wilson, J. Am. Stat. Assoc. 22, 1927. d′ with the log-linear rule: "
      "M. J. Hautus, Behav. Res. Methods 27, 1995.");
}

}  // namespace palpa::report

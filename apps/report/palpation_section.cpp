#include "apps/report/palpation_section.h"

#include "apps/assess/palpation/palpation_judgement.h"
#include "apps/report/coverage_chart.h"
#include "apps/report/numbers.h"
#include "apps/report/palpation_tables.h"
#include "apps/report/pictures.h"
#include "apps/report/pressing_chart.h"

namespace palpa::report {
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
  const bool counts = trial.facts.outcome != "void" && lumps > 0;
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
  tile("Area felt", fixed(100 * trial.score.coverage[0], 1) + " %");
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
  if (trial.facts.outcome == "void") return;
  html.element("h3", "What to do better");
  if (trial.advice.empty()) {
    html.element("p", "Nothing that these measures show.");
    return;
  }
  const auto list = html.in("ol", {{"class", "advice"}});
  for (const std::string& sentence : trial.advice) html.element("li", sentence);
}

}  // namespace

std::string palpationVerdict(const assess::PalpationAssessment& trial) {
  const std::string& outcome = trial.facts.outcome;
  if (outcome == "void") return "Not judged: void";
  if (outcome.empty()) return "Not judged: not finished";
  if (!assess::counts(trial))
    return "Not counted: " + (trial.facts.augmented ? std::string("cues were added to the forces")
                                                    : trial.facts.role);
  if (trial.passed) return "At the standard";
  if (outcome == "aborted") return "Below the standard: stopped early";
  return outcome == "time" ? "Below the standard: time limit reached" : "Below the standard";
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
    if (!trial.facts.role.empty()) html.element("span", {{"class", "role"}}, trial.facts.role);
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

}  // namespace palpa::report

#include "apps/report/verdict.h"

#include "apps/report/numbers.h"
#include "apps/report/score_table.h"

namespace palpa::report {
namespace {

const char* signPath(Tone tone) {
  switch (tone) {
    case Tone::good:
      return "M10 21l7 7 13-15";
    case Tone::bad:
      return "M12 12l16 16M28 12l-16 16";
    case Tone::guide:
      return "M20 9v13M20 29v1";
    default:
      return "M11 20h18";
  }
}

void writeSign(Html& html, Tone tone) {
  const auto svg =
      html.in("svg", {{"class", "sign"}, {"viewBox", "0 0 40 40"}, {"aria-hidden", "true"}});
  html.empty("circle", {{"cx", "20"}, {"cy", "20"}, {"r", "19"}});
  html.empty("path", {{"d", signPath(tone)}});
}

void writeTile(Html& html, const char* name, const std::string& value) {
  const auto tile = html.in("li");
  html.element("span", name);
  html.element("strong", value);
}

void writeTiles(Html& html, const assess::TrialAssessment& trial) {
  const auto tiles = html.in("ul", {{"class", "tiles"}});
  writeTile(html, "Duration", fixed(trial.values.time_ms / 1000, 1) + " s");
  if (trial.by_path) {
    writeTile(html, "Skin punctures", std::to_string(trial.skin_punctures));
    writeTile(html, "Redirections", std::to_string(trial.redirections));
  }
  writeTile(html, "Force feedback", trial.force_feedback ? "on" : "off");
  writeTile(html, "Seed", std::to_string(trial.seed));
}

void writeTotal(Html& html, const assess::TrialAssessment& trial) {
  const auto box = html.in("div", {{"class", "total"}});
  if (trial.outcome == "void" || trial.penalties.empty()) {
    html.element("strong", "–");
    html.element("span", "not scored");
    return;
  }
  html.element("strong", fixed(trial.total, 1));
  html.element("span", "penalty points");
  html.element("span", "lower is better");
}

}  // namespace

bool hasComplication(const assess::TrialAssessment& trial) {
  return trial.values.col_lung > 0 || trial.values.col_art > 0;
}

std::string outcomeWords(const assess::TrialAssessment& trial) {
  const std::string& outcome = trial.outcome;
  if (outcome == "success") {
    return hasComplication(trial) ? "Vein reached, with a complication" : "Successful";
  }
  if (outcome == "aborted") return "Not successful: aborted";
  if (outcome == "time") return "Not successful: time limit reached";
  if (outcome == "passes") return "Not successful: too many passes of the needle";
  if (outcome == "void") return "Void: does not count";
  return outcome.empty() ? "Not finished" : outcome;
}

std::string shortOutcome(const assess::TrialAssessment& trial) {
  if (trial.outcome == "success") return hasComplication(trial) ? "complication" : "success";
  return trial.outcome == "time"     ? "time limit"
         : trial.outcome == "passes" ? "too many passes"
                                     : trial.outcome;
}

Tone toneOfOutcome(const assess::TrialAssessment& trial) {
  if (trial.outcome == "success") return hasComplication(trial) ? Tone::guide : Tone::good;
  return trial.outcome == "aborted" || trial.outcome == "time" || trial.outcome == "passes"
             ? Tone::bad
             : Tone::neutral;
}

std::string largestReasons(const assess::TrialAssessment& assessment) {
  std::vector<std::string> reasons;
  for (const auto& penalty : byPoints(assessment.penalties)) {
    const bool small = reasons.size() == 2 && penalty.points < 0.1 * assessment.total;
    if (!(penalty.points > 0) || small || reasons.size() == 3) break;
    reasons.push_back(penalty.title + " (" + fixed(penalty.points, 1) + ")");
  }
  std::string text;
  for (std::size_t i = 0; i < reasons.size(); ++i) {
    text += (i == 0 ? "Most points: " : i + 1 < reasons.size() ? ", " : " and ") + reasons[i];
  }
  return text.empty() ? "" : text + ".";
}

void writeVerdict(Html& html, const assess::TrialAssessment& trial) {
  const Tone tone = toneOfOutcome(trial);
  {
    const auto box = html.in("div", {{"class", std::string("verdict ") + cssClass(tone)}});
    writeSign(html, tone);
    {
      const auto words = html.in("div", {{"class", "finding"}});
      {
        const auto line = html.in("p", {{"class", "outcome"}});
        html.text(outcomeWords(trial));
        if (trial.simulated) html.element("span", {{"class", "badge"}}, "simulated");
      }
      html.element("p", trial.summary);
      if (trial.outcome != "void") html.element("p", largestReasons(trial));
    }
    if (trial.by_path) writeTotal(html, trial);
  }
  writeTiles(html, trial);
}

}  // namespace palpa::report

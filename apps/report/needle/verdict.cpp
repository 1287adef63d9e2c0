#include <algorithm>
#include <cmath>

#include "apps/report/needle/trial_sections.h"
#include "apps/report/page/page_parts.h"
#include "apps/report/plot/chart_frame.h"
#include "apps/training/trial_words.h"

namespace palpa::report {

using training::Outcome;

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
  const bool blood = trial.by_path && trial.values.success;
  writeTile(html, blood ? "Until blood flowed" : "Duration",
            fixed(trial.values.time_ms / 1000, 1) + " s");
  if (trial.by_path) {
    writeTile(html, "Skin punctures", std::to_string(trial.skin_punctures));
    writeTile(html, "Redirections", std::to_string(trial.redirections));
  }
  writeTile(html, "Force feedback", trial.force_feedback ? "on" : "off");
  writeTile(html, "Seed", std::to_string(trial.seed));
}

void writeTotal(Html& html, const assess::TrialAssessment& trial) {
  const auto box = html.in("div", {{"class", "total"}});
  if (trial.outcome == Outcome::voided || trial.penalties.empty()) {
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
  const Outcome outcome = trial.outcome;
  if (outcome == Outcome::success) {
    return hasComplication(trial) ? "Vein reached, with a complication" : "Successful";
  }
  if (outcome == Outcome::aborted) return "Not successful: aborted";
  if (outcome == Outcome::time) return "Not successful: time limit reached";
  if (outcome == Outcome::passes) return "Not successful: too many passes of the needle";
  if (outcome == Outcome::mistaken) return "Not successful: what was aspirated was not recognised";
  if (outcome == Outcome::voided) return "Void: does not count";
  return outcome == Outcome::none ? "Not finished" : training::nameOf(outcome);
}

std::string shortOutcome(const assess::TrialAssessment& trial) {
  if (trial.outcome == Outcome::success) return hasComplication(trial) ? "complication" : "success";
  return trial.outcome == Outcome::time       ? "time limit"
         : trial.outcome == Outcome::passes   ? "too many passes"
         : trial.outcome == Outcome::mistaken ? "blood not recognised"
                                              : training::nameOf(trial.outcome);
}

Tone toneOfOutcome(const assess::TrialAssessment& trial) {
  if (trial.outcome == Outcome::success) return hasComplication(trial) ? Tone::guide : Tone::good;
  return trial.outcome == Outcome::aborted || trial.outcome == Outcome::time ||
                 trial.outcome == Outcome::passes || trial.outcome == Outcome::mistaken
             ? Tone::bad
             : Tone::neutral;
}

std::string largestReasons(const assess::TrialAssessment& assessment, bool first_told) {
  std::vector<std::string> reasons;
  for (const auto& penalty : byPoints(assessment.penalties)) {
    const bool small = reasons.size() == 2 && penalty.points < 0.1 * assessment.total;
    if (!(penalty.points > 0) || small || reasons.size() == 3) break;
    reasons.push_back(penalty.title + " (" + fixed(penalty.points, 1) + ")");
  }
  if (first_told && !reasons.empty()) reasons.erase(reasons.begin());
  std::string text;
  for (std::size_t i = 0; i < reasons.size(); ++i)
    text += (i > 0        ? i + 1 < reasons.size() ? ", " : " and "
             : first_told ? "Then: "
                          : "Most points: ") +
            reasons[i];
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
      const bool told = trial.summary.find("Largest penalty: ") != std::string::npos;
      const std::string reasons = largestReasons(trial, told);
      if (trial.outcome != Outcome::voided && !reasons.empty()) html.element("p", reasons);
    }
    if (trial.by_path) writeTotal(html, trial);
  }
  writeTiles(html, trial);
}

namespace {

constexpr Axis kScale{-5, 20, 12, 308};  // mm on px; wider distances stand at the edge
constexpr double kClose_mm = 3;          // said as "close" in words; ours, no clinical limit

std::string verdict(double distance_mm) {
  if (distance_mm < 0) return "inside";
  return distance_mm < kClose_mm ? "very close" : "clear";
}

void drawScale(Html& html, const std::string& organ, double distance_mm) {
  const std::string label =
      "Distance of the tip from the " + organ + ": " + fixed(distance_mm, 1) + " mm";
  const auto svg = html.in(
      "svg",
      {{"class", "scale"}, {"viewBox", "0 0 320 46"}, {"role", "img"}, {"aria-label", label}});
  svgRect(html, "inside-organ", kScale.at(-5), 8, kScale.at(0) - kScale.at(-5), 12);
  svgRect(html, "lane", kScale.at(0), 8, kScale.at(20) - kScale.at(0), 12);
  svgLine(html, "wall", kScale.at(0), 4, kScale.at(0), 24);
  for (const double value : {-5.0, 0.0, 5.0, 10.0, 15.0, 20.0}) {
    svgText(html, "tick mid", kScale.at(value), 40, fixed(value, 0));
  }
  const double x = kScale.at(std::clamp(distance_mm, kScale.from, kScale.to));
  html.empty("circle", {{"class", distance_mm < 0 ? "mark bad" : "mark plain"},
                        {"cx", coordinate(x)},
                        {"cy", "14"},
                        {"r", "7"}});
}

void writeOne(Html& html, const char* title, const std::string& organ, double distance_mm,
              double t_s) {
  const auto box = html.in("div", {{"class", "miss"}});
  html.element("h4", title);
  // Zero at time zero is how an assessment leaves them when nothing was measured.
  if (!std::isfinite(distance_mm) || (distance_mm == 0 && t_s == 0)) {
    html.element("p", {{"class", "muted"}}, "not measured");
    return;
  }
  {
    const auto line = html.in("p");
    html.element("strong", fixed(distance_mm, 1) + " mm");
    html.element("span", {{"class", distance_mm < 0 ? "badge bad" : "badge"}},
                 verdict(distance_mm));
    html.element("span", {{"class", "muted"}}, "at " + fixed(t_s, 1) + " s");
  }
  drawScale(html, organ, distance_mm);
}

}  // namespace

void writeNearMisses(Html& html, const assess::TrialAssessment& assessment) {
  html.element("h3", "Near misses");
  {
    const auto row = html.in("div", {{"class", "misses"}});
    writeOne(html, "Closest to the pleura", "pleura", assessment.closest_pleura_mm,
             assessment.closest_pleura_s);
    writeOne(html, "Closest to the artery", "artery", assessment.closest_artery_mm,
             assessment.closest_artery_s);
  }
  html.element("p", {{"class", "muted small"}},
               "Distance of the needle's tip from the wall, mm. Negative: the tip was inside.");
}

}  // namespace palpa::report

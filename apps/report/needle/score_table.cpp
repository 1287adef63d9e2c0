#include <algorithm>
#include <cmath>

#include "apps/report/needle/trial_sections.h"
#include "apps/report/page/page_parts.h"

namespace palpa::report {
namespace {

constexpr std::size_t kMostMoments = 6;

double finiteOrZero(double value) { return std::isfinite(value) ? value : 0; }

std::string momentsText(const std::vector<double>& moments_s) {
  std::string text;
  for (std::size_t i = 0; i < std::min(moments_s.size(), kMostMoments); ++i) {
    text += (i ? ", " : "at ") + fixed(moments_s[i], 1) + " s";
  }
  if (moments_s.size() > kMostMoments) {
    text += " and " + std::to_string(moments_s.size() - kMostMoments) + " more";
  }
  return text;
}

std::string valueText(const assess::Penalty& penalty) {
  const double size = std::fabs(finiteOrZero(penalty.value));
  const std::string& unit = penalty.unit;
  return trimmed(penalty.value, size >= 1000  ? 0
                                : size >= 100 ? 1
                                              : 2) +
         (unit.empty() ? "" : " " + unit);
}

void writeReason(Html& html, const assess::Penalty& penalty) {
  const auto cell = html.in("td", {{"class", "reason"}});
  html.element("strong", penalty.title);
  html.element("code", {{"translate", "no"}}, penalty.code);
  html.element("p", penalty.sentence);
  // One moment usually stands in the sentence; several are listed.
  if (penalty.moments_s.size() > 1) {
    html.element("p", {{"class", "muted"}}, momentsText(penalty.moments_s));
  }
}

void writePoints(Html& html, const assess::Penalty& penalty, double most) {
  const auto cell = html.in("td", {{"class", "points"}});
  html.element("strong", fixed(penalty.points, 1));
  const double share =
      most > 0 ? 100 * std::clamp(finiteOrZero(penalty.points) / most, 0.0, 1.0) : 0;
  const auto bar = html.in("svg", {{"class", "bar"},
                                   {"viewBox", "0 0 100 6"},
                                   {"preserveAspectRatio", "none"},
                                   {"role", "img"},
                                   {"aria-label", fixed(penalty.points, 1) + " points"}});
  html.empty("rect", {{"class", "lane"}, {"width", "100"}, {"height", "6"}});
  html.empty("rect", {{"class", "span bad"}, {"width", coordinate(share)}, {"height", "6"}});
}

void writeRow(Html& html, const assess::Penalty& penalty, double most) {
  const auto row = html.in("tr", {{"class", penalty.points > 0 ? "charged" : "clear"}});
  writeReason(html, penalty);
  html.element("td", {{"class", "sum"}}, valueText(penalty) + " × " + trimmed(penalty.weight, 3));
  writePoints(html, penalty, most);
}

/// "; without lung and artery, which this patient's model lacks"
std::string withoutWords(const std::vector<std::string>& organs) {
  std::string words;
  for (const std::string& organ : organs) words += (words.empty() ? "" : " and ") + organ;
  return words.empty() ? "" : "; without " + words + ", which this patient's model lacks";
}

void writeHead(Html& html) {
  const auto head = html.in("thead");
  const auto row = html.in("tr");
  html.element("th", {{"scope", "col"}}, "What was charged, and why");
  html.element("th", {{"scope", "col"}, {"class", "sum"}}, "value × weight");
  html.element("th", {{"scope", "col"}, {"class", "points"}}, "= points");
}

}  // namespace

std::vector<assess::Penalty> byPoints(std::vector<assess::Penalty> penalties) {
  std::stable_sort(penalties.begin(), penalties.end(), [](const auto& a, const auto& b) {
    return finiteOrZero(a.points) > finiteOrZero(b.points);
  });
  return penalties;
}

void writeScoreTable(Html& html, const assess::TrialAssessment& assessment) {
  const auto penalties = byPoints(assessment.penalties);
  if (penalties.empty()) {
    html.element("p", {{"class", "muted"}}, "This trial was not scored.");
    return;
  }
  const auto table = html.in("table", {{"class", "score"}});
  writeHead(html);
  {
    const auto body = html.in("tbody");
    for (const auto& penalty : penalties) writeRow(html, penalty, penalties.front().points);
  }
  const auto foot = html.in("tfoot");
  const auto row = html.in("tr");
  html.element("td", "Total penalty (lower is better)" + withoutWords(assessment.not_judged));
  html.element("td", {{"class", "sum"}}, "");
  const auto cell = html.in("td", {{"class", "points"}});
  html.element("strong", fixed(assessment.total, 1));
}

namespace {

constexpr Code kCodes[] = {
    {"COL_LUNG", "Scoring samples, 20 a second, in which the needle was in contact with the lung."},
    {"COL_RIB",
     "Contacts with ribs and skeleton, each counted again for every full second that it lasts; "
     "when scored as published, samples as above. Touching the clavicle lightly to find the way "
     "beneath it does not count."},
    {"COL_ART", "The same for arteries."},
    {"COL_VEIN",
     "Contact with the vein other than the successful entry and aspiration; its back wall always "
     "counts."},
    {"PHASE_1",
     "Insertion: distance of the entry point from the optimum, plus the error in depth before the "
     "needle is turned."},
    {"PHASE_2",
     "Direction: deviation of the turned needle from the optimum. 1000 is as far as "
     "experts vary; below it nothing is charged. The weight rises from there to 2000; when "
     "scored as published, it jumps at both."},
    {"ECON_MEAN",
     "Economy of movement: mean distance of the needle from the optimal line while it is "
     "advanced."},
    {"ECON_VAR", "Economy of movement: variance of that distance; a steady hand has little."},
    {"TIME", "From the start of the trial to its end."},
    {"TOTAL", "Sum of weight × value over all of the above. Lower is better."}};

}  // namespace

void writeGlossary(Html& html) {
  html.element("h2", "What these numbers mean");
  {
    const auto list = html.in("dl", {{"class", "glossary"}});
    for (const Code& entry : kCodes) {
      html.element("dt", {{"translate", "no"}}, entry.code);
      html.element("dd", entry.meaning);
    }
  }
  html.element(
      "p", {{"class", "muted"}},
      "Source: C. S. Tzafestas, K. Birbas, Y. Koumpouros, D. Christopoulos: Pilot Evaluation "
      "Study of a Virtual Paracentesis Simulator for Skill Training and Assessment: The "
      "Beneficial Effect of Haptic Display. Presence 17(2), 212–229, 2008.");
}

}  // namespace palpa::report

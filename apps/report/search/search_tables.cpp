#include "apps/report/search/search_sections.h"
#include "apps/training/trial_words.h"

#include <array>
#include <cmath>
#include <numbers>
#include <utility>

#include "apps/report/page/page_parts.h"
#include "apps/report/page/style.h"

namespace palpa::report {

using training::Outcome;

namespace {

constexpr double kSignHalf = 24, kSignCircle = 48.0 / 240 * 200 / 3,
                 kSignElement = 48.0 / 240 * 25;  // px: the floor is 240 U wide

/// x to the right, y up, from the middle of the sign.
std::pair<double, double> elementAt(const assess::SearchTrial& trial, int element) {
  const double angle = (trial.orientation_deg + 120.0 * element) * std::numbers::pi / 180;
  return {kSignCircle * std::cos(angle), kSignCircle * std::sin(angle)};
}

/// "at the upper left", by eighths of a turn.
std::string whereWords(const assess::SearchTrial& trial, int element) {
  static constexpr std::array<const char*, 8> kWhere{
      "at the right", "at the upper right", "at the top",    "at the upper left",
      "at the left",  "at the lower left",  "at the bottom", "at the lower right"};
  const auto [x, y] = elementAt(trial, element);
  const long eighth = std::lround(std::atan2(y, x) / (std::numbers::pi / 4));
  return kWhere[static_cast<std::size_t>((eighth + 8) % 8)];
}

std::string placeWordsOf(const assess::SearchTrial& trial) {
  const std::string target = "Target " + whereWords(trial, trial.target);
  if (!assess::chose(trial)) return target + ", none chosen";
  return trial.found() ? target + ", chosen"
                       : target + ", chosen the one " + whereWords(trial, trial.chosen);
}

void drawSignElement(Html& html, const assess::SearchTrial& trial, int element) {
  const std::pair<double, double> at = elementAt(trial, element);
  const auto disc = [&](const char* css, double radius) {
    html.empty("circle", {{"class", css},
                          {"cx", coordinate(kSignHalf + at.first)},
                          {"cy", coordinate(kSignHalf - at.second)},
                          {"r", coordinate(radius)}});
  };
  disc(element == trial.target ? "element target" : "element", kSignElement);
  if (assess::chose(trial) && element == trial.chosen)
    disc(trial.found() ? "choice" : "choice other", kSignElement + 3.5);
}

/// "found", "another element", "none: time over", "void".
std::string resultWords(const assess::SearchTrial& trial) {
  if (trial.outcome == Outcome::voided) return "void";
  if (assess::chose(trial)) return trial.found() ? "found" : "another element";
  return trial.outcome == Outcome::time      ? "none: time over"
         : trial.outcome == Outcome::aborted ? "none: aborted"
                                             : "none";
}

std::string onTarget(const assess::SearchTrial& trial) {
  double all = 0;
  for (const double seconds : trial.visited_s) all += seconds;
  const double target = trial.target >= 0 && trial.target < 3
                            ? trial.visited_s[static_cast<std::size_t>(trial.target)]
                            : 0;
  return fixed(target, 1) + " of " + fixed(all, 1);
}

void writeEpisodeRow(Html& html, const assess::SearchTrial& t) {
  const auto row = html.in("tr", {{"id", "trial-" + std::to_string(t.trial)}});
  {
    const auto cell = html.in("th", {{"scope", "row"}});
    html.text(std::to_string(t.trial));
    if (!assess::counts(t)) html.element("span", {{"class", "aside"}}, "not counted");
  }
  {
    const auto cell = html.in("td", {{"class", "words"}});
    html.text(stiffnessWords(t.mode));
    if (!t.block.empty()) html.element("span", {{"class", "aside"}}, t.block);
    if (!t.force_feedback) html.element("span", {{"class", "aside"}}, "no force feedback");
  }
  {
    const auto cell = html.in("td");
    writePlaceSign(html, t);
  }
  {
    const auto cell = html.in("td", {{"class", "words"}});
    html.element(
        "span",
        {{"class", std::string("dot ") + cssClass(toneOfEpisode(t))}, {"title", summaryOf(t)}},
        resultWords(t));
  }
  for (const std::string& text : {fixed(t.seconds, 1), onTarget(t), fixed(t.path_m, 2),
                                  fixed(t.mean_force_N, 2), fixed(t.peak_force_N, 2)})
    html.element("td", text);
}

}  // namespace

void writePlaceSign(Html& html, const assess::SearchTrial& trial) {
  const std::string words = placeWordsOf(trial);
  const auto svg = html.in(
      "svg",
      {{"class", "place"}, {"viewBox", "0 0 48 48"}, {"role", "img"}, {"aria-label", words}});
  html.element("title", words);
  html.empty("rect", {{"class", "floor"},
                      {"x", "0.5"},
                      {"y", "0.5"},
                      {"width", "47"},
                      {"height", "47"},
                      {"rx", "3"}});
  for (int element = 0; element < 3; ++element) drawSignElement(html, trial, element);
}

void writeEpisodes(Html& html, const SearchReport& report) {
  const auto section = html.in("section", {{"class", "card"}, {"id", "episodes"}});
  html.element("h2", "Every episode");
  {
    const auto scroll = html.in("div", {{"class", "scroll"}, {"tabindex", "0"}});
    const auto table = html.in("table", {{"class", "episodes"}});
    {
      const auto head = html.in("thead");
      const auto row = html.in("tr");
      for (const char* column : {"Episode", "Floor", "Where", "Result", "Time, s", "On target, s",
                                 "Path, m", "Mean force, N", "Largest, N"})
        html.element("th", {{"scope", "col"}}, column);
    }
    const auto body = html.in("tbody");
    for (const assess::SearchTrial& trial : report.trials) writeEpisodeRow(html, trial);
  }
  std::string note =
      "Where: the floor from above, the target filled, the chosen element ringed, dashed where it "
      "was not the target. On target: of the time on the three elements. Path: of the probe, in "
      "the hand. Forces: what the device gave, in contact.";
  if (!report.unit_note.empty()) note += " How large the floor is: " + report.unit_note + ".";
  html.element("p", {{"class", "muted small"}}, note);
}

void writeDoses(Html& html, const SearchReport& report) {
  Html tables;
  for (const assess::SearchMode mode :
       {assess::SearchMode::real, assess::SearchMode::degraded, assess::SearchMode::augmented}) {
    std::vector<std::vector<assess::SubtaskDose>> doses;
    double seconds = 0;
    for (const assess::SearchTrial& trial : report.trials) {
      if (trial.mode != mode || trial.outcome == Outcome::voided) continue;
      doses.push_back(trial.doses);
      seconds += trial.seconds;
    }
    const std::vector<assess::SubtaskDose> sums = dosesSummed(doses);
    if (sums.empty()) continue;
    const std::string words = stiffnessWords(mode);
    tables.element("h3", static_cast<char>(words[0] - 'a' + 'A') + words.substr(1) + ", " +
                             std::to_string(doses.size()) +
                             (doses.size() == 1 ? " episode" : " episodes"));
    writeSubtaskTable(tables, sums, report.subtasks, seconds);
  }
  if (tables.str().empty()) return;
  const auto section = html.in("section", {{"class", "card"}, {"id", "parts"}});
  html.element("h2", "The parts of the task, and what the cues added");
  html.append(tables);
  writeSubtaskNote(html);
}

void writeSearchGlossary(Html& html) {
  static constexpr std::pair<const char*, const char*> kMeanings[] = {
      {"Search",
       "A probe is led over a floor that is felt and not seen. Three elements lie on it: a rough "
       "disc with a pit in its middle and a groove around it. They are alike but for their "
       "roughness: the target's "
       "bumps are larger and farther apart. The episode ends when the probe has stayed in one of "
       "the pits; that element is the choice."},
      {"Full stiffness",
       "The floor is as hard as this device can safely be. It is what the others are compared "
       "with."},
      {"Degraded",
       "A fifth of that stiffness, as on a simpler device: edges and bumps give way under the "
       "probe and are felt less clearly."},
      {"Augmented",
       "The degraded floor with cues: small forces that are not in a real floor and make plainer "
       "what the soft one blurs. Each belongs to one part of the task and is felt only there."},
      {"Given back",
       "Of the targets that are found with full stiffness and no longer with the degraded one, the "
       "share that is found again with the cues. 0 %: they help nothing; 100 %: as good as full "
       "stiffness."},
      {"By chance", "Whoever chooses blindly finds the target in one of three episodes."},
      {"95 % interval", "What the true figure may well be, as few episodes tell little."}};
  html.element("h2", "What these words mean");
  {
    const auto list = html.in("dl", {{"class", "glossary"}});
    for (const auto& [word, meaning] : kMeanings) {
      html.element("dt", word);
      html.element("dd", meaning);
    }
  }
  html.element("p", {{"class", "muted small"}},
               "Sources. The task and its cues: T. Edmunds, D. K. Pai, Perceptually augmented "
               "simulator design, IEEE Trans. Haptics 5, 2012. Shares: E. B. Wilson, J. Am. Stat. "
               "Assoc. 22, 1927. What was given back: bootstrap over "
               "episodes, B. Efron, Ann. Stat. 7, 1979.");
}

}  // namespace palpa::report

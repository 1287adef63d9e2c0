#include "apps/assess/palpation/palpation_words.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>

#include "apps/assess/palpation/coverage_map.h"
#include "apps/assess/palpation/palpation_score.h"
#include "apps/training/trial_words.h"

namespace palpa::assess {

using training::Outcome;

namespace {

std::string decimalWords(double value, int decimals) {
  if (!std::isfinite(value)) return "?";
  char text[400];  // the largest double has 309 digits before the point
  return {text,
          std::to_chars(text, text + sizeof text, value, std::chars_format::fixed, decimals).ptr};
}

std::string lumpsFoundWords(const PalpationScore& score) {
  const int lumps = score.found + score.missed;
  if (lumps == 1) return score.found == 1 ? "Found the only lump" : "Missed the only lump";
  if (score.missed == 0)
    return lumps == 2 ? "Found both lumps" : "Found all " + std::to_string(lumps) + " lumps";
  return "Found " + (score.found == 0 ? std::string("none") : std::to_string(score.found)) +
         " of " + std::to_string(lumps) + " lumps";
}

std::string falseAlarmWords(int count) {
  if (count == 0) return "no false alarm";
  return count == 1 ? "one false alarm" : std::to_string(count) + " false alarms";
}

std::string withoutLumpsWords(int marked) {
  if (marked == 0) return "There was no lump, and none was marked";
  return "There was no lump, but " +
         (marked == 1 ? std::string("one was marked") : std::to_string(marked) + " were marked");
}

/// How it ended, where that is not by the trainee's own "done".
std::string endWords(Outcome outcome) {
  if (outcome == Outcome::time) return " when time ran out";
  return outcome == Outcome::aborted ? " when the search was stopped early" : "";
}

}  // namespace

std::string percentWords(double share) {
  const double tenths = std::floor(1000 * share + 1e-9);
  const bool whole = !std::isfinite(tenths) || std::fmod(tenths, 10) == 0;
  return decimalWords(tenths / 10, whole ? 0 : 1) + " %";
}
std::string newtonWords(double newtons) { return decimalWords(newtons, 1) + " N"; }

std::string joinedWords(const std::vector<std::string>& parts) {
  std::string words;
  for (std::size_t i = 0; i < parts.size(); ++i)
    words += (i == 0 ? "" : i + 1 == parts.size() ? " and " : ", ") + parts[i];
  return words;
}

std::string palpationSummary(const PalpationFacts& facts, const PalpationScore& score) {
  if (facts.outcome == Outcome::voided) return "This search is void and does not count.";
  const bool none = score.found + score.missed == 0;
  const std::string found =
      none ? withoutLumpsWords(score.false_alarms)
           : lumpsFoundWords(score) + ", " + falseAlarmWords(score.false_alarms);
  return found + "; " + percentWords(score.coverage[0]) + " of the area was felt" +
         (facts.taken_away ? "; the real lump was taken away" : "") + endWords(facts.outcome) + ".";
}

const char* wordsOf(Shortfall below) {
  switch (below) {
    case Shortfall::sensitivity:
      return "too few lumps found";
    case Shortfall::coverage:
      return "too little of the area felt";
    case Shortfall::deep_coverage:
      return "too little felt deeply";
    case Shortfall::false_alarms:
      break;
  }
  return "too many false alarms";
}

std::string standardWords(const PalpationStandard& standard) {
  std::string words = percentWords(standard.sensitivity) + " of the lumps and " +
                      percentWords(standard.coverage) + " of the area";
  if (standard.deep_coverage > 0)
    words += ", " + percentWords(standard.deep_coverage) + " of it deeply";
  if (!std::isfinite(standard.false_alarms)) return words;
  const bool whole = standard.false_alarms == std::floor(standard.false_alarms);
  return words + ", with no more than " + decimalWords(standard.false_alarms, whole ? 0 : 1) +
         (standard.false_alarms == 1 ? " false alarm a case" : " false alarms a case");
}

namespace {

constexpr double kTooHard = 0.01,
                 // Of the time of touching [chosen: every press begins and ends lightly, that alone
                 // is about 0.15]
    kTooLight = 0.4;
constexpr double kDeeply = 0.5;    // of the area felt deeply, where no standard asks [chosen]
constexpr double kCloser = 1.05;   // times the force of searching
constexpr int kFewestPresses = 8;  // below it nothing can be said of a pattern

struct AdviceSource {
  const PalpationAssessment& of;
  const PalpationRules& rules;
  const PalpationStandard& standard;
  CoverageMap map;
};

/// How firmly the very place of a lump has been felt.
int levelAt(const AdviceSource& source, const Vec3& p_P) {
  const auto cell = [](double x, double half, int count) {
    return std::clamp(static_cast<int>(std::floor((x + half) / (2 * half) * count)), 0, count - 1);
  };
  return source.map.level(cell(p_P.x(), source.rules.area.half_x, source.map.columns()),
                          cell(p_P.y(), source.rules.area.half_y, source.map.rows()));
}

const char* missedReason(int level, bool one) {
  switch (level) {
    case 0:
      return one ? "its middle was never felt. Cover the whole area before you finish."
                 : "their middles were never felt. Cover the whole area before you finish.";
    case 1:
      return one ? "its place was felt, but only lightly. Feel every place with light, medium and "
                   "deep pressure."
                 : "their places were felt, but only lightly. Feel every place with light, medium "
                   "and deep pressure.";
    case 2:
      return one ? "its place was felt with medium pressure, but never deeply. A lump that lies "
                   "deep shows only under deep pressure."
                 : "their places were felt with medium pressure, but never deeply. A lump that "
                   "lies deep shows only under deep pressure.";
    default:
      return one ? "its place was felt firmly, but passed over. Slow down, and look closer "
                   "wherever something feels different."
                 : "their places were felt firmly, but passed over. Slow down, and look closer "
                   "wherever something feels different.";
  }
}

std::string lumpPlaceWords(const AdviceSource& source, const CaseLump& lump) {
  return std::to_string(std::lround(1000 * lump.diameter)) + " mm, " +
         placeWords(source.rules.area, lump.p_P);
}

/// One sentence for each reason, the coarsest fault first.
void adviseMissed(const AdviceSource& source, std::vector<std::string>* advice) {
  std::array<std::vector<std::string>, kPressureLevels + 1> missed;
  for (std::size_t i = 0; i < source.of.lumps.size(); ++i) {
    const CaseLump& lump = source.of.lumps[i];
    if (source.of.score.lumps[i].mark < 0)
      missed[static_cast<std::size_t>(levelAt(source, lump.p_P))].push_back(
          lumpPlaceWords(source, lump));
  }
  for (std::size_t level = 0; level < missed.size(); ++level) {
    const std::size_t count = missed[level].size();
    if (count == 0) continue;
    std::string places;
    for (const std::string& place : missed[level]) places += (places.empty() ? "" : "; ") + place;
    const std::string lumps = count == 1
                                  ? "One lump (" + places + ") was missed: "
                                  : std::to_string(count) + " lumps (" + places + ") were missed: ";
    advice->push_back(lumps + missedReason(static_cast<int>(level), count == 1));
  }
}

/// By name, each once.
void adviseNormal(const std::vector<std::string>& taken, std::vector<std::string>* advice) {
  if (!taken.empty())
    advice->push_back("Marked as a lump, but normal here: " + joinedWords(taken) +
                      ". What belongs there runs on to both sides; a lump ends all around.");
}

void addOnce(std::vector<std::string>* words, const std::string& word) {
  if (std::find(words->begin(), words->end(), word) == words->end()) words->push_back(word);
}

void adviseFalseAlarms(const AdviceSource& source, std::vector<std::string>* advice) {
  std::vector<std::string> places, normal;
  for (std::size_t i = 0; i < source.of.marks.size(); ++i) {
    if (meaningOf(i, source.rules, source.of.score, source.of.lumps, source.of.marks) !=
        MarkMeaning::false_alarm)
      continue;
    const NormalAnatomy* on =
        anatomyAt(source.rules.normal, source.of.marks[i].p_P, source.rules.reach);
    addOnce(on ? &normal : &places,
            on ? on->name : placeWords(source.rules.area, source.of.marks[i].p_P));
  }
  adviseNormal(normal, advice);
  const int count = source.of.score.false_alarms - source.of.score.of_normal;
  if (count == 0) return;
  const std::string marks =
      count == 1 ? "One mark was no lump (" : std::to_string(count) + " marks were no lumps (";
  advice->push_back(marks + joinedWords(places) +
                    "). Before you mark, press from several sides: a lump has an edge all around.");
}

void adviseArea(const AdviceSource& source, std::vector<std::string>* advice) {
  const double felt = source.of.score.coverage[0];
  if (felt >= source.standard.coverage) return;
  if (felt <= 0)
    return advice->push_back("Nothing was felt: no press reached " +
                             newtonWords(source.rules.levels[0]) +
                             ", the lightest pressure that counts.");
  const std::vector<std::string> quarters = unfeltQuarters(source.map);
  const std::string where =
      quarters.size() == 4 ? "in all quarters" : "mainly " + joinedWords(quarters);
  advice->push_back("Only " + percentWords(felt) + " of the area was felt, " +
                    percentWords(source.standard.coverage) +
                    " is the standard. What is left lies " + where +
                    ": go up to the edges, and let the strips overlap.");
}

double deeply(const PalpationStandard& standard) {
  return standard.deep_coverage > 0 ? standard.deep_coverage : kDeeply;
}

void adviseForce(const AdviceSource& source, std::vector<std::string>* advice) {
  const PalpationScore& score = source.of.score;
  if (score.too_hard > kTooHard) {
    advice->push_back("Pressed too hard: above " + newtonWords(source.rules.too_hard) + " for " +
                      percentWords(score.too_hard) + " of the time of touching, up to " +
                      newtonWords(score.peak) + ". On a person this can hurt.");
  }
  if (score.too_light > kTooLight) {
    advice->push_back(
        "Pressed too lightly: below " + newtonWords(source.rules.levels[0]) + " for " +
        percentWords(score.too_light) +
        " of the time of touching. So light a touch tells little of what lies below.");
  } else if (score.coverage[0] > 0 && score.coverage.back() < deeply(source.standard)) {
    advice->push_back("Only " + percentWords(score.coverage.back()) +
                      " of the area was felt deeply (" + newtonWords(source.rules.levels.back()) +
                      " or more). Go through light, medium and deep pressure at every place.");
  }
}

void adviseSearch(const AdviceSource& source, std::vector<std::string>* advice) {
  const PalpationScore& score = source.of.score;
  if (score.pattern.pattern == SearchPattern::none && score.presses >= kFewestPresses)
    advice->push_back(
        "No pattern was recognised in the search. Go up and down in strips, one beside the other: "
        "vertical strips miss least.");
  if (score.closer_force > 0 && score.closer_force < kCloser)
    advice->push_back(
        "Closer looks were made with no more force than the search. Successful clinicians press "
        "about 15 % more when they look closer.");
}

}  // namespace

std::vector<std::string> palpationAdvice(const PalpationAssessment& assessment,
                                         const PalpationRules& rules,
                                         const PalpationStandard& standard,
                                         PalpationSamples samples) {
  if (assessment.facts.outcome == Outcome::voided) return {};
  AdviceSource source{assessment, rules, standard,
                      CoverageMap(rules.area, rules.levels, rules.reach)};
  for (const PalpationSample& sample : samples) source.map.add(sample);
  std::vector<std::string> advice;
  adviseMissed(source, &advice);
  adviseFalseAlarms(source, &advice);
  adviseArea(source, &advice);
  adviseForce(source, &advice);
  adviseSearch(source, &advice);
  return advice;
}

}  // namespace palpa::assess

#include "apps/assess/palpation/palpation_words.h"

#include <charconv>
#include <cmath>

namespace palpa::assess {
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
std::string endWords(const std::string& outcome) {
  if (outcome == "time") return " when time ran out";
  return outcome == "aborted" ? " when the search was stopped early" : "";
}

}  // namespace

std::string percentWords(double share) {
  return decimalWords(std::floor(100 * share + 1e-9), 0) + " %";
}
std::string newtonWords(double newtons) { return decimalWords(newtons, 1) + " N"; }

std::string joinedWords(const std::vector<std::string>& parts) {
  std::string words;
  for (std::size_t i = 0; i < parts.size(); ++i)
    words += (i == 0 ? "" : i + 1 == parts.size() ? " and " : ", ") + parts[i];
  return words;
}

std::string palpationSummary(const PalpationFacts& facts, const PalpationScore& score) {
  if (facts.outcome == "void") return "This search is void and does not count.";
  const bool none = score.found + score.missed == 0;
  const std::string found =
      none ? withoutLumpsWords(score.false_alarms)
           : lumpsFoundWords(score) + ", " + falseAlarmWords(score.false_alarms);
  return found + "; " + percentWords(score.coverage[0]) + " of the area was felt" +
         endWords(facts.outcome) + ".";
}

}  // namespace palpa::assess

#include "apps/report/search/search_sections.h"

#include <algorithm>

#include "apps/report/page/page_parts.h"

namespace palpa::report {
namespace {

using assess::SearchMode;

constexpr std::uint64_t kIntervalSeed = 1;  // the same session, the same page
constexpr double kOneOfThree = 1.0 / 3;

std::string wholePercent(double share) { return fixed(100 * share, 0) + " %"; }

std::string episodesWith(SearchMode mode) {
  switch (mode) {
    case SearchMode::degraded:
      return " with degraded stiffness";
    case SearchMode::augmented:
      return " with degraded stiffness and cues";
    default:
      return " with full stiffness";
  }
}

bool anyWith(const std::vector<assess::SearchTally>& tallies, SearchMode mode) {
  return std::any_of(tallies.begin(), tallies.end(),
                     [&](const assess::SearchTally& tally) { return tally.mode == mode; });
}

bool severalBlocks(const std::vector<assess::SearchTally>& tallies) {
  return std::any_of(tallies.begin(), tallies.end(), [&](const assess::SearchTally& tally) {
    return tally.block != tallies.front().block;
  });
}

std::string recoveredWords(const assess::Recovery& recovery) {
  std::string words = recovery.share > 0
                          ? "Of what is lost without full stiffness, the cues gave back " +
                                wholePercent(recovery.share)
                          : "The cues gave back nothing of what is lost without full stiffness (" +
                                wholePercent(recovery.share) + ")";
  if (!recovery.bounded())
    return words +
           ". How much it truly is these episodes do not tell: full and degraded stiffness were "
           "too alike, or there were too few.";
  words +=
      ", 95 % interval " + wholePercent(recovery.low) + " to " + wholePercent(recovery.high) + ". ";
  return words + (recovery.low > 0
                      ? "So the cues helped; 100 % would be as good as full stiffness."
                      : "The interval holds 0 %: it may be that the cues do not help.");
}

}  // namespace

const char* stiffnessWords(SearchMode mode) {
  return mode == SearchMode::real       ? "full stiffness"
         : mode == SearchMode::degraded ? "degraded stiffness"
                                        : "degraded, with cues";
}

std::string foundSentence(const assess::SearchTally& t) {
  std::string sentence = (t.block.empty() ? "In " : "Block " + t.block + ": in ") +
                         std::to_string(t.found) + " of " + std::to_string(t.episodes) +
                         (t.episodes == 1 ? " episode" : " episodes");
  sentence += episodesWith(t.mode) + " the target was found, 95 % interval " +
              wholePercent(t.found_low) + " to " + wholePercent(t.found_high) + ".";
  if (t.found_low <= kOneOfThree && t.found_high >= kOneOfThree)
    sentence += " That may have been chance.";
  if (t.chosen > 0) sentence += " The choice took " + fixed(t.seconds_median, 0) + " s (median).";
  if (t.chosen < t.episodes)
    sentence += " In " + std::to_string(t.episodes - t.chosen) + " of them nothing was chosen.";
  return sentence;
}

std::string recoverySentence(const std::vector<assess::SearchTrial>& trials, std::uint64_t seed) {
  const std::vector<assess::SearchTally> tallies = assess::talliesOf(trials);
  if (!anyWith(tallies, SearchMode::augmented)) return "";
  if (!anyWith(tallies, SearchMode::real) || !anyWith(tallies, SearchMode::degraded))
    return "How much the cues give back is told only by episodes of all three kinds: full "
           "stiffness, degraded, and degraded with cues.";
  const std::optional<assess::Recovery> recovery = assess::recoveryOf(trials, seed);
  if (!recovery)
    return "The target was found no more often with full stiffness than with degraded: nothing was "
           "lost that cues could give back.";
  return recoveredWords(*recovery) +
         (severalBlocks(tallies)
              ? " All blocks are taken together, so what was learnt between them is part of it."
              : "");
}

void writeSearchFindings(Html& html, const std::vector<assess::SearchTrial>& trials) {
  const auto section = html.in("section", {{"class", "card"}, {"id", "found"}});
  html.element("h2", "Was the target found?");
  html.element("p", {{"class", "muted"}},
               "Three elements on a floor that is felt and not seen: which one is rougher? Whoever "
               "guesses is right in one of three episodes.");
  const std::vector<assess::SearchTally> tallies = assess::talliesOf(trials);
  if (tallies.empty()) {
    html.element("p", "No episode counts: none was both scored and valid.");
    return;
  }
  {
    const auto list = html.in("ul", {{"class", "findings"}});
    for (const assess::SearchTally& tally : tallies) html.element("li", foundSentence(tally));
  }
  if (const std::string recovered = recoverySentence(trials, kIntervalSeed); !recovered.empty())
    html.element("p", {{"class", "recovered"}}, recovered);
  writeFoundChart(html, tallies);
  const auto left_out =
      std::count_if(trials.begin(), trials.end(),
                    [](const assess::SearchTrial& trial) { return !assess::counts(trial); });
  if (left_out > 0)
    html.element("p", {{"class", "muted small"}},
                 std::to_string(left_out) + (left_out == 1 ? " episode is" : " episodes are") +
                     " not counted here: training, not scored, or void.");
}

}  // namespace palpa::report

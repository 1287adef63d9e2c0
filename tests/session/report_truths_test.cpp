#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <regex>

#include "apps/session/comparison_session.h"
#include "apps/session/palpation_session.h"
#include "apps/session/pulse_session.h"
#include "apps/session/search_session.h"
#include "tests/session/page_lines.h"
#include "tests/session/quick_sessions.h"
#include "tests/support/counts.h"

/// The pages of the tasks besides the needle's contradict themselves nowhere: sums, shares,
/// verdicts and advice of simulated trials agree with the trials that they are of.
namespace palpa::session {
namespace {

using Lines = std::vector<std::string>;
using test::found;
using test::linesOf;
using test::numberIn;

bool says(const Lines& lines, const std::string& words) {
  return std::any_of(lines.begin(), lines.end(), [&](const std::string& line) {
    return line.find(words) != std::string::npos;
  });
}

/// The line after the one that is `words`.
std::string after(const Lines& lines, const std::string& words) {
  const auto at = std::find(lines.begin(), lines.end(), words);
  return at == lines.end() || at + 1 == lines.end() ? "" : at[1];
}

std::string ofWords(std::ptrdiff_t some, std::ptrdiff_t all) {
  return std::to_string(some) + " of " + std::to_string(all);
}

/// Squeeze and friction: "Right: the first one was harder, by 25 %.", then "125 %", "100 %".
void expectAnswersAgree(const Lines& lines) {
  std::map<std::string, std::array<int, 2>> answers;  // property: right, all
  const std::regex answer("^(Right|Wrong): the (first|second) one was (\\w+), by (\\d+) %\\.$");
  std::smatch told;
  for (std::size_t i = 0; i + 2 < lines.size(); ++i) {
    if (!std::regex_match(lines[i], told, answer)) continue;
    std::array<int, 2>& of = answers[told[3]];
    of[0] += told[1] == "Right";
    ++of[1];
    const double first = numberIn(lines[i + 1]) / 100, second = numberIn(lines[i + 2]) / 100;
    EXPECT_EQ(first > second, told[2] == "first") << lines[i];
    const double high = std::max(first, second), low = std::min(first, second),
                 more = std::stod(told[4]) / 100 + 1;
    EXPECT_GE((high + 0.005) / (low - 0.005), more - 0.005) << lines[i];
    EXPECT_LE((high - 0.005) / (low + 0.005), more + 0.005) << lines[i];
  }
  EXPECT_FALSE(answers.empty());
  for (const auto& [property, of] : answers) {
    const std::string sentence = after(lines, "Which one is " + property + "?");
    EXPECT_EQ(sentence.rfind("Answers right: " + ofWords(of[0], of[1]) + '.', 0), 0u) << sentence;
    EXPECT_EQ(sentence.find("All answers were right") != std::string::npos, of[0] == of[1]);
  }
}

/// A search: each episode's mode, result, and of its time how much on the target.
void expectEpisodesAgree(const Lines& lines) {
  std::map<std::string, std::array<int, 3>> modes;  // found, chosen, all
  double seconds = 0;
  const auto table = std::find(lines.begin(), lines.end(), "Every episode");
  ASSERT_NE(table, lines.end());
  for (auto row = table; row + 5 < lines.end(); ++row) {
    std::smatch on;
    if (!std::regex_match(row[4], on, std::regex("([\\d.]+) of ([\\d.]+)"))) continue;
    std::array<int, 3>& of = modes[row[1]];
    of[0] += row[2] == "found";
    of[1] += row[2] == "found" || row[2] == "another element";
    ++of[2];
    seconds = numberIn(row[3]);
    EXPECT_LE(std::stod(on[1]), std::stod(on[2]) + 0.05) << row[0];
    EXPECT_LE(std::stod(on[2]), seconds + 0.1) << row[0];
  }
  EXPECT_FALSE(modes.empty());
  for (const auto& [mode, of] : modes) {
    const auto told = found(lines, "[Ii]n (\\d+) of (\\d+) episodes? with " + mode +
                                       " the target was found, 95 % interval (\\d+) % to (\\d+) %"
                                       "\\.( That may have been chance\\.)?");
    ASSERT_EQ(told.size(), 6u) << mode;
    EXPECT_EQ(ofWords(of[0], of[2]), told[1] + " of " + told[2]) << mode;
    const double share = 100.0 * of[0] / of[2], low = std::stod(told[3]), high = std::stod(told[4]);
    EXPECT_LE(low, share + 0.5);
    EXPECT_GE(high, share - 0.5);
    EXPECT_EQ(!told[5].empty(), low <= 100.0 / 3 && high >= 100.0 / 3) << told[0];
    EXPECT_EQ(of[1] > 0, says(lines, "The choice took ")) << mode;
    EXPECT_EQ(of[1] < of[2], says(lines, "of them nothing was chosen.")) << mode;
  }
}

/// A pulse: what the table of trials, the first sentence and the checklist say of the same thing.
void expectPulsesAgree(const Lines& lines) {
  const auto beside = found(lines, "^Marked beside it, mm \\(found: up to ([\\d.]+)\\)$"),
             right = found(lines, "^Counted a minute \\(right: within ([\\d.]+)\\)$");
  ASSERT_EQ(beside.size(), 2u);
  ASSERT_EQ(right.size(), 2u);
  std::ptrdiff_t marked = 0, counted = 0, named = 0, all = 0;
  for (auto row = lines.begin(); row + 7 < lines.end(); ++row) {
    if (row[1].find(" mm deep") == std::string::npos) continue;
    ++all;
    marked += row[2] != "not marked" && numberIn(row[2]) <= std::stod(beside[1]);
    counted += row[3] != "no number" && row[4] != "not counted to the end" &&
               std::abs(numberIn(row[3]) - numberIn(row[4])) <= std::stod(right[1]);
    named += row[5] == row[6];
  }
  EXPECT_GT(all, 0);
  EXPECT_TRUE(says(lines, "Pulses found: " + ofWords(marked, all) + "; counted within " +
                              std::string(right[1]) + " beats a minute: " + ofWords(counted, all) +
                              "; rhythms named right: " + ofWords(named, all) + '.'));
  EXPECT_EQ(after(lines, "The pulse was found"), ofWords(marked, all));
  EXPECT_EQ(after(lines, "It was counted right"), ofWords(counted, all));
  EXPECT_EQ(after(lines, "The rhythm was named right"), ofWords(named, all));
}

/// What one palpation's card says.
struct ToldPalpation {
  int found = 0, lumps = 0, alarms = 0;
  bool passed = false, judged = false;
};

std::string foundWords(const ToldPalpation& told) {
  if (told.lumps == 0)
    return told.alarms == 0   ? "There was no lump, and none was marked"
           : told.alarms == 1 ? "There was no lump, but one was marked"
                              : "There was no lump, but " + std::to_string(told.alarms) + " were";
  const std::string alarms = told.alarms == 0   ? ", no false alarm"
                             : told.alarms == 1 ? ", one false alarm"
                                                : ", " + std::to_string(told.alarms) + " false";
  if (told.lumps == 1)
    return (told.found ? "Found the only lump" : "Missed the only lump") + alarms;
  if (told.found == told.lumps)
    return (told.lumps == 2 ? "Found both lumps"
                            : "Found all " + std::to_string(told.lumps) + " lumps") +
           alarms;
  return "Found " + (told.found ? std::to_string(told.found) : std::string("none")) + " of " +
         std::to_string(told.lumps) + " lumps" + alarms;
}

ToldPalpation expectPalpationAgrees(const Lines& card) {
  ToldPalpation told;
  const auto line = [&](const std::string& words) {
    return std::find(card.begin(), card.end(), words);
  };
  told.alarms = static_cast<int>(numberIn(after(card, "False alarms")));
  if (auto of = line("lumps found"); of != card.end() || (of = line("lump found")) != card.end())
    std::sscanf(of[-1].c_str(), "%d of %d", &told.found, &told.lumps);
  told.passed = line("At the standard") != card.end();
  told.judged = told.passed || says(card, "Below the standard: ");
  EXPECT_TRUE(says(card, foundWords(told))) << foundWords(told);
  const std::string felt = after(card, "Area felt"), deeply = after(card, "Felt deeply");
  EXPECT_TRUE(says(card, "; " + felt + " of the area was felt")) << felt;
  EXPECT_EQ(std::count(card.begin(), card.end(), "missed"), told.lumps - told.found);
  EXPECT_EQ(says(card, "No false alarm."), told.alarms == 0);
  if (told.judged) {
    EXPECT_EQ(says(card, "too little of the area felt"), numberIn(felt) < 95) << felt;
    EXPECT_EQ(says(card, "too little felt deeply"), numberIn(deeply) < 95) << deeply;
    EXPECT_EQ(says(card, "too few lumps found"), told.found < told.lumps);
  }
  if (const auto only = found(card, "^Only ([\\d.]+ %) of the area was felt, ([\\d.]+) %");
      !only.empty()) {
    EXPECT_EQ(only[1], felt);
    EXPECT_LT(numberIn(felt), std::stod(only[2]));
  }
  if (const auto only = found(card, "^Only ([\\d.]+ %) of the area was felt deeply");
      !only.empty()) {
    EXPECT_EQ(only[1], deeply);
  }
  EXPECT_FALSE(says(card, "These measures show nothing") && says(card, "Below the standard"));
  return told;
}

void expectPalpationsAgree(const Lines& lines) {
  std::vector<Lines> cards;
  for (std::size_t i = 0; i + 1 < lines.size(); ++i) {
    if (lines[i].rfind("Trial ", 0) == 0 && lines[i + 1] == "scored") cards.emplace_back();
    if (lines[i].rfind("How it was done", 0) == 0) break;
    if (!cards.empty()) cards.back().push_back(lines[i]);
  }
  ToldPalpation sum;
  int passed = 0;
  for (const Lines& card : cards) {
    SCOPED_TRACE(card.front());
    const ToldPalpation told = expectPalpationAgrees(card);
    sum.found += told.found;
    sum.lumps += told.lumps;
    sum.alarms += told.alarms;
    passed += told.passed;
  }
  ASSERT_FALSE(cards.empty());
  const std::string alarms =
      std::to_string(sum.alarms) + (sum.alarms == 1 ? " false alarm." : " false alarms.");
  EXPECT_TRUE(says(lines, (sum.lumps == 0 ? "No lump was to be found in "
                                          : "Found " + ofWords(sum.found, sum.lumps) + ' ')));
  EXPECT_TRUE(says(lines, "scored trials; " + alarms) || says(lines, "scored trial; " + alarms))
      << alarms;
  EXPECT_EQ(after(lines, "At the standard").rfind(ofWords(passed, std::ssize(cards)), 0), 0u);
}

/// Sessions of novices and experts; each page is given to `expect`.
template <class World, class Run, class Write>
void eachPage(int sessions, int trials, const Run& run, const Write& write,
              void (*expect)(const Lines&)) {
  for (int i = 0; i < sessions; ++i) {
    SessionOptions options =
        quick(i % 2 ? OperatorKind::expert : OperatorKind::novice, 300 + 10 * std::uint64_t(i));
    options.trials = trials;
    const World world(options);
    const std::filesystem::path folder = freshPlace("truths");
    write(options, world, run(options, world, folder), folder);
    SCOPED_TRACE("session " + std::to_string(i));
    const Lines lines = linesOf(test::slurp(folder / "report.html"));
    EXPECT_TRUE(says(lines, "Practise next:"));
    expect(lines);
  }
}

int sessionsOf() { return test::counted(1, 26); }
int trialsOf() { return test::counted(2, 4); }

TEST(ReportTruth, APalpationsPageContradictsItselfNowhere) {
  eachPage<PalpationWorld>(sessionsOf(), trialsOf(), runPalpation, writePalpationOutcome,
                           expectPalpationsAgree);
}

TEST(ReportTruth, ASearchsPageContradictsItselfNowhere) {
  eachPage<SearchWorld>(sessionsOf(), trialsOf(), runSearch, writeSearchOutcome,
                        expectEpisodesAgree);
}

TEST(ReportTruth, ASqueezesPageContradictsItselfNowhere) {
  eachPage<SqueezeWorld>(sessionsOf(), trialsOf(), runComparison, writeComparisonOutcome,
                         expectAnswersAgree);
}

TEST(ReportTruth, AFrictionsPageContradictsItselfNowhere) {
  eachPage<FrictionWorld>(sessionsOf(), trialsOf(), runComparison, writeComparisonOutcome,
                          expectAnswersAgree);
}

TEST(ReportTruth, APulsesPageContradictsItselfNowhere) {
  eachPage<PulseWorld>(sessionsOf(), trialsOf(), runPulse, writePulseOutcome, expectPulsesAgree);
}

}  // namespace
}  // namespace palpa::session

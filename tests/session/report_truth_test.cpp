#include <gtest/gtest.h>

#include <cmath>
#include <regex>

#include "apps/session/session_options.h"
#include "tests/session/page_lines.h"
#include "tests/session/quick_sessions.h"
#include "tests/support/counts.h"

/// A report contradicts itself nowhere: verdict, errors, score, checklist and advice of simulated
/// trials, read from the page as its reader reads it.
namespace palpa::session {
namespace {

using test::linesOf;
using test::numberIn;

/// What one trial's part of a page says.
struct Told {
  std::vector<std::string> lines;

  bool says(const std::string& words) const {
    return std::any_of(lines.begin(), lines.end(), [&](const std::string& line) {
      return line.find(words) != std::string::npos;
    });
  }
  bool is(const std::string& words) const {
    return std::find(lines.begin(), lines.end(), words) != lines.end();
  }
  /// The line so many after the one that is `words`.
  std::string after(const std::string& words, std::ptrdiff_t lines_on = 1) const {
    const auto at = std::find(lines.begin(), lines.end(), words);
    return at == lines.end() || lines.end() - at <= lines_on ? "" : at[lines_on];
  }
  /// "done", "not done", "not judged", "did not arise" of the checklist's item.
  std::string mark(const std::string& item) const {
    for (auto at = lines.begin(); at != lines.end(); ++at) {
      if (at->rfind(item, 0) != 0) continue;
      for (const auto last = std::min(at + 6, lines.end()); at != last; ++at)
        for (const char* mark : {"did not arise", "not done", "not judged", "done"})
          if (at->size() < 24 && at->find(mark) != std::string::npos &&
              at->find(' ') != std::string::npos)
            return mark;
      return "no mark";
    }
    return "no item";
  }
  /// Why the item is not done: the trial ended before.
  bool cameNotTo(const std::string& item) const {
    for (std::size_t i = 0; i + 1 < lines.size(); ++i)
      if (lines[i].rfind(item, 0) == 0)
        return lines[i + 1].find("it did not come to that") != std::string::npos;
    return false;
  }
  int marks(const std::string& sign) const {
    return static_cast<int>(std::count_if(lines.begin(), lines.end(), [&](const std::string& line) {
      return line.rfind(sign, 0) == 0;
    }));
  }
};

/// Title, error; and the item of the checklist that it makes "not done".
struct ErrorAndItem {
  const char* error;
  const char* item;
};
constexpr ErrorAndItem kErrors[] = {
    {"Landmarks not identified", "Finds the junction of the clavicle's medial"},
    {"Wrong site relative to the clavicle", "Punctures the skin about a centimetre below"},
    {"Through the periosteum of the clavicle", "Feels the clavicle without boring into it"},
    {"Too cephalad", "Does not aim toward the head"},
    {"Needle left the vein", "Keeps the needle in the vein once blood"}};

void expectErrorsAgree(const Told& told) {
  int errors = told.is("Too flat");
  for (const auto& [error, item] : kErrors) {
    errors += told.is(error);
    if (told.is(error)) {
      EXPECT_EQ(told.mark(item), "not done") << error;
    } else if (!told.cameNotTo(item)) {
      EXPECT_NE(told.mark(item), "not done") << item << ": which error?";
    }
  }
  if (told.is("Too flat")) {
    EXPECT_EQ(told.mark("Lowers the needle behind the clavicle"), "not done");
  }
  const bool inserted = !told.says("The needle was not inserted: there is no technique");
  EXPECT_EQ(told.says("None of the six common errors"), errors == 0 && inserted);
}

void expectScoreAdds(const Told& told) {
  double sum = 0;
  int charges = 0;
  const std::regex charge("[0-9].* × .*");
  for (std::size_t i = 0; i + 1 < told.lines.size(); ++i)
    if (std::regex_match(told.lines[i], charge)) {
      sum += numberIn(told.lines[i + 1]);
      ++charges;
    }
  EXPECT_EQ(charges, 9);
  const double total = numberIn(told.after("Total penalty (lower is better)"));
  EXPECT_NEAR(sum, total, 0.05 * charges + 0.06);
  for (std::size_t i = 0; i + 2 < told.lines.size(); ++i)
    if (told.lines[i].find(" than experts vary (") != std::string::npos) {
      EXPECT_EQ(told.lines[i].find(": farther than") != std::string::npos,
                numberIn(told.lines[i + 2]) > 0)
          << told.lines[i];
    }
}

void expectOutcomeAgrees(const Told& told) {
  const bool reached = told.is("Successful") || told.is("Vein reached, with a complication"),
             touched = told.is("Vein reached, with a complication");
  EXPECT_EQ(reached, told.mark("Draws blood freely from the vein") == "done");
  EXPECT_EQ(reached, told.says("Blood aspirated after"));
  EXPECT_NE(reached, told.says("without success."));
  if (told.says("with no injury")) {
    EXPECT_TRUE(reached && !touched);
    for (const char* item : {"Keeps clear of the pleura", "Keeps clear of the artery",
                             "Does not go through the back wall"})
      EXPECT_NE(told.mark(item), "not done") << item;
  }
  if (!told.says("No contact with the lung.")) {
    EXPECT_EQ(told.mark("Keeps clear of the pleura"), "not done");
  }
  if (!told.says("No contact with an artery.")) {
    EXPECT_EQ(told.mark("Keeps clear of the artery"), "not done");
  }
  EXPECT_EQ(told.is("Not successful: too many passes of the needle"),
            told.mark("Needs no more than three passes") == "not done");
  const bool critical = told.says("Critical error:");
  if (critical) {
    EXPECT_TRUE(told.is("Fail (simulated)"));
  }
  EXPECT_FALSE(told.is("Pass (simulated)")) << "no rater was there";
  if (!reached) {
    EXPECT_TRUE(told.says("Critical error: no blood was drawn from the vein"));
  }
}

/// "17 of 24 items done": as many as there are in the list; and so for major and minor ones.
void expectChecklistAdds(const Told& told) {
  const int done = told.marks("✓"), not_done = told.marks("✗"), open = told.marks("□"),
            none = told.marks("–");
  const std::string share =
      std::to_string(done) + " of " + std::to_string(done + not_done + open) + " items done";
  EXPECT_TRUE(told.says(share)) << share;
  EXPECT_EQ(none > 0, told.says("did not arise: left out of this share"));
  std::smatch level;
  for (const std::string& line : told.lines)
    if (std::regex_search(line, level,
                          std::regex("by (\\d+) of (\\d+) major and (\\d+) of (\\d+) minor"))) {
      EXPECT_EQ(std::stoi(level[1]) + std::stoi(level[3]), done + none);
      EXPECT_EQ(std::stoi(level[2]) + std::stoi(level[4]), done + not_done + open + none);
      return;
    }
  ADD_FAILURE() << "no level";
}

bool allWell(const Told& told) {
  return told.is("Successful") && told.says("None of the six common errors");
}

void expectNoContradiction(const std::string& page, int trials) {
  std::vector<std::string> lines = linesOf(page);
  std::vector<Told> all;
  for (std::size_t i = 0; i + 1 < lines.size(); ++i) {
    if (lines[i].rfind("Trial ", 0) == 0 && lines[i + 1] == "assessed") all.emplace_back();
    if (!all.empty() && lines[i] == "All trials") break;
    if (!all.empty()) all.back().lines.push_back(lines[i]);
  }
  ASSERT_EQ(all.size(), static_cast<std::size_t>(trials));
  for (const Told& told : all) {
    SCOPED_TRACE(told.lines.front());
    expectErrorsAgree(told);
    expectScoreAdds(told);
    expectOutcomeAgrees(told);
    expectChecklistAdds(told);
  }
  const Told whole{lines};
  EXPECT_TRUE(whole.says("Practise next:"));
  if (whole.says("the same on other patients")) {
    EXPECT_TRUE(allWell(all.back()));
  }
  EXPECT_FALSE(whole.says("cceptable")) << "one word for one margin";
}

TEST(ReportTruth, ANeedlesPageContradictsItselfNowhere) {
  const int sessions = test::counted(2, 84), trials = test::counted(2, 3);
  for (const OperatorKind who : {OperatorKind::expert, OperatorKind::novice}) {
    SessionOptions options = quick(who);
    options.assess = true;
    options.trials = trials;
    settle(options);
    Quick<NeedleWorld> world(options);
    for (int i = 0; i < sessions; ++i) {
      options.seed = 500 + 10 * static_cast<std::uint64_t>(i);
      const std::filesystem::path folder = freshPlace("truth");
      const SessionResult result = runNeedleSession(options, world, folder);
      writeOutcome(options, world, result, folder);
      SCOPED_TRACE(std::string(nameOf(who)) + ", seed " + std::to_string(options.seed));
      expectNoContradiction(test::slurp(folder / "report.html"), trials);
    }
  }
}

}  // namespace
}  // namespace palpa::session

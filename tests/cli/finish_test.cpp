#include <gtest/gtest.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <random>

#include "anatomy/base/error.h"
#include "apps/record/session_file.h"
#include "apps/runtime/clock.h"
#include "program.h"
#include "tests/support/counts.h"

/// What a session owes whose program was killed (SIGKILL), made by `palpa finish`: of the trials
/// that were finished byte for byte what the undisturbed session says.
namespace palpa::cli_test {
namespace {

namespace fs = std::filesystem;

struct Kind {
  const char* command;
  const char* section_end;  ///< of what a report says of one trial
};
constexpr Kind kNeedle{"subclavian", "</section>"};
constexpr Kind kAll[] = {kNeedle,
                         {"palpation", "</section>"},
                         {"search", "</tr>"},
                         {"squeeze", "</tr>"},
                         {"friction", "</tr>"},
                         {"pulse", "</tr>"}};

std::vector<std::string> threeTrials(const Kind& kind, const std::string& out) {
  return quickly(
      {kind.command, "--operator", "expert", "--seed", kShortTrial, "--trials", "3", "--out", out});
}

/// Of a session's evidence; none while the file does not say yet what it is.
std::vector<record::RecordedTrial> trialsIn(const fs::path& evidence) {
  try {
    return fs::exists(evidence) ? record::SessionReader(evidence).trials()
                                : std::vector<record::RecordedTrial>{};
  } catch (const Error&) {
    return {};
  }
}

std::size_t endedIn(const fs::path& evidence) {
  const auto trials = trialsIn(evidence);
  return static_cast<std::size_t>(
      std::count_if(trials.begin(), trials.end(), [](const auto& t) { return t.ended; }));
}

std::string sectionOf(const std::string& report, std::size_t trial, const char* end) {
  const std::size_t from = report.find("id=\"trial-" + std::to_string(trial) + '"');
  if (from == std::string::npos) return "";
  return report.substr(from, report.find(end, from) - from);
}

struct Pages {
  std::string report, table;
  explicit Pages(const fs::path& folder)
      : report(contentOf(folder / "report.html")), table(contentOf(folder / "trials.csv")) {}
};

/// `ended`: of the whole session's trials so many.
void expectPartOf(const Pages& whole, const Pages& made, std::size_t ended, const Kind& kind) {
  const auto rows =
      static_cast<std::size_t>(std::count(made.table.begin(), made.table.end(), '\n'));
  EXPECT_EQ(rows, 1 + ended);
  EXPECT_EQ(whole.table.substr(0, made.table.size()), made.table);
  for (std::size_t trial = 1; trial <= ended; ++trial) {
    const std::string section = sectionOf(made.report, trial, kind.section_end);
    EXPECT_GT(section.size(), 50u) << "trial " << trial;
    EXPECT_TRUE(section == sectionOf(whole.report, trial, kind.section_end)) << "trial " << trial;
  }
  EXPECT_EQ(sectionOf(made.report, ended + 1, kind.section_end), "");
}

/// Kills a session when so many trials have ended, and somewhat later; false: it was too quick.
bool killed(const Kind& kind, const Folder& here, std::size_t trials, std::int64_t later_ns) {
  const runtime::SteadyClock clock;
  const fs::path evidence = here / "A/session.palpa";
  Running program(threeTrials(kind, "A"), here.path());
  while (!program.ended() && endedIn(evidence) < trials)
    clock.sleepUntil(clock.now() + 20 * runtime::kMillisecond);
  clock.sleepUntil(clock.now() + later_ns);
  program.kill();
  return !fs::exists(here / "A/report.html");
}

void expectFinished(const Kind& kind, const Folder& here, const Pages& whole) {
  const fs::path evidence = here / "A/session.palpa";
  const auto trials = trialsIn(evidence);
  const std::size_t ended = endedIn(evidence);
  const Outcome finish = palpa({"finish", "A"}, here.path());
  ASSERT_EQ(finish.exit_code, 0) << finish.err;
  const Pages made(here / "A");
  expectPartOf(whole, made, ended, kind);
  EXPECT_TRUE(says(made.report, "ended before its report"));
  EXPECT_EQ(says(made.report, "was not finished"), ended < trials.size());
  const Outcome again = palpa({"finish", "A/session.palpa"}, here.path());
  EXPECT_EQ(again.exit_code, 0) << again.err;
  EXPECT_TRUE(says(again.out, "Nothing is owed")) << again.out;
}

TEST(Finish, AKilledSessionGetsWhatAnUndisturbedOneSaysUpToThere) {
  constexpr std::size_t kTrials = 3;
  const int kills = test::counted(1, 13);  // of each kind
  std::mt19937_64 bits(7);
  for (const Kind& kind : kAll) {
    SCOPED_TRACE(kind.command);
    const std::string name = kind.command;
    if (!test::fullCounts() && (name == "palpation" || name == "search")) continue;  // take longest
    const Folder undisturbed;
    ASSERT_EQ(palpa(threeTrials(kind, "A"), undisturbed.path()).exit_code, 0);
    const Pages whole(undisturbed / "A");
    int in_the_middle = 0;
    for (int k = 0; k < kills; ++k) {
      SCOPED_TRACE("kill " + std::to_string(k));
      const Folder here;
      const std::size_t after = kills == 1 ? 1 : bits() % kTrials;
      const auto later = static_cast<std::int64_t>(bits() % 200) * runtime::kMillisecond;
      if (!killed(kind, here, after, later) || !fs::exists(here / "A/session.palpa")) continue;
      if (trialsIn(here / "A/session.palpa").empty()) continue;
      ++in_the_middle;
      expectFinished(kind, here, whole);
    }
    EXPECT_GT(in_the_middle, 0) << "no kill fell into the session";
  }
}

/// From the second trial's ready check on a board is not seen.
TEST(Finish, ASessionThatFailsInTheMiddleHasMadeItsReportItself) {
  const Folder here;
  nlohmann::json station = nlohmann::json::parse(contentOf(quickStation("virtual_bench.json")));
  station["twin"]["camera_faults"] = {{{"kind", "hidden"}, {"from_s", 13}, {"to_s", 9000}}};
  const Outcome outcome = palpa(session({"--station", here.file("station.json", station.dump()),
                                         "--seed", kShortTrial, "--trials", "3", "--out", "A"}),
                                here.path());
  EXPECT_EQ(outcome.exit_code, 1) << outcome.err;
  EXPECT_TRUE(says(outcome.err, "ready check")) << outcome.err;
  const Pages made(here / "A");
  EXPECT_TRUE(says(made.table, "\nT000,1,")) << made.table;
  EXPECT_TRUE(says(made.report, "No further trial could begin")) << outcome.out;
  EXPECT_TRUE(says(made.report, "The session failed: ready check")) << outcome.out;
  EXPECT_TRUE(says(palpa({"finish"}, here.path()).out, "was finished")) << "nothing is owed";
}

TEST(Finish, OfACompleteSessionNothingIsOwed) {
  const Folder here;
  ASSERT_EQ(palpa(session({"--seed", kShortTrial, "--out", "A"}), here.path()).exit_code, 0);
  const Pages live(here / "A");
  const Outcome finish = palpa({"finish", "A"}, here.path());
  EXPECT_EQ(finish.exit_code, 0) << finish.err;
  EXPECT_TRUE(says(finish.out, "Nothing is owed")) << finish.out;
  EXPECT_EQ(contentOf(here / "A/report.html"), live.report) << "nothing was changed";
  EXPECT_TRUE(says(palpa({"finish"}, here.path()).out, "was finished"));

  const Outcome again = palpa({"finish", "A", "--again"}, here.path());
  EXPECT_EQ(again.exit_code, 0) << again.err;
  const Pages made(here / "A");
  EXPECT_EQ(made.table, live.table);
  EXPECT_EQ(sectionOf(made.report, 1, "</section>"), sectionOf(live.report, 1, "</section>"));
  EXPECT_TRUE(says(made.report, "made again from the evidence"));
}

/// Noted in this user's folder of states, which lies in `here`.
TEST(Finish, AKilledSessionIsOfferedAndOneThatRunsIsRefused) {
  const Folder here;
  const runtime::SteadyClock clock;
  const fs::path evidence = here / "A/session.palpa";
  {
    Running running(session({"--trials", "500", "--out", "A"}), here.path());
    while (!running.ended() && trialsIn(evidence).empty())
      clock.sleepUntil(clock.now() + 50 * runtime::kMillisecond);
    const Outcome finish = palpa({"finish", "A"}, here.path());
    EXPECT_EQ(finish.exit_code, 2);
    EXPECT_EQ(finish.errLines(), 1) << finish.err;
    EXPECT_TRUE(says(finish.err, "still running")) << finish.err;
    EXPECT_TRUE(says(palpa({"finish"}, here.path()).out, "was finished")) << "it is not left yet";
  }  // killed
  EXPECT_TRUE(says(palpa({"finish"}, here.path()).out, "palpa finish " + (here / "A").string()));
  EXPECT_EQ(palpa(session({"--out", "A"}), here.path()).exit_code, 1) << "another's folder";
  EXPECT_FALSE(fs::exists(here / "A/report.html"));
  EXPECT_TRUE(says(palpa({"finish"}, here.path()).out, "palpa finish " + (here / "A").string()));
  std::vector<std::string> next = session({"--seed", kShortTrial, "--out", "B"});
  next.erase(std::find(next.begin(), next.end(), "--quiet"));
  const Outcome told = palpa(next, here.path());
  EXPECT_EQ(told.exit_code, 0) << told.err;
  EXPECT_TRUE(says(told.err, "A session was not finished: " + (here / "A").string())) << told.err;
  EXPECT_EQ(palpa({"finish", "A"}, here.path()).exit_code, 0);
  EXPECT_TRUE(says(palpa({"finish"}, here.path()).out, "was finished"));
}

TEST(Finish, RefusesWhatIsNoSessionInOneLine) {
  const Folder here;
  here.file("session.palpa", "no evidence");
  for (const std::string& wrong : {std::string("nowhere"), std::string(".")}) {
    const Outcome outcome = palpa({"finish", wrong}, here.path());
    EXPECT_NE(outcome.exit_code, 0);
    EXPECT_EQ(outcome.errLines(), 1) << outcome.err;
    EXPECT_FALSE(fs::exists(here / "report.html"));
  }
  EXPECT_EQ(palpa({"finish", "--again"}, here.path()).exit_code, 2);
}

/// Its trials go where the session would have brought them.
TEST(Finish, BringsTheTrialsIntoTheRecordsThatTheSessionNamed) {
  const Folder here;
  const std::string records = (here / "records.sqlite").string();
  ASSERT_EQ(palpa({"records", "trainee", "add", "--id", "T1", "--records", records}, here.path())
                .exit_code,
            0);
  const runtime::SteadyClock clock;
  const fs::path evidence = here / "A/session.palpa";
  {
    Running running(session({"--seed", kShortTrial, "--trials", "500", "--out", "A", "--trainee",
                             "T1", "--records", records}),
                    here.path());
    while (!running.ended() && endedIn(evidence) < 1)
      clock.sleepUntil(clock.now() + 50 * runtime::kMillisecond);
  }  // killed
  ASSERT_GE(endedIn(evidence), 1u);
  const Outcome finish = palpa({"finish", "A"}, here.path());
  EXPECT_EQ(finish.exit_code, 0) << finish.err;
  EXPECT_TRUE(says(finish.out, "In the records of T1")) << finish.out << finish.err;
}

}  // namespace
}  // namespace palpa::cli_test

#include <gtest/gtest.h>

#include <csignal>
#include <optional>
#include <random>

#include "anatomy/base/error.h"
#include "apps/record/session_file.h"
#include "apps/runtime/clock.h"
#include "program.h"
#include "tests/support/counts.h"

/// The whole program is killed (SIGKILL) at random moments of a session. What is proven, without a
/// hook in it:
///   1. what was committed before the kill is there after it: the file is read while the program
///      writes it;
///   2. what is there is a prefix of the same session run to its end (same seed, same numbers),
///      without a gap;
///   3. the prefix ends where a commit belongs, on a grid of 100 ticks. In virtual time one thread
///      does everything in order of session time, so no tick beyond the next point of the grid can
///      have been made before the commit that belongs there: at most 200 ticks are lost, two points
///      of the grid.
/// How many ticks had been made at the kill is not known from outside; 3 bounds it.
namespace palpa::cli_test {
namespace {

namespace fs = std::filesystem;
using haptics::FlightRecord;

std::vector<FlightRecord> ticksOf(const fs::path& file) {
  std::vector<FlightRecord> all;
  record::SessionReader(file).ticks([&](const FlightRecord& record) { all.push_back(record); });
  return all;
}

/// Ticks that a reader sees now; nothing before the file says what it is.
std::optional<std::size_t> committed(const fs::path& file) {
  if (!fs::exists(file)) return std::nullopt;
  try {
    return ticksOf(file).size();
  } catch (const Error&) {
    return std::nullopt;
  }
}

bool same(const FlightRecord& a, const FlightRecord& b) {
  return a.tick == b.tick && a.t_ns == b.t_ns && a.reading.p_DE == b.reading.p_DE &&
         a.reading.sequence == b.reading.sequence && a.snapshot == b.snapshot &&
         a.f_contact_D == b.f_contact_D && a.f_command_D == b.f_command_D && a.events == b.events &&
         a.depth == b.depth && a.tissue == b.tissue && a.safety == b.safety;
}

std::vector<std::string> arguments() { return session({"--seed", kShortTrial, "--out", "A"}); }

void isPrefix(const std::vector<FlightRecord>& left, const std::vector<FlightRecord>& whole) {
  ASSERT_LE(left.size(), whole.size());
  for (std::size_t i = 0; i < left.size(); ++i) {
    ASSERT_EQ(left[i].tick, static_cast<std::int64_t>(i)) << "a gap";
    ASSERT_TRUE(same(left[i], whole[i])) << "tick " << i;
  }
  if (left.size() < whole.size() && !left.empty()) {
    EXPECT_EQ(left.size() % 100, 1u) << "ends between two commits";
  }
}

TEST(Kill, AKilledSessionLeavesItsEvidenceUpToTheLastCommit) {
  const Folder first, reference;
  ASSERT_EQ(palpa(arguments(), first.path()).exit_code, 0);  // builds the patient, which takes long
  const runtime::SteadyClock clock;
  ASSERT_EQ(palpa(arguments(), reference.path()).exit_code, 0);
  const std::vector<FlightRecord> whole = ticksOf(reference / "A/session.palpa");
  ASSERT_GT(whole.size(), 1000u);

  const int kills = palpa::test::counted(3, 50);
  std::mt19937_64 bits(11);
  int in_the_middle = 0;
  for (int k = 0; k < kills; ++k) {
    SCOPED_TRACE("kill " + std::to_string(k));
    // Spread over the run: one in each of `kills` equal parts, somewhere in it.
    const double part = (k + static_cast<double>(bits() >> 11) * 0x1p-53) / kills;
    const auto goal = static_cast<std::size_t>(part * static_cast<double>(whole.size()));
    const auto later = static_cast<std::int64_t>(bits() % 50) * runtime::kMillisecond;
    const Folder here;
    const fs::path file = here / "A/session.palpa";
    Running program(arguments(), here.path());
    while (!program.ended() && committed(file).value_or(0) < goal)
      clock.sleepUntil(clock.now() + 30 * runtime::kMillisecond);
    clock.sleepUntil(clock.now() + later);
    const auto before = committed(file);
    program.kill();
    const auto after = committed(file);
    ASSERT_TRUE(after || !before) << "what could be read cannot be read any more";
    if (!after) continue;  // killed before the file said what it is: nothing had been recorded
    EXPECT_GE(*after, before.value_or(0)) << "what was committed is gone";
    const std::vector<FlightRecord> left = ticksOf(file);
    isPrefix(left, whole);
    in_the_middle += !left.empty() && left.size() < whole.size();
  }
  EXPECT_GT(in_the_middle, 0) << "no kill fell into the recording";
}

/// Interrupted in the middle; how the trial that was running ended then, or how the last before it
/// did, where the signal came between two.
void expectClosed(const std::vector<std::string>& more, const std::string& outcome,
                  int signal = SIGINT, const fs::path& err = "/dev/null") {
  Folder here;
  const runtime::SteadyClock clock;
  std::vector<std::string> arguments =
      session({"--trials", "500", "--out", "A"});  // minutes of work
  arguments.insert(arguments.end(), more.begin(), more.end());
  Running running(arguments, here.path(), err);
  const fs::path file = here / "A/session.palpa";
  bool begun = false;
  while (!begun && !running.ended()) {
    clock.sleepUntil(clock.now() + 100 * runtime::kMillisecond);
    begun = committed(file).value_or(0) > 0 && !record::SessionReader(file).trials().empty();
  }
  ASSERT_TRUE(begun);
  EXPECT_EQ(running.interrupt(signal), 0);
  const record::SessionReader left(file);
  ASSERT_FALSE(left.trials().empty());
  EXPECT_LT(left.trials().size(), 500u);
  const record::RecordedTrial last = left.trials().back();
  EXPECT_TRUE(last.ended);
  EXPECT_GE(last.length_s(), 0);
  if (last.end.reason == "Interrupted")
    EXPECT_EQ(last.end.outcome, outcome);
  else
    EXPECT_EQ(last.end.outcome, "success") << last.end.reason;
  EXPECT_TRUE(fs::exists(here / "A/report.html"));
  EXPECT_TRUE(fs::exists(here / "A/trials.csv"));
}

TEST(Interrupt, ClosesASessionAsEscapeDoes) { expectClosed({}, "void"); }

/// With a terminal that is gone whatever is said to it fails, as on a full disk.
TEST(Interrupt, AClosedTerminalEndsASessionInOrder) {
  expectClosed({}, "void", SIGHUP, "/dev/full");
}

TEST(Interrupt, SoDoTheOtherSignalsThatAskForAnEnd) {
  for (const int signal : {SIGQUIT, SIGUSR1}) {
    SCOPED_TRACE(signal);
    expectClosed({}, "void", signal);
  }
}

TEST(Interrupt, IsNoWayOutOfAnAssessment) { expectClosed({"--assess"}, "aborted"); }

}  // namespace
}  // namespace palpa::cli_test

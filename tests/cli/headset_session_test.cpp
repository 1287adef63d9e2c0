#include <gtest/gtest.h>

#include <unistd.h>

#include <algorithm>
#include <csignal>
#include <fstream>

#include "apps/record/session_file.h"
#include "program.h"
#include "tests/support/test_xr.h"

/// Sessions with a headset, and with one that is not there or does not stay: in real time, by a
/// simulated expert.
namespace palpa::cli_test {
namespace {

std::vector<std::string> onHeadset(std::vector<std::string> more) {
  std::vector<std::string> all{"subclavian", "--display", "openxr",
                               "--quiet",    "--station", quickStation("virtual_bench.json"),
                               "--seed",     kShortTrial, "--out",
                               "A"};
  all.insert(all.end(), more.begin(), more.end());
  return all;
}

/// Until a trial runs; a minute at most.
bool trialRuns(const std::filesystem::path& session, Running& running) {
  for (int tries = 0; tries < 600 && !running.ended(); ++tries) {
    usleep(100'000);
    try {
      if (!record::SessionReader(session).trials().empty()) return true;
    } catch (const std::exception&) {  // not there yet
    }
  }
  return false;
}

/// Until the runtime has kept pictures of an eye, and keeps none any more; two minutes at most.
void awaitLastFrame(const std::filesystem::path& picture, Running& running) {
  constexpr int kStill = 20;  // tenths of a second
  std::filesystem::file_time_type last{};
  bool seen = false;
  for (int tries = 0, still = 0; tries < 1200 && !running.ended() && still < kStill; ++tries) {
    usleep(100'000);
    std::error_code none;
    const auto time = std::filesystem::last_write_time(picture, none);
    still = seen && time == last ? still + 1 : 0;
    seen = seen || !none;
    last = time;
  }
}

std::int64_t lastTickOf(const std::filesystem::path& session) {
  std::int64_t last_ns = 0;
  record::SessionReader(session).ticks([&](const haptics::FlightRecord& r) { last_ns = r.t_ns; });
  return last_ns;
}

TEST(HeadsetSession, OneThatIsLostEndsInTheDesktopViewAndTheTrialGoesOn) {
  const test::TestXr xr(PALPA_TEST_XR_JSON, "eyes=96x80,96x80;fault=session_lost@30");
  const Folder here;
  Running running(onHeadset({"--operator", "expert"}), here.path());
  ASSERT_TRUE(trialRuns(here / "A/session.palpa", running));
  awaitLastFrame(xr.folder() / "eye1.pam", running);
  const std::int64_t then_ns = lastTickOf(here / "A/session.palpa");
  usleep(1'500'000);
  EXPECT_EQ(running.interrupt(), 0);
  EXPECT_GT(lastTickOf(here / "A/session.palpa"), then_ns + 500'000'000) << "it went on";
  const std::string page = contentOf(here / "A/report.html");
  EXPECT_TRUE(says(page, "Headset"));
  EXPECT_TRUE(says(page, "then the headset was lost"));
  const test::XrReport report = xr.report();
  EXPECT_TRUE(report.written);
  EXPECT_EQ(report.complaints, std::vector<std::string>{});
  EXPECT_EQ(report.open, std::vector<std::string>{});
}

TEST(HeadsetSession, WithoutARuntimeTheDesktopViewGoesOnAndOneLineSaysSo) {
  const test::TestXr none("/nowhere/runtime.json", "");
  const Folder here;
  Running running(onHeadset({"--operator", "expert"}), here.path(), here / "err");
  EXPECT_TRUE(trialRuns(here / "A/session.palpa", running));
  EXPECT_EQ(running.interrupt(), 0);
  const Outcome outcome{0, "", contentOf(here / "err")};
  EXPECT_EQ(outcome.errLines(), 1) << outcome.err;
  EXPECT_TRUE(says(outcome.err, "no OpenXR runtime is there")) << outcome.err;
  EXPECT_TRUE(says(outcome.err, "continues on the desktop")) << outcome.err;
  EXPECT_TRUE(std::filesystem::exists(here / "A/report.html"));
}

/// Its process is stopped in the middle of a trial, and stays so. (Call by call: test_headset,
/// HungCall.)
TEST(HeadsetSession, OneWhoseRuntimeIsStoppedHoldsNeitherTheTrialNorTheEndUp) {
  const Folder here;
  const std::filesystem::path number = here / "runtime.txt";
  const test::TestXr xr(PALPA_TEST_XR_JSON, "eyes=96x80,96x80;service=" + number.string());
  Running running(onHeadset({"--operator", "expert"}), here.path());
  ASSERT_TRUE(trialRuns(here / "A/session.palpa", running));
  int runtime = 0;
  std::ifstream(number) >> runtime;
  ASSERT_GT(runtime, 1);
  ASSERT_EQ(kill(runtime, SIGSTOP), 0);
  usleep(5'000'000);  // more than it takes to be said
  EXPECT_EQ(running.interrupt(), 0);
  EXPECT_TRUE(says(contentOf(here / "A/report.html"), "runtime does not answer"));
}

/// A person without a window and without a headset has nothing to look at.
TEST(HeadsetSession, APersonNeedsOneOfThem) {
  const test::TestXr none(PALPA_TEST_XR_JSON, "fault=no_headset");
  const Folder here;
  const Outcome outcome = palpa(onHeadset({"--operator", "person"}), here.path());
  EXPECT_EQ(outcome.exit_code, 1) << outcome.err;
  EXPECT_EQ(outcome.errLines(), 1) << outcome.err;
  EXPECT_TRUE(says(outcome.err, "no headset is connected")) << outcome.err;
}

TEST(HeadsetSession, IsNowOrNotAtAll) {
  const Folder here;
  for (const char* option : {"--fast", "--no-views"}) {
    const Outcome outcome = palpa(onHeadset({"--operator", "expert", option}), here.path());
    EXPECT_EQ(outcome.exit_code, 2) << option;
    EXPECT_TRUE(says(outcome.err, option)) << outcome.err;
  }
}

/// The hand and the tool at one moment.
struct Held {
  Vec3 hand, tool;
};

/// Where the hand was at each tick once the tool has come to it, a tick in twenty. The trigger is
/// pulled a little farther each frame and comes to the tool as its syringe through the filter that
/// the position comes through: how far it is drawn says which frame a tick has come to, however
/// long the frames took.
std::vector<Held> heldIn(const std::filesystem::path& session,
                         const std::vector<test::XrReport::Hand>& hands) {
  constexpr int kArrives = 500;  // ticks, many times the filter's constant
  std::vector<Held> all;
  int ticks = 0;
  record::SessionReader(session).ticks([&](const haptics::FlightRecord& tick) {
    const double drawn = tick.reading.plunger;
    ticks += drawn > 0;
    if (ticks < kArrives || ticks % 20) return;
    const auto next = std::find_if(hands.begin(), hands.end(),
                                   [&](const auto& hand) { return hand.trigger >= drawn; });
    if (next == hands.begin() || next == hands.end() || next->trigger == 1) return;
    const auto last = next - 1;
    const double share = (drawn - last->trigger) / (next->trigger - last->trigger);
    all.push_back({last->p + share * (next->p - last->p), unpack(tick.reading.p_DE)});
  });
  return all;
}

/// Until the runtime has kept so many pictures of an eye, one a frame, and eight seconds have
/// passed; two minutes at most, on a computer that is busy.
void awaitFrames(const std::filesystem::path& picture, int frames, Running& running) {
  std::filesystem::file_time_type last{};
  for (int seen = 0, tries = 0;
       tries < 12'000 && !running.ended() && (seen < frames || tries < 800); ++tries) {
    usleep(10'000);
    std::error_code none;
    const auto time = std::filesystem::last_write_time(picture, none);
    seen += !none && time != last;
    if (!none) last = time;
  }
}

/// A person's needle goes as far as the controller goes, which does not turn. (To a millimetre:
/// test_headset, Controller.)
TEST(HeadsetSession, TheControllerHoldsTheNeedle) {
  const test::TestXr xr(PALPA_TEST_XR_JSON, "eyes=64x64,64x64;rate=200;stands=1000000");
  const Folder here;
  Running running(onHeadset({"--operator", "person", "--no-familiarisation"}), here.path());
  awaitFrames(xr.folder() / "eye1.pam", 60, running);
  EXPECT_EQ(running.interrupt(), 0);
  const test::XrReport report = xr.report();
  EXPECT_EQ(report.complaints, std::vector<std::string>{});
  const std::vector<Held> held = heldIn(here / "A/session.palpa", report.hands);
  ASSERT_GT(held.size(), 20u);
  double width = 0, apart = 0;
  for (const Held& a : held)
    for (const Held& b : held) {
      const double between = (a.hand - b.hand).norm();
      width = std::max(width, between);
      apart = std::max(apart, std::abs((a.tool - b.tool).norm() - between));
    }
  EXPECT_GT(width, 0.005);
  EXPECT_LT(apart, 1e-4);
}

}  // namespace
}  // namespace palpa::cli_test

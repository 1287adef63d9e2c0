#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <functional>
#include <future>
#include <map>
#include <semaphore>
#include <sstream>

#include "anatomy/base/error.h"
#include "apps/os/tcp_socket.h"
#include "apps/record/session_file.h"
#include "apps/runtime/clock.h"
#include "hung_session.h"
#include "tests/support/counts.h"

/// Whole sessions in real time in which one part hangs in the middle: the emergency stop takes the
/// force away all the same, all other parts go on, and the session ends with report and table.
namespace palpa::cli_test {
namespace {

namespace fs = std::filesystem;
using haptics::FlightRecord;

/// Each in one way; with all stated counts in both.
std::vector<HungPart> parts() {
  const std::vector<HungPart> usual{
      {"film", "the camera", Hangs::for_ever},
      {"datagram", "the force sensor", Hangs::for_ever},
      {"usb", "the haptic device", Hangs::for_ever},
      {"stream", "OpenIGTLink", Hangs::for_a_while},
      {"local", "the line to the console", Hangs::for_ever, false},
      {"evidence", "the evidence", Hangs::for_a_while},
  };
  std::vector<HungPart> all = usual;
  for (HungPart part : usual) {
    if (!test::fullCounts()) break;
    part.how_long = part.how_long == Hangs::for_ever ? Hangs::for_a_while : Hangs::for_ever;
    all.push_back(part);
  }
  return all;
}

std::string testNameOf(const HungPart& part) {
  return part.calls + (part.how_long == Hangs::for_ever ? "_for_ever" : "_for_a_while");
}

/// So many sessions go on at the same time: each draws, and ticks in real time.
std::counting_semaphore<> places{3};

void runInTurn(HungSession& session) {
  places.acquire();
  session.run();
  places.release();
}

/// They wait most of their time: all that this process is to run are begun before the first test.
class HungPartSession : public testing::TestWithParam<HungPart> {
 protected:
  static void SetUpTestSuite() {
    const testing::TestSuite& suite = *testing::UnitTest::GetInstance()->current_test_suite();
    for (const HungPart& part : parts()) {
      if (!isToRun(suite, testNameOf(part))) continue;
      Begun& begun = sessions()[testNameOf(part)];
      begun.session = std::make_unique<HungSession>(part);
      begun.done = std::async(std::launch::async, runInTurn, std::ref(*begun.session));
    }
  }
  static void TearDownTestSuite() { sessions().clear(); }

  static const HungSession& ran() {
    Begun& begun = sessions().at(testNameOf(GetParam()));
    begun.done.wait();
    return *begun.session;
  }

 private:
  struct Begun {
    std::unique_ptr<HungSession> session;
    std::future<void> done;
  };
  static bool isToRun(const testing::TestSuite& suite, const std::string& part) {
    for (int i = 0; i < suite.total_test_count(); ++i) {
      const testing::TestInfo& test = *suite.GetTestInfo(i);
      if (test.should_run() && std::string(test.name()).ends_with("/" + part)) return true;
    }
    return false;
  }
  static std::map<std::string, Begun>& sessions() {
    static std::map<std::string, Begun> all;
    return all;
  }
};

std::vector<runtime::Event> eventsOf(const HungSession& session) {
  return record::SessionReader(session.folder / "A/session.palpa").events();
}

bool tells(const std::vector<runtime::Event>& events, const std::string& words) {
  return std::any_of(events.begin(), events.end(),
                     [&](const auto& event) { return says(event.text, words); });
}

/// Session time at which the request to end was taken: not before it was sent.
std::int64_t endOf(const std::vector<runtime::Event>& events) {
  for (const runtime::Event& event : events)
    if (event.text == "Interrupted") return event.t_ns;
  return -1;
}

double force(const FlightRecord& tick) { return unpack(tick.f_command_D).norm(); }

/// Every tick after the confirmation carries the stop; every one that carries it has no force.
void expectStopped(const HungSession& session, const std::vector<FlightRecord>& ticks,
                   std::int64_t ended_ns) {
  const auto stop = std::find_if(ticks.begin(), ticks.end(),
                                 [](const auto& tick) { return tick.commands.emergency_stop; });
  ASSERT_NE(stop, ticks.end());
  ASSERT_NE(stop, ticks.begin());
  const auto before = std::make_reverse_iterator(stop);
  EXPECT_TRUE(std::any_of(ticks.begin(), stop, [&](const FlightRecord& tick) {
    return tick.t_ns >= session.felt_ns && force(tick) > 0.02;
  })) << "nothing was to be stopped";
  const std::int64_t confirmed_ns = ended_ns - (session.asked_ns - session.confirmed_ns);
  EXPECT_LE(before->t_ns, confirmed_ns) << "a tick after the confirmation did not know of it";
  for (auto tick = stop; tick != ticks.end(); ++tick) {
    ASSERT_EQ(tick->f_command_D, (Packed3{0, 0, 0})) << tick - stop << " ticks after the stop";
    ASSERT_EQ(tick->safety, haptics::SafetyCause::emergency_stop);
  }
  EXPECT_GT(ticks.end() - stop, 1000) << "the loop did not go on";
}

/// Taken after the stop, beside the session's kept pictures.
int picturesAfter(const fs::path& table, std::int64_t t_ns) {
  std::istringstream lines(contentOf(table));
  std::string line;
  std::getline(lines, line);
  int count = 0;
  while (std::getline(lines, line)) count += std::stoll(line.substr(line.find(',') + 1)) > t_ns;
  return count;
}

TEST_P(HungPartSession, HoldsUpNeitherTheStopNorTheOthersNorTheEnd) {
  const HungSession& session = ran();
  ASSERT_EQ(session.trouble, "") << contentOf(session.folder / "err");
  const HungPart& part = session.part;
  const bool for_ever = part.how_long == Hangs::for_ever;
  EXPECT_EQ(session.exit_code, 0) << session.err;
  const std::string report = contentOf(session.folder / "A/report.html");
  EXPECT_GT(report.size(), 1000u);
  EXPECT_TRUE(says(contentOf(session.folder / "A/trials.csv"), "TRIAL"));
  EXPECT_EQ(says(session.err, part.words + " did not answer at the end"), for_ever) << session.err;
  EXPECT_EQ(says(report, "palpa finish"), for_ever && part.ends_anew);
  if (part.calls == "evidence" && for_ever) return;  // it holds nothing of what came then
  const auto events = eventsOf(session);
  EXPECT_TRUE(tells(events, part.words + " does not answer"));
  EXPECT_EQ(tells(events, part.words + " answers again"), !for_ever);
  EXPECT_TRUE(says(report, part.words + " does not answer"));
  const auto ticks = session.ticks();
  const std::int64_t ended_ns = endOf(events);
  ASSERT_GT(ended_ns, 0);
  expectStopped(session, ticks, ended_ns);
  const std::int64_t stop_ns = ended_ns - (session.asked_ns - session.confirmed_ns);
  if (part.calls != "film") {
    EXPECT_GE(picturesAfter(session.folder / "A/camera.mjpeg.csv", stop_ns), 3);
  }
  if (part.calls == "usb") {
    EXPECT_TRUE(session.device_pushed);
    EXPECT_TRUE(session.device_let_go);
  }
}

INSTANTIATE_TEST_SUITE_P(Each, HungPartSession, testing::ValuesIn(parts()),
                         [](const auto& one) { return testNameOf(one.param); });

bool hasTrial(const fs::path& evidence) {
  try {
    return fs::exists(evidence) && !record::SessionReader(evidence).trials().empty();
  } catch (const Error&) {  // it does not say yet what it is
    return false;
  }
}

/// A server that takes connections and never says a word: the trainee is looked up, and the trials
/// are delivered, in vain.
TEST(HungRecords, AServerThatNeverAnswersHoldsUpNeitherBeginningNorEnd) {
  const os::TcpListener silent("127.0.0.1", 0);
  const Folder here;
  const std::string url =
      "postgresql://palpa@127.0.0.1:" + std::to_string(silent.port()) + "/palpa";
  const runtime::SteadyClock clock;
  Running program({"subclavian", "--operator", "expert", "--no-views", "--quiet", "--seed",
                   kShortTrial, "--trials", "9", "--station", quickStation("virtual_bench.json"),
                   "--trainee", "T1", "--records", url, "--out", "A"},
                  here.path(), here / "err");
  const auto wait = [&](const auto& until) {
    for (int i = 0; i < 900 && !until(); ++i)
      clock.sleepUntil(clock.now() + 100 * runtime::kMillisecond);
    return until();
  };
  ASSERT_TRUE(wait([&] { return hasTrial(here / "A/session.palpa") || program.ended(); }));
  EXPECT_TRUE(says(contentOf(here / "err"), "cannot be reached")) << contentOf(here / "err");
  program.send(15);
  ASSERT_TRUE(wait([&] { return program.ended(); })) << "the end";
  EXPECT_EQ(program.exitCode(), 0);
  EXPECT_TRUE(fs::exists(here / "A/report.html"));
  EXPECT_TRUE(fs::exists(here / "A/trials.csv"));
  EXPECT_TRUE(says(contentOf(here / "err"), "not in the records yet")) << contentOf(here / "err");
}

}  // namespace
}  // namespace palpa::cli_test

#include <gtest/gtest.h>

#include <algorithm>

#include "anatomy/base/random.h"
#include "apps/record/session_file.h"
#include "apps/runtime/stop_switch.h"
#include "apps/session/palpation_session.h"
#include "apps/trial/trial_status.h"
#include "tests/session/quick_sessions.h"
#include "tests/support/counts.h"

/// A simulated person who is interrupted goes on where he may.
namespace palpa::session {
namespace {

using trial::UserCommand;

/// Pauses once, or presses the emergency stop; some seconds later all is put right, and it goes on.
class Interrupter {
 public:
  Interrupter(std::uint64_t seed, double latest_s) {
    RandomStream random(seed, "paused_test");
    at_s_ = 1 + (latest_s - 1) * random.uniform();
    for_s_ = 0.3 + 4 * random.uniform();
    stops_ = random.uniform() < 0.5;
  }

  void operator()(std::int64_t now_ns, trial::Channels& channels, runtime::StopSwitch& stop) {
    const double now_s = 1e-9 * static_cast<double>(now_ns);
    if (step_ == 0 && now_s >= at_s_) {
      if (stops_)
        stop.press();
      else
        channels.requests_to_task.push({UserCommand::pause, ""});
      ++step_;
    } else if (step_ == 1 && now_s >= at_s_ + for_s_) {
      if (stops_) channels.requests_to_task.push({UserCommand::rearm, ""});
      ++step_;
    } else if (step_ == 2 && now_s >= at_s_ + for_s_ + 0.2) {
      channels.requests_to_task.push({UserCommand::start, ""});
      ++step_;
    }
  }
  double over_s() const { return at_s_ + for_s_ + 0.2; }  ///< when all was put right again
  std::string words() const {
    return (stops_ ? "stopped " : "paused ") + std::to_string(at_s_) + " s after the start for " +
           std::to_string(for_s_) + " s";
  }

 private:
  double at_s_ = 0, for_s_ = 0;
  bool stops_ = false;
  int step_ = 0;
};

/// The same of somebody who starts the trial, goes on after the interruption and ends the trial.
class InterruptedPerson {
 public:
  InterruptedPerson(std::uint64_t seed, double latest_s) : interrupter_(seed, latest_s) {}

  void operator()(std::int64_t now_ns, trial::Channels& channels, runtime::StopSwitch& stop) {
    interrupter_(now_ns, channels, stop);
    const double now_s = 1e-9 * static_cast<double>(now_ns);
    const auto once = [&](int step, double at_s, UserCommand command) {
      if (step_ != step || now_s < at_s) return;
      channels.requests_to_task.push({command, ""});
      ++step_;
    };
    once(0, kStarts_s, UserCommand::start);
    once(1, interrupter_.over_s() + kGoesOn_s, UserCommand::done);
    once(2, interrupter_.over_s() + kGoesOn_s + 2, UserCommand::quit);
  }
  std::string words() const { return interrupter_.words(); }
  static constexpr double kStarts_s = 4, kGoesOn_s = 8;

 private:
  Interrupter interrupter_;
  int step_ = 0;
};

/// Sessions that are interrupted once at a random moment of their trial; how many reach its end, as
/// the evidence says. Where the moment was before or after the trial the next one is drawn.
template <class Interruption = Interrupter, class Hold>
void expectMostFinish(SessionOptions options, double latest_s, const Hold& hold) {
  const int sessions = palpa::test::counted(4, 50);
  int finished = 0, interrupted = 0;
  for (int i = 1; interrupted < sessions && i <= 3 * sessions; ++i) {
    options.seed = static_cast<std::uint64_t>(i);
    const Interruption interrupter(options.seed, latest_s);
    options.meanwhile = interrupter;
    const std::filesystem::path folder = freshPlace("paused");
    hold(options, folder);
    const record::SessionReader evidence(folder / "session.palpa");
    const record::RecordedTrial trial = evidence.trials().at(0);
    const auto events = evidence.events();
    if (std::none_of(events.begin(), events.end(), [](const runtime::Event& event) {
          return event.trial == 1 && (event.is(runtime::EventKind::pause) ||
                                      event.is(runtime::EventKind::emergency_stop));
        }))
      continue;
    ++interrupted;
    const bool good = trial.end.outcome == "success" || trial.end.outcome == "done";
    finished += good;
    if (!good)
      std::printf("seed %d: %s after %.1f s, %s\n", i, trial.end.outcome.c_str(), trial.length_s(),
                  interrupter.words().c_str());
  }
  std::printf("%d interrupted in their trial, %d finished\n", interrupted, finished);
  EXPECT_EQ(interrupted, sessions) << "the others were over before, or not begun";
  EXPECT_GE(finished, sessions - sessions / 25);
}

TEST(Paused, ANeedleGoesOnAndReachesTheVein) {
  NeedleWorld world(quick(OperatorKind::expert));
  world.station.camera_rate_Hz = 1;
  expectMostFinish(quick(OperatorKind::expert), 20,
                   [&](const SessionOptions& options, const std::filesystem::path& folder) {
                     runNeedleSession(options, world, folder);
                   });
}

TEST(Paused, APalpationIsSearchedToItsEnd) {
  const SessionOptions plain = quick(OperatorKind::expert);
  Quick<PalpationWorld> world(plain);
  expectMostFinish(plain, 60,
                   [&](const SessionOptions& options, const std::filesystem::path& folder) {
                     runPalpation(options, world, folder);
                   });
}

TEST(Paused, APersonsTrialGoesOnToItsEnd) {
  SessionOptions plain = quick(OperatorKind::person);
  plain.demonstration = plain.familiarisation = false;
  Quick<PalpationWorld> world(plain);
  expectMostFinish<InterruptedPerson>(
      plain, 60, [&](const SessionOptions& options, const std::filesystem::path& folder) {
        runPalpation(options, world, folder);
      });
}

}  // namespace
}  // namespace palpa::session

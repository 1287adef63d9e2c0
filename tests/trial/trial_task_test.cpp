#include "apps/trial/trial_task.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <memory>
#include <vector>

#include "anatomy/base/error.h"

namespace palpa::trial {
namespace {

/// A task about nothing.
class PlainTask final : public TrialTask {
 public:
  using TrialTask::TrialTask;
  TrialState state() const { return status().state; }
  const std::string& notice() const { return status().notice; }
  const std::string& canBeDone() const { return status().can_do; }
  void endNow(std::int64_t now_ns) { endTrial(training::Outcome::voided, "", now_ns); }

 protected:
  std::string notReady(const haptics::FlightRecord&) const override { return ""; }
  runtime::TrialHeader begin(std::int64_t now_ns) override {
    return {status().trial, now_ns, 1, "scored", true, 0};
  }
  Conclusion conclude(training::Outcome, const std::string&) override { return {}; }
  void judge(const haptics::FlightRecord&, std::int64_t) override {}
  void command(haptics::TickCommands&) const override {}
  void publishStatus(std::int64_t) override {}
};

/// At a station whose loop fell silent a second ago, as on a computer that was asleep.
TEST(TrialTask, ATrialThatIsBrokenOffBeforeItsFirstTickEndsAsItBegan) {
  constexpr std::int64_t kTick = 3, kNow = 1'000'000'000;
  runtime::Bus bus{runtime::TimeMode::virtual_time};
  Channels channels;
  const auto executive = runtime::makeVirtualExecutive();
  PlainTask task({}, bus, channels, *executive);
  haptics::FlightRecord tick{};
  tick.t_ns = kTick;
  tick.reading.homed = 1;
  bus.haptic_to_task.push(tick);
  runtime::CameraView view;
  view.t_exposure_ns = kNow;
  view.tracking = ar::TrackState::tracked;
  bus.camera_to_task.publish(view, kNow);
  for (std::int64_t now = kNow; now < kNow + 5 && task.state() != TrialState::running; ++now)
    task.step(now);
  ASSERT_EQ(task.state(), TrialState::running);
  channels.signals_to_task.push({UserCommand::quit, "Interrupted"});
  task.step(kNow + 5);

  std::int64_t start_ns = -1, end_ns = -1;
  runtime::EvidenceMessage message;
  while (bus.task_to_recorder.pop(&message)) {
    if (const auto* begun = std::get_if<runtime::TrialHeader>(&message)) start_ns = begun->t_ns;
    if (const auto* ended = std::get_if<runtime::TrialEnd>(&message)) end_ns = ended->t_ns;
  }
  EXPECT_GE(start_ns, kNow);
  EXPECT_EQ(end_ns, start_ns) << "no trial lasts less than no time";
}

/// At a station in real time: a device that is homed, a board that is seen, ticks that are late.
struct Rehearsing : testing::Test {
  /// Ten milliseconds.
  void step() {
    for (int i = 0; i < 10; ++i, now += runtime::kMillisecond) {
      haptics::FlightRecord tick{};
      tick.t_ns = now + late;
      tick.late_ns = late;
      tick.reading.homed = 1;
      bus.haptic_to_task.push(tick);
    }
    runtime::CameraView view;
    view.t_exposure_ns = now;
    view.tracking = ar::TrackState::tracked;
    bus.camera_to_task.publish(view, now);
    ++channels.frames;
    task.step(now);
    runtime::EvidenceMessage message;
    while (bus.task_to_recorder.pop(&message))
      if (const auto* event = std::get_if<runtime::Event>(&message)) events.push_back(*event);
  }
  void run(int steps) {
    for (int i = 0; i < steps; ++i) step();
  }
  std::vector<std::string> of(runtime::EventKind kind) const {
    std::vector<std::string> texts;
    for (const runtime::Event& event : events)
      if (event.is(kind)) texts.push_back(event.text);
    return texts;
  }

  std::int64_t now = runtime::kMillisecond, late = 0;
  runtime::Bus bus{runtime::TimeMode::real};
  Channels channels;
  std::unique_ptr<runtime::Executive> executive = runtime::makeRealExecutive();
  PlainTask task{{2, false, "", {}}, bus, channels, *executive};
  std::vector<runtime::Event> events;
};

/// A person reads how the last trial ended; between trials nobody waits for him.
TEST_F(Rehearsing, TheLastResultStaysUntilItIsClosed) {
  task.stay();
  run(210);
  for (int trial = 1; trial <= 2; ++trial) {
    EXPECT_EQ(task.state(), TrialState::waiting) << trial;
    channels.requests_to_task.push({UserCommand::start, ""});
    step();
    EXPECT_EQ(task.state(), TrialState::running) << trial;
    EXPECT_EQ(task.canBeDone(), "[P] pauses, ? shows keys");
    task.endNow(now);
    run(400);
  }
  EXPECT_EQ(task.state(), TrialState::ended);
  EXPECT_EQ(task.canBeDone(), "Enter closes");
  channels.console_to_task.push({UserCommand::start, ""});
  run(2);
  EXPECT_EQ(task.state(), TrialState::finished);
}

TEST_F(Rehearsing, OneSlipOnEscapeCostsNoTrial) {
  const auto press = [&](UserCommand command) {
    channels.requests_to_task.push({command, ""});
    step();
  };
  run(210);
  press(UserCommand::start);
  press(UserCommand::escape);
  press(UserCommand::escape);  // held: it repeats itself
  EXPECT_EQ(task.state(), TrialState::paused);
  EXPECT_FALSE(task.quit());
  EXPECT_EQ(task.notice(),
            "Escape again ends the session: this trial does not count. Enter continues");
  run(100);
  press(UserCommand::start);
  EXPECT_EQ(task.state(), TrialState::running);
  press(UserCommand::escape);
  EXPECT_FALSE(task.quit()) << "it was taken back";
  run(100);
  press(UserCommand::escape);
  EXPECT_TRUE(task.quit());
}

TEST_F(Rehearsing, EscapeHidesNoEmergencyStopAndReArmingTakesItBack) {
  run(210);
  channels.requests_to_task.push({UserCommand::start, ""});
  step();
  bus.stop.press();
  run(2);
  const std::string stopped = task.notice();
  ASSERT_EQ(stopped.rfind("EMERGENCY STOP", 0), 0u);
  channels.requests_to_task.push({UserCommand::escape, ""});
  step();
  EXPECT_NE(task.notice().find(stopped), std::string::npos);
  run(100);
  channels.requests_to_task.push({UserCommand::rearm, ""});
  step();
  channels.requests_to_task.push({UserCommand::escape, ""});
  step();
  EXPECT_FALSE(task.quit());
}

TEST_F(Rehearsing, EscapeLeavesAtOnceWhereNoTrialIsOn) {
  run(210);
  ASSERT_EQ(task.state(), TrialState::waiting);
  channels.requests_to_task.push({UserCommand::escape, ""});
  step();
  EXPECT_TRUE(task.quit());
}

TEST_F(Rehearsing, HowTheToolIsMovedIsSaidWhileNothingElseIs) {
  task.isMovedBy("Drag: over the skin");
  run(210);
  channels.requests_to_task.push({UserCommand::start, ""});
  step();
  step();
  EXPECT_EQ(task.canBeDone(), "Drag: over the skin. ? shows keys");
}

TEST_F(Rehearsing, WhatATrialIsForIsSaidUntilItBegins) {
  task.isFor("Find the lump.");
  run(210);
  EXPECT_EQ(task.notice(), "Find the lump.\nEnter starts, ? shows keys");
  channels.requests_to_task.push({UserCommand::start, ""});
  step();
  step();
  EXPECT_EQ(task.notice().find("Find the lump."), std::string::npos);
}

TEST_F(Rehearsing, HowATrialEndedStandsUntilTheNextBegins) {
  task.isFor("Find the lump.");
  run(210);
  channels.requests_to_task.push({UserCommand::start, ""});
  step();
  task.endNow(now);
  step();
  const std::string ended = task.notice();
  ASSERT_FALSE(ended.empty());
  run(1000);
  EXPECT_EQ(task.state(), TrialState::waiting);
  EXPECT_EQ(task.notice(), ended + "\nEnter starts, ? shows keys");
  channels.requests_to_task.push({UserCommand::start, ""});
  step();
  step();
  EXPECT_EQ(task.notice().find(ended), std::string::npos);
}

TEST_F(Rehearsing, BesideAWarningWhatATrialIsForIsSaidToo) {
  task.isFor("Find the lump.");
  task.warn("This device keeps its last force");
  run(210);
  EXPECT_EQ(task.notice(),
            "Find the lump.\nThis device keeps its last force. Enter starts, ? shows keys");
}

TEST_F(Rehearsing, WhoGoesAwayHoldsTheStationUpForAMinute) {
  task.stay();
  run(210);
  for (int trial = 1; trial <= 2; ++trial) {
    channels.requests_to_task.push({UserCommand::start, ""});
    step();
    task.endNow(now);
    run(400);
  }
  run(5500);
  EXPECT_EQ(task.state(), TrialState::ended);
  run(150);
  EXPECT_EQ(task.state(), TrialState::finished);
}

TEST_F(Rehearsing, TakesTwoSecondsAndSaysNothingWhereTheComputerKeepsUp) {
  run(150);
  EXPECT_EQ(task.state(), TrialState::checking);
  EXPECT_EQ(task.notice(), "Checking this computer, 2 s");
  run(60);
  EXPECT_EQ(task.state(), TrialState::waiting);
  EXPECT_EQ(task.notice(), "Press Enter to start. ? shows keys");
  EXPECT_TRUE(of(runtime::EventKind::computer).empty());
}

TEST_F(Rehearsing, SaysWhatTheComputerCannotDoAndForbidsNothing) {
  late = 2'400'000;
  run(210);
  ASSERT_EQ(task.state(), TrialState::waiting);
  EXPECT_EQ(task.notice(),
            "The haptic loop is late (99 % below 2.4 ms): close other programs. Enter starts, "
            "? shows keys");
  EXPECT_EQ(of(runtime::EventKind::computer),
            (std::vector<std::string>{"The haptic loop is late (99 % below 2.4 ms): close other "
                                      "programs; palpa doctor tells more"}));
  ASSERT_EQ(task.safetyEvents().size(), 1u) << "for the report";
  channels.requests_to_task.push({UserCommand::start, ""});
  step();
  EXPECT_EQ(task.state(), TrialState::running);
}

TEST_F(Rehearsing, ATrialIsMarkedByTheTicksThatItMissed) {
  run(210);
  channels.requests_to_task.push({UserCommand::start, ""});
  step();
  ASSERT_EQ(task.state(), TrialState::running);
  late = 3 * runtime::kMillisecond;
  run(5);
  late = 0;
  task.endNow(now);
  run(1);
  ASSERT_EQ(of(runtime::EventKind::computer).size(), 1u);
  const auto marked = std::find_if(events.begin(), events.end(), [](const runtime::Event& e) {
    return e.is(runtime::EventKind::computer);
  });
  EXPECT_EQ(marked->value, 50);
  EXPECT_EQ(marked->trial, 1);
  ASSERT_EQ(task.safetyEvents().size(), 1u) << "for the report";
  run(310);  // no second rehearsal
  EXPECT_EQ(task.state(), TrialState::waiting);
}

/// Somebody makes up his mind about the first; meanwhile the second has begun.
TEST_F(Rehearsing, OnlyTheTrialThatIsMeantIsEndedByHand) {
  run(210);
  channels.requests_to_task.push({UserCommand::start, ""});
  step();
  task.endNow(now);
  run(310);
  channels.requests_to_task.push({UserCommand::start, ""});
  step();
  ASSERT_EQ(task.state(), TrialState::running);
  for (const UserCommand command : {UserCommand::void_trial, UserCommand::abort}) {
    channels.requests_to_task.push({command, "The bed moved", 0, 1});
    step();
    EXPECT_EQ(task.state(), TrialState::running);
  }
  const std::string kept =
      "Trial 1 had ended when it was to be ended by hand: nothing was changed. The bed moved";
  EXPECT_EQ(of(runtime::EventKind::note), (std::vector<std::string>{kept, kept}));
  channels.requests_to_task.push({UserCommand::void_trial, "The bed moved", 0, 2});
  step();
  EXPECT_EQ(task.state(), TrialState::ended);
}

/// A simulated person does what he sees.
TEST_F(Rehearsing, WhoSeesNoPicturesHasLongerToBecomeReady) {
  PlainTask automatic{{2, true, "", {}}, bus, channels, *executive};
  const auto wait = [&](int seconds) {  // and no camera
    for (int i = 0; i < 100 * seconds; ++i, now += 10 * runtime::kMillisecond) automatic.step(now);
  };
  EXPECT_NO_THROW(wait(20));
  channels.frames += 450;
  EXPECT_THROW(wait(1), Error);
}

TEST_F(Rehearsing, AStopKeyThatIsHeldIsOneEmergencyStopUntilSomebodyReArms) {
  run(210);
  for (int i = 0; i < 5; ++i) {
    bus.stop.press();
    step();
  }
  EXPECT_EQ(of(runtime::EventKind::emergency_stop).size(), 1u);
  channels.requests_to_task.push({UserCommand::rearm, ""});
  step();
  EXPECT_FALSE(bus.stop.noForce());
  bus.stop.press();
  step();
  EXPECT_EQ(of(runtime::EventKind::emergency_stop).size(), 2u);
}

/// The loop takes the force away as for an emergency stop; but nobody pressed one.
TEST_F(Rehearsing, TheEndOfASessionIsNoEmergencyStop) {
  run(210);
  const auto trip = [this] {
    haptics::FlightRecord tick{};
    tick.t_ns = now;
    tick.reading.homed = 1;
    tick.safety = haptics::SafetyCause::emergency_stop;
    tick.events = haptics::kSafetyTripped;
    bus.haptic_to_task.push(tick);
    step();
  };
  bus.stop.end();
  trip();
  EXPECT_TRUE(of(runtime::EventKind::safety).empty());
  EXPECT_TRUE(of(runtime::EventKind::emergency_stop).empty());
}

TEST_F(Rehearsing, WhatWhoeverHoldsTheDeviceHasToKnowIsSaidToo) {
  task.warn("This device keeps its last force");
  run(210);
  EXPECT_EQ(task.notice(), "This device keeps its last force. Enter starts, ? shows keys");
  EXPECT_EQ(of(runtime::EventKind::device),
            (std::vector<std::string>{"This device keeps its last force"}));
}

}  // namespace
}  // namespace palpa::trial

#include "apps/trial/trial_task.h"

#include <gtest/gtest.h>

namespace palpa::trial {
namespace {

/// A task about nothing.
class PlainTask final : public TrialTask {
 public:
  using TrialTask::TrialTask;
  TrialState state() const { return status().state; }

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

}  // namespace
}  // namespace palpa::trial

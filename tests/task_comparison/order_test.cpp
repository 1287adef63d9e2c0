#include <gtest/gtest.h>

#include <memory>

#include "apps/task_comparison/comparison_task.h"

namespace palpa::task_comparison {
namespace {

/// A trial in which four surfaces are put in order, with a loop that does as it is told.
class Ordering : public testing::Test {
 protected:
  Ordering() {
    settings_.touch = 0.1;
    settings_.sort_limit_s = 60;
    const ComparisonTaskSetup setup{
        .settings = settings_, .tools = 1, .not_scored = "", .comparisons = {four_}, .places = {}};
    task_ = std::make_unique<ComparisonTask>(setup, bus_, channels_, *executive_);
    pass(0.5, 0);
  }

  /// So many seconds with this force on the tool.
  void pass(double seconds, double force_N) {
    constexpr int kTicks = 10;  // between two steps of the task
    for (int i = 0; i < static_cast<int>(100 * seconds); ++i) {
      for (int k = 0; k < kTicks; ++k, now_ += runtime::kMillisecond) {
        haptics::FlightRecord tick{};
        tick.t_ns = now_;
        tick.reading.homed = 1;
        tick.sensed.state = haptics::SensorState::valid;
        tick.sensed.f_D = {0, 0, force_N};
        tick.commands = commands_;
        bus_.haptic_to_task.push(tick);
      }
      runtime::CameraView view;
      view.t_exposure_ns = now_;
      view.tracking = ar::TrackState::tracked;
      bus_.camera_to_task.publish(view, now_);
      task_->step(now_);
      if (const haptics::TickCommands* told = bus_.task_to_haptic.read(now_)) commands_ = *told;
      if (const ComparisonStatus* told = channels_.status_to_scene.read(now_)) status_ = *told;
    }
  }
  void say(const char* number) {
    channels_.operator_to_task.push({trial::UserCommand::choose, number});
    pass(0.02, 0);
  }
  void next(double force_N = 0) {
    channels_.operator_to_task.push({trial::UserCommand::done, ""});
    pass(0.02, force_N);
  }
  void strokeAll() {
    for (int i = 0; i < 4; ++i) {
      pass(0.3, 0.5);
      pass(0.05, 0);
      next();
    }
  }

  ComparisonSettings settings_;
  const Comparison four_{assess::ComparedProperty::friction, {1, 2, 0.5, 1.4}};
  std::int64_t now_ = runtime::kMillisecond;
  runtime::Bus bus_{runtime::TimeMode::virtual_time};
  ComparisonChannels channels_{runtime::TimeMode::virtual_time};
  std::unique_ptr<runtime::Executive> executive_ = runtime::makeVirtualExecutive();
  std::unique_ptr<ComparisonTask> task_;
  haptics::TickCommands commands_;
  ComparisonStatus status_;
};

TEST_F(Ordering, SurfacesComeInACircleAndNeverChangeUnderTheHand) {
  ASSERT_TRUE(status_.active()) << status_.notice;
  for (const double factor : {1.0, 2.0, 0.5, 1.4, 1.0}) {
    EXPECT_EQ(commands_.friction, static_cast<float>(factor));
    pass(0.3, 0.5);
    next(0.5);
    EXPECT_EQ(commands_.friction, static_cast<float>(factor));
    EXPECT_EQ(status_.notice, "Lift first: then comes the next surface");
    pass(0.05, 0);
    next();
  }
}

TEST_F(Ordering, ItIsSaidNumberByNumberOnceEachWasStroked) {
  ASSERT_TRUE(status_.active()) << status_.notice;
  pass(0.3, 0.5);
  pass(0.05, 0);
  say("3");
  EXPECT_EQ(status_.notice, "Stroke over each of them first");
  EXPECT_TRUE(status_.order.empty());
  next();
  for (int i = 0; i < 3; ++i) {
    pass(0.3, 0.5);
    pass(0.05, 0);
    next();
  }
  for (const char* number : {"3", "3", "7", "0"}) say(number);
  EXPECT_EQ(status_.order, std::vector<int>{3});
  EXPECT_TRUE(status_.active());
  for (const char* number : {"1", "2", "4"}) say(number);
  ASSERT_EQ(task_->completed().size(), 1u);
  const assess::ComparisonTrial& trial = task_->completed().front().trial;
  EXPECT_EQ(trial.outcome, training::Outcome::done);
  EXPECT_EQ(trial.order, (std::vector<int>{3, 1, 2, 4}));
  EXPECT_NEAR(trial.tau().value_or(0), 4.0 / 6, 1e-12);
  EXPECT_EQ(trial.touches, (std::vector<int>{1, 1, 1, 1}));
}

TEST_F(Ordering, TimeEndsItWithoutAnAnswer) {
  ASSERT_TRUE(status_.active()) << status_.notice;
  strokeAll();
  say("1");
  pass(61, 0);
  ASSERT_EQ(task_->completed().size(), 1u);
  EXPECT_EQ(task_->completed().front().trial.outcome, training::Outcome::time);
  EXPECT_FALSE(task_->completed().front().trial.tau());
}

}  // namespace
}  // namespace palpa::task_comparison

#include <gtest/gtest.h>

#include <atomic>
#include <cmath>
#include <numbers>

#include "activities.h"
#include "anatomy/query/local_geometry_builder.h"
#include "apps/runtime/camera_activity.h"
#include "apps/runtime/device_activity.h"
#include "apps/runtime/device_adapters.h"
#include "apps/runtime/geometry_activity.h"
#include "apps/runtime/haptic_activity.h"
#include "apps/runtime/recorders.h"
#include "tests/devices/scripted_station.h"
#include "tests/haptics/needle_bench.h"
#include "tests/support/allocation_count.h"
#include "tests/support/simple_patient.h"

/// Every thread that a session has, for some hundred ticks in real time: a Falcon's (on a scripted
/// cable), a force sensor's, the haptic loop's, geometry on a mesh, the camera's, the task's, the
/// recorder's. Run under the thread sanitizer too. Nothing here says how long anything took.
namespace palpa::runtime {
namespace {

constexpr std::size_t kTicks = 300;

/// Nothing is allocated in its steps.
class Guarded final : public Activity {
 public:
  explicit Guarded(Activity& inner) : inner_(inner) {}
  const char* name() const override { return inner_.name(); }
  std::int64_t period_ns() const override { return inner_.period_ns(); }
  std::int64_t step(std::int64_t now_ns) override {
    const NoAllocation guard;
    const std::int64_t due = inner_.step(now_ns);
    allocations += guard.allocations();
    return due;
  }
  std::atomic<int> allocations{0};

 private:
  Activity& inner_;
};

class Counting final : public FlightSink {
 public:
  void beginTrial(const TrialHeader&) override {}
  void snapshot(const LocalGeometry& geometry) override { bones += geometry.bone_count; }
  void tick(const haptics::FlightRecord& record) override {
    pushed += record.f_command_D != Packed3{0, 0, 0};
    sensed += record.sensed.state == haptics::SensorState::valid;
    ++ticks;
  }
  void keyframe(std::int64_t, const haptics::TickState&) override {}
  void event(const Event&) override {}
  void endTrial(const TrialEnd&) override {}
  void commit() override {}
  int pushed = 0, sensed = 0, ticks = 0, bones = 0;
};

anatomy::Patient ball() {
  anatomy::Patient patient;
  patient.organs.push_back(
      {"skin", Organ::skin, test::sphere({0, 0, -0.2}, Vec3::Constant(0.2)), {1, 1, 1, 1}});
  patient.organs.push_back(
      {"bone", Organ::rib, test::sphere({0.01, 0, -0.02}, {0.006, 0.05, 0.006}), {1, 1, 1, 1}});
  return patient;
}

TEST(AllThreads, RunTogetherAndTheHapticOneNeverAllocates) {
  const auto executive = makeRealExecutive();
  Bus bus(TimeMode::real);
  const anatomy::Patient patient = ball();
  const anatomy::SurfaceQuery query(patient);
  const anatomy::LocalGeometryBuilder builder(patient, query);
  const Pose X_DA =
      makePose(Mat3::Identity(), haptics::kFalconCentre + Vec3(0, 0, 0.001));  // the tip 1 mm deep

  test::Station station;
  station.twin.startFirmware();
  station.rig.holdGripAt(haptics::kFalconCentre);
  DriverActivity falcon(station.rig.driver, bus.device_to_task);
  ChannelSensor sensor({}, TimeMode::real, 1'000'000'000);
  haptics::WrenchFilter filter;
  filter.low_pass = haptics::butterworth(50, 1000);
  ForceSensing sensing(sensor, {filter, Pose::Identity(), Pose::Identity()});
  haptics::TickConfig config;
  config.materials = haptics::NeedleBench{}.materials;
  config.X_ET.q = {0, 1, 0, 0};
  // A busy machine must not look like a fault.
  config.safety.watchdog_ns = config.safety.silent_ns = config.age_limit_ns = 1'000'000'000;
  HapticActivity haptic(bus, station.rig.driver, config, &sensing);
  Guarded guarded(haptic);
  GeometryActivity geometry(bus, builder, X_DA);
  const auto board = ar::makeBoard("tags:2x2:0.030:0.0075");
  const calibration::CameraModel lens{64, 64, 60, 60, 31.5, 31.5, {}, 0};
  CameraActivity camera(
      bus,
      [](std::int64_t now, std::uint64_t number) -> CameraActivity::Exposure {
        return [=](const cv::Rect&) -> std::optional<ar::Frame> {
          return ar::Frame{number, now, cv::Mat(64, 64, CV_8UC1, cv::Scalar(9)), "dark"};
        };
      },
      *board, lens, {20 * kMillisecond, 10 * kMillisecond, TimeMode::real});
  Counting sink;
  RecorderActivity recorder(bus, sink);
  std::uint64_t samples = 0;
  Doing measure("sensor", [&](std::int64_t now) {
    haptics::WrenchSample sample;
    sample.t_ns = now;
    sample.sequence = ++samples;
    sensor.publish(sample, now);
    // The grip goes in and out: 1 mm under the skin to 1 mm above it, twice a second.
    station.rig.holdGripAt(
        haptics::kFalconCentre +
        Vec3(0, 0, 0.001 + 0.001 * std::cos(4e-9 * std::numbers::pi * static_cast<double>(now))));
    return now + kMillisecond;
  });
  std::size_t judged = 0, notices = 0, steps = 0;
  Doing task("task", [&](std::int64_t now) {
    haptics::TickCommands commands;
    commands.armed = commands.trial = 1;
    bus.task_to_haptic.publish(commands, now);
    for (haptics::FlightRecord record; bus.haptic_to_task.pop(&record);)
      judged += record.f_command_D != Packed3{0, 0, 0};
    for (Event event; bus.device_to_task.pop(&event);) ++notices;
    bus.task_to_recorder.push(Event{now, 1, "note", "a text that has to be allocated", 0});
    bus.camera_to_task.read(now);
    if (judged >= kTicks || ++steps > 3000)
      executive->stop();  // the second: half a minute without force
    return now + 10 * kMillisecond;
  });
  std::uint64_t pictures = 0;
  Doing scene("scene", [&](std::int64_t now) {
    if (const CameraView* view = bus.camera_to_scene.read(now)) pictures = view->number;
    bus.haptic_to_scene.read(now);
    return now + 33 * kMillisecond;
  });
  executive->add(falcon, {0, false, false});
  executive->add(measure, {0, false, false});
  executive->add(guarded, {1, true, false});
  executive->add(geometry, {2, false, false});
  executive->add(camera, {3, false, false});
  executive->add(task, {4, false, false});
  executive->add(scene, {5, false, true});
  executive->add(recorder, {6, false, false});
  executive->run();
  recorder.finish();

  EXPECT_EQ(guarded.allocations, 0);
  EXPECT_EQ(recorder.dropped(), 0u);
  EXPECT_GE(sink.pushed, static_cast<int>(kTicks));
  EXPECT_GT(sink.sensed, 0);
  EXPECT_GT(sink.bones, 0);
  EXPECT_GT(pictures, 0u);
  EXPECT_GT(notices, 0u) << "homing was told";
  EXPECT_FALSE(station.rig.lastCommand().pushes());
}

}  // namespace
}  // namespace palpa::runtime

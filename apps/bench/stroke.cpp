#include "apps/bench/stroke.h"

#include <cmath>
#include <memory>
#include <numbers>

#include "anatomy/base/quantile.h"
#include "apps/bench/bench_patients.h"
#include "apps/bench/timing.h"
#include "apps/runtime/clock.h"
#include "apps/runtime/executive.h"
#include "apps/runtime/geometry_activity.h"
#include "apps/runtime/haptic_activity.h"
#include "haptics/loop/tick.h"

namespace palpa::bench {
namespace {

using runtime::TimeMode;
constexpr std::int64_t kTick = 1'000'000;

/// Moves the device, and takes the records off the queues.
class StrokeHand final : public runtime::Activity {
 public:
  StrokeHand(const StrokeSettings& settings, runtime::Bus& bus, runtime::ChannelDevice& device,
             StrokeResult& result)
      : end_s_(settings.seconds), led_(settings, device), bus_(bus), result_(result) {
    arm(bus);
  }
  const char* name() const override { return "hand"; }
  std::int64_t step(std::int64_t now_ns) override {
    led_.lead(now_ns);
    drain(bus_, &result_);
    return static_cast<double>(now_ns) * 1e-9 < end_s_ ? now_ns + kTick : runtime::kNever;
  }

 private:
  double end_s_;
  LedDevice led_;
  runtime::Bus& bus_;
  StrokeResult& result_;
};

/// Stops everything when the stroke is over.
class End final : public runtime::Activity {
 public:
  End(runtime::Executive& executive, double seconds)
      : executive_(executive), end_ns_(std::int64_t(seconds * 1e9)) {}
  const char* name() const override { return "end"; }
  std::int64_t step(std::int64_t now_ns) override {
    if (now_ns < end_ns_) return end_ns_;
    executive_.stop();
    return runtime::kNever;
  }

 private:
  runtime::Executive& executive_;
  std::int64_t end_ns_;
};

}  // namespace

Vec3 strokePoint(const StrokeSettings& settings, double t_s) {
  const double turn = 2 * std::numbers::pi * settings.stroke_Hz * t_s;
  const TorsoPoint q = torsoAt(0.040 * std::sin(turn), 0.025 * std::sin(0.31 * turn + 0.5));
  return q.p - settings.depth * q.n;
}

haptics::TickConfig strokeConfig(const StrokeSettings& settings) {
  haptics::TickConfig config;
  config.contact_mode = haptics::ContactMode::probe;
  config.probe.stiffness = settings.stiffness;
  config.coupling.stiffness = settings.coupling;
  config.passivity.max_damping = 9;  // 0.2 m / T of 45 g at 1 kHz
  config.passivity.coulomb = 0.06;
  return config;
}

StrokeResult runStroke(const StrokeSettings& settings,
                       const anatomy::LocalGeometryBuilder& builder) {
  StrokeResult result;
  runtime::Bus bus(TimeMode::virtual_time);
  runtime::ChannelDevice device({}, TimeMode::virtual_time);
  const haptics::TickConfig config = strokeConfig(settings);
  runtime::GeometryActivity::Settings pace;
  pace.period_ns = std::int64_t(1e9 / settings.geometry_Hz);
  pace.blend_ns = config.blend_ns;
  const auto executive = runtime::makeVirtualExecutive();
  StrokeHand hand(settings, bus, device, result);
  runtime::HapticActivity haptic(bus, device, config);
  runtime::GeometryActivity geometry(bus, builder, Pose::Identity(), pace);
  End end(*executive, settings.seconds);
  executive->add(hand, {0, false, false});
  executive->add(haptic, {1, true, false});
  executive->add(geometry, {2, false, false});
  executive->add(end, {3, false, false});
  executive->run();
  drain(bus, &result);
  return result;
}

haptics::DeviceReading LedDevice::lead(std::int64_t now_ns) {
  haptics::DeviceReading reading;
  reading.t_ns = now_ns;
  reading.sequence = ++sequence_;
  reading.homed = 1;
  reading.p_DE = pack(strokePoint(stroke_, 1e-9 * static_cast<double>(now_ns)));
  device_.publish(reading, now_ns);
  return reading;
}

void arm(runtime::Bus& bus) {
  haptics::TickCommands commands;
  commands.armed = 1;
  bus.task_to_haptic.publish(commands, 0);
}

std::uint64_t drain(runtime::Bus& bus, StrokeResult* result) {
  std::uint64_t contacts = 0;
  haptics::FlightRecord record;
  while (bus.haptic_to_task.pop(&record)) {
    contacts += unpack(record.f_contact_D).norm() > 0;
    if (result) result->records.push_back(record);
  }
  while (bus.haptic_to_recorder.pop(&record)) {
  }
  runtime::Keyframe keyframe;
  while (bus.keyframes_to_recorder.pop(&keyframe)) {
  }
  LocalGeometry geometry;
  while (bus.geometry_to_recorder.pop(&geometry))
    if (result) result->snapshots.push_back(geometry);
  return contacts;
}

namespace {

/// Runs the stroke's ticks again, round and round, with its snapshots when they came.
class StrokeReplay {
 public:
  StrokeReplay(const StrokeSettings& settings, const StrokeResult& stroke)
      : config_(strokeConfig(settings)),
        stroke_(stroke),
        state_(std::make_unique<haptics::TickState>()) {}

  void step() {
    const haptics::FlightRecord& was = stroke_.records[at_];
    const LocalGeometry* latest = was.snapshot > 0 ? &stroke_.snapshots[was.snapshot - 1] : nullptr;
    haptics::DeviceReading reading = was.reading;
    reading.sequence = ++sequence_;
    sink_ = haptics::tick(config_, *state_, reading, latest, was.commands, was.t_ns);
    if (++at_ == stroke_.records.size()) {
      at_ = 0;
      *state_ = haptics::TickState{};
    }
  }

 private:
  haptics::TickConfig config_;
  const StrokeResult& stroke_;
  std::unique_ptr<haptics::TickState> state_;
  haptics::FlightRecord sink_;
  std::size_t at_ = 0;
  std::uint64_t sequence_ = 0;
};

}  // namespace

TickTiming timeHot(const StrokeSettings& settings, const StrokeResult& stroke, int ticks) {
  constexpr int kBatch = 16;
  StrokeReplay again(settings, stroke);
  for (int i = 0; i < 2000; ++i) again.step();
  const runtime::SteadyClock clock;
  std::vector<double> each;
  for (int i = 0; i < ticks; i += kBatch) {
    const std::int64_t start = clock.now();
    for (int k = 0; k < kBatch; ++k) again.step();
    each.push_back(1e-3 * double(clock.now() - start) / kBatch);
  }
  return {quantile(each, 0.5), quantile(each, 0.99)};
}

TickTiming timePaced(const StrokeSettings& settings, const StrokeResult& stroke, double seconds) {
  StrokeReplay again(settings, stroke);
  runtime::SteadyClock clock;
  std::vector<double> each;
  std::int64_t due = clock.now();
  for (int i = 0; i < int(seconds * 1000); ++i) {
    clock.sleepUntil(due += 1'000'000);
    const std::int64_t start = clock.now();
    again.step();
    each.push_back(1e-3 * double(clock.now() - start));
  }
  return {quantile(each, 0.5), quantile(each, 0.99)};
}

}  // namespace palpa::bench

#include "apps/bench/stroke.h"

#include <cmath>
#include <numbers>

#include "apps/bench/bumpy_torso.h"
#include "apps/bench/led_device.h"
#include "apps/runtime/executive.h"
#include "apps/runtime/geometry_activity.h"
#include "apps/runtime/haptic_activity.h"

namespace palpa::bench {
namespace {

using runtime::TimeMode;
constexpr std::int64_t kTick = 1'000'000;

/// Moves the device, and takes the records off the queues.
class Hand final : public runtime::Activity {
 public:
  Hand(const StrokeSettings& settings, runtime::Bus& bus, runtime::ChannelDevice& device,
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
  config.engine = haptics::Engine::probe;
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
  Hand hand(settings, bus, device, result);
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

}  // namespace palpa::bench

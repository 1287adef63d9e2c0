#include "apps/bench/loop_segment.h"

#include <thread>

#include "apps/bench/led_device.h"
#include "apps/runtime/executive.h"
#include "apps/runtime/geometry_activity.h"
#include "apps/runtime/haptic_activity.h"

namespace palpa::bench {
namespace {

using runtime::kMillisecond;
using runtime::TimeMode;

/// Moves the device; without a haptic loop it also tells geometry where the tool is.
class Leader final : public runtime::Activity {
 public:
  Leader(const StrokeSettings& stroke, runtime::Bus& bus, runtime::ChannelDevice& device,
         bool tells_geometry)
      : led_(stroke, device), bus_(bus), tells_geometry_(tells_geometry) {
    arm(bus);
  }
  const char* name() const override { return "device"; }
  std::int64_t step(std::int64_t now_ns) override {
    runtime::ToolState tool;
    tool.t_ns = now_ns;
    tool.X_DT.p = led_.lead(now_ns).p_DE;
    if (tells_geometry_) bus_.haptic_to_geometry.publish(tool, now_ns);
    return now_ns + kMillisecond;
  }

 private:
  LedDevice led_;
  runtime::Bus& bus_;
  bool tells_geometry_;
};

/// Takes off what the recorder and the task would.
class Drain final : public runtime::Activity {
 public:
  explicit Drain(runtime::Bus& bus) : bus_(bus) {}
  const char* name() const override { return "drain"; }
  std::int64_t step(std::int64_t now_ns) override {
    contacts_ += drain(bus_, nullptr);
    return now_ns + 100 * kMillisecond;
  }
  std::uint64_t contacts() const { return contacts_; }

 private:
  runtime::Bus& bus_;
  std::uint64_t contacts_ = 0;
};

class Curfew final : public runtime::Activity {
 public:
  Curfew(runtime::Executive& executive, std::int64_t length_ns)
      : executive_(executive), length_ns_(length_ns) {}
  const char* name() const override { return "curfew"; }
  std::int64_t step(std::int64_t now_ns) override {
    if (end_ns_ == 0) return end_ns_ = now_ns + length_ns_;
    executive_.stop();
    return runtime::kNever;
  }

 private:
  runtime::Executive& executive_;
  std::int64_t length_ns_, end_ns_ = 0;
};

struct Rig {
  Rig(const LoopSurroundings& around, std::int64_t length_ns, bool tells_geometry)
      : bus(TimeMode::real),
        device({}, TimeMode::real),
        hand(around.stroke, bus, device, tells_geometry),
        geometry(bus, around.builder, Pose::Identity()),
        drain(bus),
        curfew(*executive, length_ns) {
    executive->add(hand, {0, false, false});
    executive->add(geometry, {2, false, false});
    executive->add(drain, {6, false, false});
    executive->add(curfew, {7, false, false});
    if (around.scene) executive->add(*around.scene, {5, false, true});
  }
  std::unique_ptr<runtime::Executive> executive = runtime::makeRealExecutive();
  runtime::Bus bus;
  runtime::ChannelDevice device;
  Leader hand;
  runtime::GeometryActivity geometry;
  Drain drain;
  Curfew curfew;
};

}  // namespace

OurTimes runOurSegment(const LoopSurroundings& around, std::int64_t length_ns) {
  const auto rig = std::make_unique<Rig>(around, length_ns, false);
  haptics::TickConfig config = strokeConfig(around.stroke);
  config.period_ns = around.period_ns;
  runtime::HapticActivity haptic(rig->bus, rig->device, config);
  rig->executive->add(haptic, {1, true, false, around.cpu});
  rig->executive->run();
  rig->drain.step(0);
  const runtime::Lateness late = rig->executive->lateness().back();
  return {{late.late, late.missed_ticks, late.scheduling}, late.cost, rig->drain.contacts()};
}

LoopTimes runBareSegment(const LoopSurroundings& around, std::int64_t length_ns) {
  const auto rig = std::make_unique<Rig>(around, length_ns, true);
  LoopTimes times;
  std::thread bare([&] { times = runBareLoop(around.period_ns, length_ns, around.cpu); });
  rig->executive->run();
  bare.join();
  return times;
}

}  // namespace palpa::bench

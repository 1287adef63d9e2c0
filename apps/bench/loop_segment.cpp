#include "apps/bench/loop_segment.h"

#include <algorithm>
#include <cmath>
#include <thread>
#include <utility>

#include "apps/bench/bench_patients.h"
#include "apps/bench/stroke.h"
#include "apps/os/child_process.h"
#include "apps/os/local_socket.h"
#include "apps/os/real_time.h"
#include "apps/runtime/clock.h"
#include "apps/runtime/executive.h"
#include "apps/runtime/geometry_activity.h"
#include "apps/runtime/haptic_activity.h"
#include "scene/view/scene_view.h"

namespace palpa::bench {

LoopTimes runBareLoop(std::int64_t period_ns, std::int64_t length_ns, int cpu) {
  LoopTimes times;
  const os::MemoryLock memory;
  times.scheduling = os::becomeRealTime(cpu) + "; " + memory.words();
  const runtime::SteadyClock clock;
  std::int64_t due = clock.now();
  for (const std::int64_t end = due + length_ns; due < end;) {
    clock.sleepUntil(due);
    const std::int64_t now = clock.now();
    times.late.add(now - due);
    times.missed += now - due > period_ns;
    due = std::max(due + period_ns, now);
  }
  return times;
}

namespace {

constexpr std::int64_t kPicture = 66'000'000;  // ns, as a session tells them

}  // namespace

Onlookers::Onlookers(int pages)
    : path_(os::socketFolder() + "/bench-" + std::to_string(os::processNumber()) + ".sock"),
      port_(path_, log_, [](const std::string&) {}),
      link_(path_) {
  for (int i = 0; i < pages; ++i)
    pages_.emplace_back([this](const std::stop_token& ending) { look(ending); });
}

void Onlookers::show(scene::Image picture) {
  next_ns_ = clock_.now() + kPicture;
  port_.offer(std::move(picture));
  log_.addPassing(
      R"({"kind":"curve","t_s":[1.02,1.04,1.06],"force_N":[0.51,0.52,0.53],"depth_mm":[12.1,12.2,12.3]})",
      1);
}

void Onlookers::look(const std::stop_token& ending) {
  os::giveWay();
  std::string page;
  for (std::uint64_t last = 0; !ending.stop_requested();) {
    const console::SessionLink::Picture picture =
        link_.picture(last, std::chrono::milliseconds(200));
    if (!picture.jpeg) continue;
    last = picture.number;
    page = *picture.jpeg;
    ++pictures_;
  }
}

namespace {

constexpr std::int64_t kFrame = 33'333'333;

void paint(scene::Image& image, int frame) {
  for (std::size_t i = 0; i < image.pixels.size(); ++i)
    image.pixels[i] = static_cast<std::uint8_t>(i / 96 + static_cast<std::size_t>(frame));
}

}  // namespace

struct SceneLoad::Impl {
  anatomy::Patient patient = referenceBust();
  scene::ViewLayout layout;
  std::unique_ptr<scene::GlContextProvider> context =
      scene::makeGlContext(scene::Display::offscreen, layout.width, layout.height, "Palpa");
  scene::SceneView view{*context, patient, layout};
  scene::Image picture{640, 480, 3, std::vector<std::uint8_t>(640 * 480 * 3)};
  scene::SceneState state;
  int frames = 0;
};

SceneLoad::SceneLoad() : impl_(std::make_unique<Impl>()) {}
SceneLoad::~SceneLoad() = default;
int SceneLoad::frames() const { return impl_->frames; }
std::string SceneLoad::drawnOn() const { return impl_->context->describe(); }

std::int64_t SceneLoad::step(std::int64_t now_ns) {
  Impl& own = *impl_;
  const Vec3 entry_A = own.patient.landmark(anatomy::landmark::kEntry);
  const double sway = std::sin(1e-9 * static_cast<double>(now_ns));
  paint(own.picture, own.frames);
  own.state.picture = &own.picture;
  own.state.registered = true;
  own.state.X_CA = lookAt(entry_A + Vec3(0.02 * sway, -0.45, 0.10), entry_A);
  own.state.X_AT = makePose(Quat(Eigen::AngleAxisd(-1.2, Vec3::UnitX())).toRotationMatrix(),
                            entry_A + Vec3(0, 0.01 * sway, 0));
  own.state.forces = {
      {scene::ForceKind::reaction, own.state.X_AT.translation(), Vec3(0, -1 - sway, 0)}};
  own.state.hud.force = std::to_string(1 + sway) + " N";
  own.view.show(own.state);
  if (onlookers_ && onlookers_->wantPicture()) onlookers_->show(own.view.capture());
  ++own.frames;
  return now_ns + kFrame;
}

namespace {

using runtime::kMillisecond;
using runtime::TimeMode;

/// Moves the device; without a haptic loop it also tells geometry where the tool is.
class Leader final : public runtime::Activity {
 public:
  Leader(const StrokeSettings& stroke, runtime::Bus& bus, runtime::ChannelDevice& device,
         bool publishes_geometry)
      : led_(stroke, device), bus_(bus), publishes_geometry_(publishes_geometry) {
    arm(bus);
  }
  const char* name() const override { return "device"; }
  std::int64_t step(std::int64_t now_ns) override {
    runtime::ToolState tool;
    tool.t_ns = now_ns;
    tool.X_DT.p = led_.lead(now_ns).p_DE;
    if (publishes_geometry_) bus_.haptic_to_geometry.publish(tool, now_ns);
    return now_ns + kMillisecond;
  }

 private:
  LedDevice led_;
  runtime::Bus& bus_;
  bool publishes_geometry_;
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

struct LoopRig {
  LoopRig(const LoopSurroundings& around, std::int64_t length_ns, bool publishes_geometry)
      : bus(TimeMode::real),
        device({}, TimeMode::real),
        hand(around.stroke, bus, device, publishes_geometry),
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
  const auto rig = std::make_unique<LoopRig>(around, length_ns, false);
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
  const auto rig = std::make_unique<LoopRig>(around, length_ns, true);
  LoopTimes times;
  std::jthread bare([&] { times = runBareLoop(around.period_ns, length_ns, around.cpu); });
  rig->executive->run();
  bare.join();
  return times;
}

}  // namespace palpa::bench

#include "apps/bench/stop_rig.h"

#include <atomic>
#include <functional>
#include <memory>
#include <optional>
#include <string>

#include "anatomy/base/error.h"
#include "apps/bench/stroke.h"
#include "apps/live/stop_port.h"
#include "apps/live/wire.h"
#include "apps/os/file_access.h"
#include "apps/os/local_socket.h"
#include "apps/os/signals.h"
#include "apps/runtime/executive.h"
#include "apps/runtime/geometry_activity.h"
#include "apps/runtime/haptic_activity.h"

namespace palpa::bench {
namespace {

using runtime::kMillisecond;
constexpr std::int64_t kStopPatience = 5 * runtime::kSecond;
constexpr std::int64_t kSignalLook = 5 * kMillisecond;  // as a session looks for one

/// A probe that is held in the skin. When its first command of zero force comes after the stop, it
/// notes the time.
class StoppedDevice final : public haptics::HapticDevice {
 public:
  StoppedDevice(const runtime::StopSwitch& stop, const runtime::Clock& clock)
      : stop_(stop), clock_(clock) {}
  const haptics::DeviceCapabilities& capabilities() const override {
    return channel_.capabilities();
  }
  haptics::DeviceReading read(std::int64_t now_ns) noexcept override { return led_.lead(now_ns); }
  void command(std::int64_t, const Packed3& f_D) noexcept override {
    const bool pushes = f_D != Packed3{0, 0, 0};
    pushes_.store(pushes);
    if (!pushes && stop_.noForce() && stopped_ns_.load() < 0) stopped_ns_.store(clock_.now());
  }
  bool pushes() const { return pushes_.load(); }
  void forget() { stopped_ns_.store(-1); }
  std::int64_t stoppedAt() const { return stopped_ns_.load(); }  ///< negative: not yet

 private:
  const runtime::StopSwitch& stop_;
  const runtime::Clock& clock_;
  runtime::ChannelDevice channel_{{}, runtime::TimeMode::real};
  LedDevice led_{{.stroke_Hz = 0}, channel_};
  std::atomic<bool> pushes_{false};
  std::atomic<std::int64_t> stopped_ns_{0};
};

/// A part of a session whose thread can be made to hang in a call.
class StopBenchPart final : public runtime::Activity {
 public:
  using Work = std::function<void(std::int64_t now_ns)>;
  StopBenchPart(const char* name, std::int64_t period_ns, Work work)
      : name_(name), period_ns_(period_ns), work_(std::move(work)) {}
  const char* name() const override { return name_; }
  std::int64_t step(std::int64_t now_ns) override {
    if (work_) work_(now_ns);
    if (hang_.load()) {
      hangs_.store(true);
      hang_.wait(true);
      hangs_.store(false);
    }
    return now_ns + period_ns_;
  }
  void hang(bool on) {
    hang_.store(on);
    hang_.notify_all();
  }
  bool hangs() const { return hangs_.load(); }

 private:
  const char* name_;
  const std::int64_t period_ns_;
  const Work work_;
  std::atomic<bool> hang_{false}, hangs_{false};
};

/// The session, and who presses its stop.
class StopRig {
 public:
  StopRig(const anatomy::LocalGeometryBuilder& builder, StopSource source)
      : source_(source), geometry_(bus_, builder, Pose::Identity()) {
    executive_->add(haptic_, {1, true, false});
    executive_->add(geometry_, {2, false, false});
    for (StopBenchPart* part : {&scene_, &task_, &recorder_, &camera_, &watch_, &presser_})
      executive_->add(*part, {3, false, part == &presser_});
    if (source == StopSource::console) openConsole();
    if (source == StopSource::signal) note_.emplace();
  }
  ~StopRig() {
    if (console_ >= 0) os::closeSocket(console_);
  }
  StopRig(const StopRig&) = delete;
  StopRig& operator=(const StopRig&) = delete;

  std::vector<double> run(HungPart hung, int presses) {
    hung_ = partOf(hung);
    presses_ = presses;
    executive_->run();
    return times_ms_;
  }

 private:
  StopBenchPart* partOf(HungPart part) {
    switch (part) {
      case HungPart::none:
        break;
      case HungPart::scene:
        return &scene_;
      case HungPart::task:
        return &task_;
      case HungPart::recorder:
        return &recorder_;
      case HungPart::camera:
        return &camera_;
    }
    return nullptr;
  }

  void openConsole() {
    const std::string path = live::stopSocketOf((folder_.path() / "s").string());
    port_ = std::make_unique<live::StopPort>(path, [this] { bus_.stop.press(); });
    console_ = os::connectTo(path);
    if (console_ < 0) throw Error("cannot be connected to", path, "Give more file descriptors");
  }

  void tellLoop(std::int64_t now_ns) {
    haptics::TickCommands commands;
    commands.armed = armed_.load();
    bus_.task_to_haptic.publish(commands, now_ns);
  }

  /// Noted: pressed, and ready for the next one.
  void lookForSignal() {
    if (!note_ || !note_->noted()) return;
    note_.reset();
    note_.emplace();
    bus_.stop.press();
  }

  void press() {
    if (source_ == StopSource::key) return bus_.stop.press();
    if (source_ == StopSource::signal) return os::signalThisProcess();
    char confirmed[64];
    os::receiveSome(console_, confirmed, sizeof confirmed);
    const std::string words = live::encoded(live::FrameKind::stop, "");
    os::sendSome(console_, words.data(), words.size());
  }

  void pressAll() {
    try {
      for (int i = 0; i < presses_; ++i) times_ms_.push_back(onePress(i));
    } catch (...) {
      release();
      throw;
    }
    executive_->stop();
  }

  double onePress(int number) {
    armAgain();
    if (hung_) {
      hung_->hang(true);
      until([this] { return hung_->hangs(); }, "did not hang");
    }
    rest(kMillisecond * (number % 7) / 7);  // at any phase of the tick
    device_.forget();
    const std::int64_t pressed_ns = clock().now();
    press();
    until([this] { return device_.stoppedAt() >= 0; }, "did not obey the stop");
    release();
    return 1e-6 * static_cast<double>(device_.stoppedAt() - pressed_ns);
  }

  void release() {
    if (hung_) hung_->hang(false);
  }

  /// As somebody does who re-arms, and then goes on.
  void armAgain() {
    until(
        [this] {
          bus_.stop.rearm(bus_.stop.presses());
          armed_.store(false);
          rest(3 * kMillisecond);
          armed_.store(true);
          rest(3 * kMillisecond);
          return device_.pushes();
        },
        "renders no force");
  }

  const runtime::Clock& clock() const { return executive_->clock(); }
  static void rest(std::int64_t time_ns) { runtime::rest(std::chrono::nanoseconds(time_ns)); }
  void until(const std::function<bool()>& there, const char* else_what) const {
    const std::int64_t end = clock().now() + kStopPatience;
    while (!there()) {
      if (clock().now() > end) throw Error(else_what, "the measured session", "Try it once more");
      rest(kMillisecond / 10);
    }
  }

  const StopSource source_;
  const std::unique_ptr<runtime::Executive> executive_ = runtime::makeRealExecutive();
  runtime::Bus bus_{runtime::TimeMode::real};
  StoppedDevice device_{bus_.stop, executive_->clock()};
  runtime::HapticActivity haptic_{bus_, device_, strokeConfig({})};
  runtime::GeometryActivity geometry_;
  StopBenchPart scene_{"scene", kMillisecond, {}};
  StopBenchPart task_{"task", kMillisecond, [this](std::int64_t now_ns) { tellLoop(now_ns); }};
  StopBenchPart recorder_{"recorder", kMillisecond, [this](std::int64_t) { drain(bus_, nullptr); }};
  StopBenchPart camera_{"camera", kMillisecond, {}};
  StopBenchPart watch_{"watch", kSignalLook, [this](std::int64_t) { lookForSignal(); }};
  StopBenchPart presser_{"presser", kMillisecond, [this](std::int64_t) { pressAll(); }};
  std::atomic<bool> armed_{false};
  const os::TemporaryFolder folder_{"palpa-bench-stop"};
  std::unique_ptr<live::StopPort> port_;
  int console_ = -1;
  std::optional<os::InterruptNote> note_;  ///< after the first, of the watch's thread
  StopBenchPart* hung_ = nullptr;
  int presses_ = 0;
  std::vector<double> times_ms_;
};

}  // namespace

const char* nameOf(StopSource source) {
  switch (source) {
    case StopSource::key:
      return "key";
    case StopSource::signal:
      return "signal";
    case StopSource::console:
      break;
  }
  return "console";
}

const char* nameOf(HungPart part) {
  switch (part) {
    case HungPart::none:
      return "none";
    case HungPart::scene:
      return "scene";
    case HungPart::task:
      return "task";
    case HungPart::recorder:
      return "recorder";
    case HungPart::camera:
      break;
  }
  return "camera";
}

std::vector<double> timeStops(const anatomy::LocalGeometryBuilder& builder, StopSource source,
                              HungPart hung, int presses) {
  return std::make_unique<StopRig>(builder, source)->run(hung, presses);
}

}  // namespace palpa::bench

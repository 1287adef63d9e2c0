#include "haptics/devices/template/template_driver.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstdio>

#include "anatomy/base/error.h"
#include "haptics/safety/safety_limiter.h"

namespace palpa::haptics {
namespace {

constexpr std::int64_t kMillisecond = 1'000'000, kTryAgain = 500 * kMillisecond;
constexpr int kAnswer_ms = 5, kMostMissed = 20;

/// Four whole numbers and nothing else.
bool readNumbers(std::string_view line, int (&numbers)[4]) {
  const char *at = line.data(), *const end = at + line.size();
  for (int& number : numbers) {
    while (at != end && *at == ' ') ++at;
    const auto [next, error] = std::from_chars(at, end, number);
    if (error != std::errc{}) return false;
    at = next;
  }
  return at == end;
}

long inMillinewtons(double newtons) { return std::lround(1e3 * newtons); }

TemplateProblem problemOf(SerialStatus status) {
  switch (status) {
    case SerialStatus::gone:
      return TemplateProblem::absent;
    case SerialStatus::denied:
      return TemplateProblem::denied;
    case SerialStatus::timeout:
      return TemplateProblem::silent;
    default:
      return TemplateProblem::line;
  }
}

}  // namespace

DeviceCapabilities templateCapabilities() {
  DeviceCapabilities can;
  can.name = "Template";
  can.max_force_N = 2;
  can.stable_stiffness = 600;
  can.position_resolution = 1e-6;
  can.delay = 1e-3;
  can.has_orientation = false;
  can.workspace_half_size = {0.05, 0.05, 0.05};
  can.watchdog = Watchdog::unknown;
  return can;
}

void TemplateDriver::open() noexcept {
  status_.state = DriverState::opening;
  due_ns_ = 0;
  publish();
}

std::int64_t TemplateDriver::step(std::int64_t now_ns) noexcept {
  if (status_.state == DriverState::closed) return kNever;
  if (now_ns < due_ns_) return due_ns_;
  due_ns_ = now_ns + kMillisecond;
  if (status_.state == DriverState::opening || status_.state == DriverState::lost)
    connect(now_ns);
  else
    exchange(now_ns);
  publish();
  return due_ns_;
}

void TemplateDriver::connect(std::int64_t now_ns) noexcept {
  const SerialStatus opened = line_.open();
  status_.problem = static_cast<std::uint8_t>(opened == SerialStatus::ok ? TemplateProblem::none
                                                                         : problemOf(opened));
  if (opened != SerialStatus::ok) {
    due_ns_ = now_ns + kTryAgain;
    return;
  }
  ++status_.opened;
  status_.state = DriverState::homing;
  missed_in_a_row_ = 0;
  answered_ = false;
}

/// Zero unless everything is right: the place is known, the last exchange was answered, the loop's
/// command is fresh and finite.
Packed3 TemplateDriver::forceNow(std::int64_t now_ns) noexcept {
  const ForceCommand& command = commands_.read();
  const bool fresh = now_ns - command.t_ns <= SafetyLimits{}.watchdog_ns;
  const bool finite = std::ranges::all_of(command.f_D, [](double f) { return std::isfinite(f); });
  const bool right = status_.state == DriverState::ready && answered_ && fresh && finite;
  return right ? command.f_D : Packed3{0, 0, 0};
}

void TemplateDriver::exchange(std::int64_t now_ns) noexcept {
  const Packed3 f_D = forceNow(now_ns);
  char text[96];
  const int length = std::snprintf(text, sizeof text, "%ld %ld %ld", inMillinewtons(f_D[0]),
                                   inMillinewtons(f_D[1]), inMillinewtons(f_D[2]));
  SerialStatus status = line_.send({text, static_cast<std::size_t>(length)});
  std::string_view answer;
  if (status == SerialStatus::ok) status = line_.receive(answer, kAnswer_ms);
  answered_ = status == SerialStatus::ok && take(answer, now_ns);
  if (!answered_) return miss(now_ns, status);
  ++status_.exchanges;
  missed_in_a_row_ = 0;
  status_.problem = 0;
  status_.state = reading_.homed ? DriverState::ready : DriverState::homing;
}

/// The count of readings grows only with one that is understood: the loop sees the others as a
/// silent device.
bool TemplateDriver::take(std::string_view answer, std::int64_t now_ns) noexcept {
  int numbers[4]{};
  if (!readNumbers(answer, numbers)) return false;
  for (std::size_t i = 0; i < 3; ++i) reading_.p_DE[i] = 1e-6 * numbers[i];
  reading_.homed = numbers[3] == 1;
  reading_.t_ns = now_ns;
  ++reading_.sequence;
  return true;
}

void TemplateDriver::miss(std::int64_t now_ns, SerialStatus status) noexcept {
  ++status_.missed;
  const bool gone = status == SerialStatus::gone;
  if (!gone && ++missed_in_a_row_ < kMostMissed) return;
  line_.close();
  status_.problem =
      static_cast<std::uint8_t>(gone ? TemplateProblem::absent : TemplateProblem::silent);
  status_.state = DriverState::lost;
  due_ns_ = now_ns + kTryAgain;
}

void TemplateDriver::close() noexcept {
  if (status_.state == DriverState::homing || status_.state == DriverState::ready)
    line_.send("0 0 0");
  line_.close();
  status_.state = DriverState::closed;
  reading_.homed = 0;
  publish();
}

std::string TemplateDriver::words(const DriverStatus& status) const {
  switch (static_cast<TemplateProblem>(status.problem)) {
    case TemplateProblem::none:
      return status.state == DriverState::homing ? "Touch all six sides of its stand" : "";
    case TemplateProblem::absent:
      return Error("is not there", capabilities_.name, "Plug in its cable and its power supply")
          .what();
    case TemplateProblem::denied:
      return Error("may not be used by this user", capabilities_.name,
                   "Add this user to the group dialout, and log in again")
          .what();
    case TemplateProblem::silent:
      return Error("stopped answering", capabilities_.name,
                   "It is opened again. If that lasts: unplug its power supply and plug it in "
                   "again")
          .what();
    case TemplateProblem::line:
      break;
  }
  return Error("does not work on this port", capabilities_.name, "Use another cable").what();
}

void TemplateDriver::publish() noexcept {
  if (status_.state != DriverState::ready) reading_.homed = 0;
  readings_.write(reading_);
  statuses_.write(status_);
}

}  // namespace palpa::haptics

namespace palpa::haptics::templates {

const DriverDescription& description();

namespace {

constexpr char kPort[] = "port", kUsualPort[] = "/dev/ttyUSB0";

std::unique_ptr<Driver> make(const DriverSettings& settings) {
  const std::string port = settings.text(kPort);
  return std::make_unique<TemplateDriver>(port.empty() ? kUsualPort : port);
}

}  // namespace

const DriverDescription& description() {
  static const DriverDescription it{
      .name = "template",
      .title = "Template",
      .fields = {{.name = kPort,
                  .kind = DriverField::Kind::text,
                  .title = "Port",
                  .about = "Serial port (default /dev/ttyUSB0)"}},
      .usb = {},
      .udev_rule = "",
      .capabilities = [](const DriverSettings&) { return templateCapabilities(); },
      .make = make};
  return it;
}

}  // namespace palpa::haptics::templates

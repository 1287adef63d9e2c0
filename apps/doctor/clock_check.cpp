#include "apps/doctor/clock_check.h"

#include <sys/timex.h>

#include <cmath>

#include "apps/doctor/words.h"

namespace palpa::doctor {
namespace {

constexpr const char* kClocks = "clocks";
constexpr std::int64_t kCoarse_ns = 100'000;  // a tenth of a tick of the haptic loop
constexpr double kMoved_ms =
    5;  // a time server that corrects gently moves the date by less than 0.5 ms a second

bool isSynchronised() {
  timex asked{};  // no mode: nothing is set
  return adjtimex(&asked) != TIME_ERROR;
}

}  // namespace

ClockWatch::ClockWatch() : ahead_(ahead()) {}

/// Both are read until nobody came between.
std::int64_t ClockWatch::ahead() const {
  std::int64_t closest = runtime::kSecond, difference = 0;
  for (int tries = 0; tries < 50 && closest > runtime::kMillisecond / 10; ++tries) {
    const std::int64_t before = clock_.now(), date = runtime::dateNow(),
                       between = clock_.now() - before;
    if (between >= closest) continue;
    closest = between;
    difference = date - before;
  }
  return difference;
}

ClockFacts ClockWatch::facts() const {
  ClockFacts facts;
  facts.resolution_ns = runtime::clockResolution();
  facts.seconds = 1e-9 * static_cast<double>(clock_.now());
  facts.date_moved_ms = 1e-6 * static_cast<double>(ahead() - ahead_);
  facts.synchronised = isSynchronised();
  return facts;
}

Finding judgeClocks(const ClockFacts& f, const PictureFacts& pictures, bool shared) {
  const auto note = [](std::string verdict, std::string fix) {
    return Finding{kClocks, State::note, std::move(verdict), std::move(fix)};
  };
  if (f.resolution_ns > kCoarse_ns)
    return note(
        text("the computer's clock steps by %.1f ms: the haptic loop cannot keep a millisecond",
             1e-6 * static_cast<double>(f.resolution_ns)),
        "Use a kernel with high-resolution timers; in a virtual machine give it the host's clock");
  if (pictures.backward > 0)
    return note(text("the camera's times go back in %d of %d pictures", pictures.backward,
                     pictures.pictures),
                "Unplug the camera and plug it in again; if it stays so, use another camera");
  if (pictures.undated > 0)
    return note(
        text("the camera dates %d of %d pictures by another clock: their time of arrival is taken",
             pictures.undated, pictures.pictures),
        "Calibrate the time between camera and device with this camera (palpa calibrate latency), "
        "or use one whose driver gives times");
  if (std::abs(f.date_moved_ms) > kMoved_ms)
    return note(text("the computer's date was set by %.0f ms while it was watched for %.1f s",
                     f.date_moved_ms, f.seconds),
                "Let one program keep the date (timedatectl set-ntp true); in a virtual machine "
                "turn the host's off");
  if (shared && !f.synchronised)
    return note(
        "no time server keeps this computer's date; stations that share records should agree on it",
        "timedatectl set-ntp true");
  return {kClocks, State::well,
          text("steps of %.0f ns; the date goes with them", static_cast<double>(f.resolution_ns)) +
              (f.synchronised ? ", kept by a time server" : "")};
}

}  // namespace palpa::doctor

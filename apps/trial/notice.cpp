#include <algorithm>
#include <cctype>
#include <cmath>
#include <cstdio>

#include "apps/trial/trial_scene.h"

namespace palpa::trial {
namespace {

std::string hint(haptics::SafetyCause cause) {
  if (cause == haptics::SafetyCause::deadman) return "Force is off: hold the button of the device";
  if (cause == haptics::SafetyCause::duty) return "The device is warm: forces are reduced";
  return "";
}

}  // namespace

std::string overlayText(const Mat3& covariance) {
  constexpr double kOf95 =
      1.6;  // 95 % of a normal error in three dimensions lie within 1.6 times its root mean square
  char text[32];
  std::snprintf(text, sizeof text, "within %.1f mm",
                std::max(kOf95 * 1e3 * std::sqrt(covariance.trace()), 0.1));
  return text;
}

std::string forceText(haptics::SafetyCause cause) {
  using haptics::SafetyCause;
  switch (cause) {
    case SafetyCause::energy:
      return "Force is off: the device gave too much energy. R re-arms";
    case SafetyCause::silent_device:
      return "Force is off: the device is silent. Look at its cable";
    case SafetyCause::stale_geometry:
    case SafetyCause::watchdog:
      return "Force is off: the computer cannot keep up";
    case SafetyCause::corrupt_geometry:
      return "Force is off: damaged geometry was refused";
    case SafetyCause::no_sensor:
      return "Force is off: the force sensor is silent, overloaded or broken. Look at its cable";
    case SafetyCause::not_finite:
    case SafetyCause::jump:
    case SafetyCause::clock:
      return std::string("Force is off: the device's readings cannot be believed (") +
             haptics::name(cause) + ")";
    default:
      return "";
  }
}

std::string whyText(haptics::SafetyCause cause) {
  using haptics::SafetyCause;
  switch (cause) {
    case SafetyCause::energy:
      return "the device gave too much energy";
    case SafetyCause::silent_device:
      return "the device was silent";
    case SafetyCause::stale_geometry:
    case SafetyCause::watchdog:
      return "the computer could not keep up";
    case SafetyCause::corrupt_geometry:
      return "damaged geometry was refused";
    case SafetyCause::no_sensor:
      return "the force sensor said nothing that could be believed";
    case SafetyCause::not_finite:
    case SafetyCause::jump:
    case SafetyCause::clock:
      return "the device's readings could not be believed";
    default:
      return haptics::name(cause);
  }
}

void noticeOf(const TrialStatus& status, haptics::SafetyCause safety, const std::string& own,
              const std::string& camera, scene::Hud* hud) {
  hud->notice = status.notice;
  hud->alarm = status.alarm;
  const auto say = [hud](const std::string& words, bool alarm) {
    if (!hud->notice.empty() || words.empty()) return;
    hud->notice = words;
    hud->alarm = hud->alarm || alarm;
  };
  if (status.active()) {
    if (!status.device.empty()) say("Force is off: " + status.device, true);
    say(forceText(safety), true);
    if (!forceText(status.trip).empty())
      say("Force was off for a moment: " + whyText(status.trip), true);
    say(hint(safety), false);
  }
  say(own, hud->alarm);
  if (!camera.empty())
    say(static_cast<char>(std::toupper(static_cast<unsigned char>(camera.front()))) +
            camera.substr(1),
        false);
}

}  // namespace palpa::trial

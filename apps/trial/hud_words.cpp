#include "apps/trial/hud_words.h"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <cstdio>

namespace palpa::trial {
namespace {

std::string hint(haptics::SafetyCause cause) {
  if (cause == haptics::SafetyCause::deadman) return "Force is off: hold the button of the device";
  if (cause == haptics::SafetyCause::duty) return "The device is warm: forces are reduced";
  return "";
}

/// What is said while it lasts, with what to do, and afterwards; empty: nothing is said.
struct CauseWords {
  std::string now, advice, past;
};

CauseWords wordsOf(haptics::SafetyCause cause) {
  using haptics::SafetyCause;
  switch (cause) {
    case SafetyCause::energy:
      return {"the device gave too much energy", "[R] re-arms", "the device gave too much energy"};
    case SafetyCause::silent_device:
      return {"the device is silent", "Look at its cable, close other programs",
              "the device was silent"};
    case SafetyCause::stale_geometry:
    case SafetyCause::watchdog:
      return {"the computer cannot keep up", "", "the computer could not keep up"};
    case SafetyCause::corrupt_geometry:
      return {"damaged geometry was refused", "", "damaged geometry was refused"};
    case SafetyCause::no_sensor:
      return {"the force sensor is silent, overloaded or broken", "Look at its cable",
              "the force sensor gave no usable reading"};
    case SafetyCause::not_finite:
    case SafetyCause::jump:
    case SafetyCause::clock:
      return {
          std::string("the device's readings cannot be believed (") + haptics::name(cause) + ")",
          "", "the device gave no usable reading"};
    default:
      return {};
  }
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

haptics::SafetyCause worse(haptics::SafetyCause first, haptics::SafetyCause second) {
  if (forceText(first).empty() && !forceText(second).empty()) return second;
  return first != haptics::SafetyCause::none ? first : second;
}

std::string forceText(haptics::SafetyCause cause) {
  const CauseWords words = wordsOf(cause);
  if (words.now.empty()) return "";
  return "Force is off: " + words.now + (words.advice.empty() ? "" : ". " + words.advice);
}

std::string whyText(haptics::SafetyCause cause) {
  const CauseWords words = wordsOf(cause);
  return words.now.empty() ? haptics::name(cause) : words.past;
}

std::string numberOf(const TrialStatus& status, const char* called) {
  std::string words;
  if (status.trials > 1 && status.trial > 0) {
    words = called;
    words += ' ' + std::to_string(status.trial) + " of " + std::to_string(status.trials) + "  ";
  }
  return words;
}

void tellTrial(const TrialStatus& status, const std::string& task, const std::string& force,
               scene::Hud* hud) {
  hud->phase = numberOf(status, "Trial");
  if (!status.active()) return;
  hud->phase += task;
  hud->force = force + (status.force_feedback ? "" : " (force feedback off)");
  const int seconds = static_cast<int>(status.elapsed_s);
  hud->time = std::to_string(seconds / 60) + (seconds % 60 < 10 ? ":0" : ":") +
              std::to_string(seconds % 60);
}

void noticeOf(const TrialStatus& status, haptics::SafetyCause safety, const std::string& own,
              const std::string& camera, scene::Hud* hud) {
  hud->notice = status.notice;
  hud->can_do = status.can_do;
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
  // How the last trial ended stays, and so does what is to be done then.
  if (status.state == TrialState::ended && !hud->notice.empty() && !status.can_do.empty())
    hud->notice += (hud->notice.ends_with('.') ? " " : ". ") + status.can_do;
}

}  // namespace palpa::trial

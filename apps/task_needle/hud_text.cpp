#include "apps/task_needle/hud_text.h"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <cstdio>

namespace palpa::task_needle {
namespace {

template <class... Numbers>
std::string format(const char* pattern, Numbers... numbers) {
  char text[96];
  std::snprintf(text, sizeof text, pattern, numbers...);
  return text;
}

std::string depthText(const runtime::ToolState& tool) {
  switch (tool.phase) {
    case haptics::NeedlePhase::outside: return "outside the skin";
    case haptics::NeedlePhase::indenting: return "on the skin";
    case haptics::NeedlePhase::inserted: break;
  }
  return format("%.0f mm under the skin, in ", tool.depth * 1e3) +
         (tool.tissue == Tissue::vein_lumen ? "the vein" : name(tool.tissue));
}

std::string touchedText(const runtime::ToolState& tool) {
  if (tool.tissue == Tissue::lung || tool.wall == Organ::lung) return "LUNG";
  if (tool.tissue == Tissue::artery_lumen || tool.wall == Organ::artery) return "ARTERY";
  if (tool.bone == Organ::clavicle) return "clavicle";
  if (tool.bone != Organ::none) return name(tool.bone);
  if (tool.wall == Organ::vein || tool.tissue == Tissue::vein_lumen) return "subclavian vein";
  return "";
}

/// What a trip means for whoever holds the tool; empty: nothing to say.
std::string forceText(haptics::SafetyCause cause) {
  using haptics::SafetyCause;
  switch (cause) {
    case SafetyCause::energy: return "Force is off: the device gave too much energy. R re-arms";
    case SafetyCause::silent_device: return "Force is off: the device is silent. Look at its cable";
    case SafetyCause::stale_geometry:
    case SafetyCause::watchdog: return "Force is off: the computer cannot keep up";
    case SafetyCause::corrupt_geometry: return "Force is off: damaged geometry was refused";
    case SafetyCause::no_sensor: return "Force is off: the force sensor is silent, overloaded or broken. Look at its cable";
    case SafetyCause::not_finite:
    case SafetyCause::jump:
    case SafetyCause::clock: return std::string("Force is off: the device's readings cannot be believed (") + haptics::name(cause) + ")";
    default: return "";
  }
}

std::string hint(haptics::SafetyCause cause) {
  if (cause == haptics::SafetyCause::deadman) return "Force is off: hold the button of the device";
  if (cause == haptics::SafetyCause::duty) return "The device is warm: forces are reduced";
  return "";
}

}  // namespace

bool injury(const runtime::ToolState& tool) {
  return tool.tissue == Tissue::lung || tool.wall == Organ::lung ||
         tool.tissue == Tissue::artery_lumen || tool.wall == Organ::artery;
}

std::string overlayText(const Mat3& covariance) {
  constexpr double kOf95 = 1.6;   // 95 % of a normal error in three dimensions lie within 1.6 times its root mean square
  return format("within %.1f mm", std::max(kOf95 * 1e3 * std::sqrt(covariance.trace()), 0.1));
}

scene::Hud hudText(const TaskStatus& status, const runtime::ToolState& tool, const std::string& camera,
                   const std::string& mark) {
  scene::Hud hud;
  const bool active = status.state == TrialState::running || status.state == TrialState::paused;
  hud.phase = active ? clinicalName(status.phase) : "";
  if (status.trials > 1 && status.trial > 0)
    hud.phase = format("Trial %d of %d  ", status.trial, status.trials) + hud.phase;
  if (active) {
    hud.depth = depthText(tool);
    hud.force = format("%.1f N", unpack(tool.f_contact_D).norm()) +
                (status.force_feedback ? "" : " (force feedback off)");
    const int seconds = static_cast<int>(status.elapsed_s);
    hud.time = format("%d:%02d", seconds / 60, seconds % 60);
    hud.touched = touchedText(tool);
  }
  hud.notice = status.notice;
  hud.alarm = status.alarm;
  if (hud.notice.empty() && active && !status.device.empty()) {
    hud.notice = "Force is off: " + status.device;
    hud.alarm = true;
  }
  if (hud.notice.empty() && active) {
    hud.notice = forceText(tool.safety);
    if (hud.notice.empty() && !forceText(status.trip).empty())
      hud.notice = std::string("Force was off for a moment: ") + haptics::name(status.trip);
    hud.alarm = hud.alarm || !hud.notice.empty();
  }
  if (hud.notice.empty() && active) hud.notice = hint(tool.safety);
  if (hud.notice.empty() && active && injury(tool)) {
    hud.notice = "The needle touches the " + std::string(tool.tissue == Tissue::lung || tool.wall == Organ::lung ? "lung" : "artery");
    hud.alarm = true;
  }
  if (hud.notice.empty() && status.blood_flows) hud.notice = "Blood flows into the syringe";
  if (hud.notice.empty() && !camera.empty()) {
    hud.notice = camera;
    hud.notice.front() = static_cast<char>(std::toupper(static_cast<unsigned char>(hud.notice.front())));
  }
  hud.mark = mark;
  return hud;
}

}  // namespace palpa::task_needle

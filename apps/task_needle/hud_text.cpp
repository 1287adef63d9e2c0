#include "apps/task_needle/hud_text.h"

#include <cstdio>

#include "apps/assess/trial_role.h"
#include "apps/trial/trial_scene.h"

namespace palpa::task_needle {
namespace {

template <class... Numbers>
std::string format(const char* pattern, Numbers... numbers) {
  char text[96];
  std::snprintf(text, sizeof text, pattern, numbers...);
  return text;
}

std::string depthText(const runtime::ToolState& tool, const TaskWords& words) {
  const std::string surface = "the " + words.of(Organ::skin);
  switch (tool.phase) {
    case haptics::NeedlePhase::outside:
      return "outside " + surface;
    case haptics::NeedlePhase::indenting:
      return "on " + surface;
    case haptics::NeedlePhase::inserted:
      break;
  }
  return format("%.0f mm under ", tool.depth * 1e3) + surface + ", in " +
         (tool.tissue == Tissue::vein_lumen ? "the vein" : words.of(tool.tissue));
}

std::string touchedText(const runtime::ToolState& tool) {
  if (tool.tissue == Tissue::lung || tool.wall == Organ::lung) return "LUNG";
  if (tool.tissue == Tissue::artery_lumen || tool.wall == Organ::artery) return "ARTERY";
  if (tool.bone == Organ::clavicle) return "clavicle";
  if (tool.bone != Organ::none) return name(tool.bone);
  if (tool.wall == Organ::vein || tool.tissue == Tissue::vein_lumen) return "subclavian vein";
  return "";
}

}  // namespace

bool injury(const runtime::ToolState& tool) {
  return tool.tissue == Tissue::lung || tool.wall == Organ::lung ||
         tool.tissue == Tissue::artery_lumen || tool.wall == Organ::artery;
}

scene::Hud hudText(const TaskStatus& status, const runtime::ToolState& tool,
                   const std::string& camera, const std::string& mark, const TaskWords& words) {
  scene::Hud hud;
  const bool active = status.active(),
             told = !assess::inAssessment(status.role);  // what a patient would not tell is an aid
  hud.phase = active && told ? status.step : "";
  if (status.trials > 1 && status.trial > 0)
    hud.phase = format("Trial %d of %d  ", status.trial, status.trials) + hud.phase;
  if (active) {
    if (told) hud.depth = depthText(tool, words);
    if (told)
      hud.force = format("%.1f N", unpack(tool.f_contact_D).norm()) +
                  (status.force_feedback ? "" : " (force feedback off)");
    const int seconds = static_cast<int>(status.elapsed_s);
    hud.time = format("%d:%02d", seconds / 60, seconds % 60);
    if (told) hud.touched = touchedText(tool);
  }
  const bool hurts = active && told && injury(tool);
  std::string own;
  if (hurts)
    own = "The needle touches the " +
          std::string(tool.tissue == Tissue::lung || tool.wall == Organ::lung ? "lung" : "artery");
  else if (status.blood_flows)
    own = "Blood flows into the syringe";
  trial::noticeOf(status, tool.safety, own, camera, &hud);
  hud.alarm = hud.alarm || (hurts && hud.notice == own);
  hud.mark = mark;
  return hud;
}

}  // namespace palpa::task_needle

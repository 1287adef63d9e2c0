#include "apps/task_pulse/pulse_scene.h"

#include <cmath>
#include <cstdio>

namespace palpa::task_pulse {

using assess::PulseRhythm;

std::string taskText(const PulseStatus& status) {
  switch (status.part) {
    case PulsePart::find:
      return "Find the " + status.artery + " pulse, mark it with the button, then [D]";
    case PulsePart::count:
      return "Count the beats: " +
             std::to_string(static_cast<int>(std::ceil(status.count_left_s))) + " s left";
    case PulsePart::number:
      return "How many beats? " + status.typed + "_";
    case PulsePart::rhythm:
      return std::string("The rhythm? 1 ") + wordsOf(PulseRhythm::regular) + ", 2 " +
             wordsOf(PulseRhythm::premature) + ", 3 " + wordsOf(PulseRhythm::irregular);
    case PulsePart::none:
      break;
  }
  return "";
}

PulseScene::PulseScene(const PulseSceneSetup& setup, runtime::Bus& bus, PulseChannels& channels)
    : TrialScene(setup.stage, bus, channels), setup_(setup), channels_(channels) {}

const trial::TrialStatus& PulseScene::readStatus(std::int64_t now_ns) {
  if (const PulseStatus* status = channels_.status_to_scene.read(now_ns)) status_ = *status;
  return status_;
}

void PulseScene::compose(scene::SceneState& state, const runtime::ToolState& tool,
                         const std::string& trouble) {
  state.tool = scene::Tool::probe;
  state.skin = scene::SkinStyle::solid;
  state.hud = words(tool, trouble);
  state.marks_A.clear();
  if (status_.mark_P)
    state.marks_A.push_back(setup_.X_AP * Vec3(status_.mark_P->x(), status_.mark_P->y(), 0));
}

void PulseScene::addTo(runtime::Displayed& displayed, const runtime::ToolState&) {
  using Question = runtime::Displayed::Question;
  displayed.things = static_cast<int>(status_.part);
  displayed.question = status_.part == PulsePart::find     ? Question::pulse_place
                       : status_.part == PulsePart::count  ? Question::pulse_count
                       : status_.part == PulsePart::number ? Question::pulse_number
                       : status_.part == PulsePart::rhythm ? Question::pulse_rhythm
                                                           : Question::none;
}

scene::Hud PulseScene::words(const runtime::ToolState& tool, const std::string& trouble) const {
  scene::Hud hud;
  char force[32];
  std::snprintf(force, sizeof force, "%.1f N", status_.force_N);
  trial::tellTrial(status_, taskText(status_), force, &hud);
  trial::noticeOf(status_, tool.safety, "", trouble, &hud);
  hud.mark = mark();
  return hud;
}

}  // namespace palpa::task_pulse

#include "apps/runtime/recorder_activity.h"

namespace palpa::runtime {

std::int64_t RecorderActivity::step(std::int64_t now_ns) {
  drain();
  return now_ns + period_ns_;
}

void RecorderActivity::drain() {
  EvidenceMessage message;
  while (bus_.task_to_recorder.pop(&message)) {
    if (const auto* event = std::get_if<Event>(&message)) sink_.event(*event);
    if (const auto* header = std::get_if<TrialHeader>(&message)) sink_.beginTrial(*header);
    if (const auto* end = std::get_if<TrialEnd>(&message)) sink_.endTrial(*end);
    bus_.recorder_to_link.push(message);
  }
  LocalGeometry geometry;
  while (bus_.geometry_to_recorder.pop(&geometry)) sink_.snapshot(geometry);
  Keyframe keyframe;
  while (bus_.keyframes_to_recorder.pop(&keyframe)) sink_.keyframe(keyframe.tick, keyframe.state);
  haptics::FlightRecord record;
  while (bus_.haptic_to_recorder.pop(&record)) sink_.tick(record);
  sink_.commit();
}

}  // namespace palpa::runtime

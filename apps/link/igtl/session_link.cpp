#include "apps/link/igtl/session_link.h"

#include <nlohmann/json.hpp>

#include "apps/link/igtl/conventions.h"

namespace palpa::igt {
namespace {

using nlohmann::json;
constexpr std::int64_t kCameraFresh_ns =
    500'000'000;  // an older pose of the camera is not told any more
constexpr const char* kEvents = "PalpaEvent";
constexpr const char* kPhase = "PalpaPhase";

const char* wordOf(haptics::NeedlePhase phase) {
  switch (phase) {
    case haptics::NeedlePhase::indenting:
      return "indenting";
    case haptics::NeedlePhase::inserted:
      return "inserted";
    default:
      return "outside";
  }
}

std::string text(const json& value) {
  return value.dump(-1, ' ', false, json::error_handler_t::replace);
}

}  // namespace

IgtlLink::IgtlLink(const IgtlLinkSetup& setup, runtime::Bus& bus)
    : setup_(setup), bus_(bus), server_(setup.ipv4, setup.port, setup.X_WA) {
  server_.showAlways(setup_.tool + "Tip", setup_.tool, setup_.X_ET);
  if (setup_.second_X_WD) server_.showAlways(setup_.tool + "2Tip", setup_.tool + "2", setup_.X_ET);
  if (setup_.X_WP) server_.showAlways("Phantom", kReference, *setup_.X_WP);
}

std::int64_t IgtlLink::step(std::int64_t now_ns) {
  const ShownMoment moment = momentAt(now_ns);
  sendEvidence();
  if (const runtime::ToolState* tool = bus_.haptic_to_link.read(now_ns))
    sendPhase(*tool, moment.utc_ns);
  if (now_ns >= next_show_ns_) {
    server_.show(moment);
    next_show_ns_ = now_ns + kShow_ns;
  }
  server_.serve(moment, now_ns);
  return now_ns + kStep_ns;
}

ShownMoment IgtlLink::momentAt(std::int64_t now_ns) {
  ShownMoment moment;
  const runtime::ToolState* tool = bus_.haptic_to_link.read(now_ns);
  moment.utc_ns = utc(tool ? tool->t_ns : now_ns);
  if (tool) addTool(setup_.tool, *tool, setup_.X_WD, moment);
  if (setup_.second_X_WD)
    if (const runtime::ToolState* second = bus_.second_to_link.read(now_ns))
      addTool(setup_.tool + "2", *second, *setup_.second_X_WD, moment);
  const runtime::CameraPose* camera = bus_.camera_to_link.read(now_ns);
  if (camera && camera->X_CW && now_ns - camera->t_ns < kCameraFresh_ns)
    moment.poses.push_back({"Camera", camera->X_CW->inverse(), utc(camera->t_ns)});
  return moment;
}

/// Nothing of a tool whose place is not known.
void IgtlLink::addTool(const std::string& tool, const runtime::ToolState& state, const Pose& X_WD,
                       ShownMoment& moment) const {
  const Pose X_WT = X_WD * unpack(state.X_DT);
  if (!state.homed || !X_WT.matrix().allFinite()) return;
  moment.poses.push_back({tool + "Tip", X_WT, utc(state.t_ns)});
  moment.poses.push_back({tool, X_WT * setup_.X_ET.inverse(), utc(state.t_ns)});
  const auto force = [&](const char* which, const Packed3& f_D) {
    moment.forces.push_back({tool + which, X_WD.linear() * unpack(f_D)});
  };
  force("ContactForce", state.f_contact_D);
  force("DeviceForce", state.f_command_D);
  force("SensedForce", state.f_sensed_D);
  moment.lengths_mm.emplace_back(tool + "Depth", 1e3 * state.depth);
}

/// Everything that the recorder wrote down.
void IgtlLink::sendEvidence() {
  runtime::EvidenceMessage message;
  while (bus_.recorder_to_link.pop(&message)) {
    if (const auto* event = std::get_if<runtime::Event>(&message))
      server_.say(kEvents,
                  text({{"kind", event->kind},
                        {"trial", event->trial},
                        {"text", event->text},
                        {"value", event->value}}),
                  utc(event->t_ns));
    if (const auto* begin = std::get_if<runtime::TrialHeader>(&message)) running_ = begin->trial;
    if (const auto* end = std::get_if<runtime::TrialEnd>(&message)) {
      running_ = 0;
      server_.say(
          kEvents,
          text(
              {{"kind", "trial_end"}, {"trial", end->trial}, {"text", end->outcome}, {"value", 0}}),
          utc(end->t_ns));
    }
  }
}

void IgtlLink::sendPhase(const runtime::ToolState& tool, std::int64_t utc_ns) {
  const std::string phase = text(
      {{"trial", running_}, {"phase", wordOf(tool.phase)}, {"tissue", palpa::name(tool.tissue)}});
  if (phase == phase_) return;
  phase_ = phase;
  server_.say(kPhase, phase, utc_ns, true);
}

}  // namespace palpa::igt

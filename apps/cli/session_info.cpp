#include "apps/cli/session_info.h"

#include <cmath>
#include <fstream>
#include <iterator>
#include <nlohmann/json.hpp>

#include "anatomy/patient_file.h"
#include "apps/cli/output_folder.h"

namespace palpa::cli {
namespace {

std::string bytesOf(const anatomy::Patient& patient, const std::filesystem::path& folder) {
  const std::filesystem::path file = folder / ".patient.glb";
  anatomy::writePatient(patient, file);
  std::ifstream stream(file, std::ios::binary);
  std::string bytes((std::istreambuf_iterator<char>(stream)), std::istreambuf_iterator<char>());
  std::filesystem::remove(file);
  return bytes;
}

nlohmann::json json(const Pose& X) {
  const PackedPose p = pack(X);
  return {{"p_m", p.p}, {"q_wxyz", p.q}};
}

}  // namespace

const char* nameOf(OperatorKind who) {
  switch (who) {
    case OperatorKind::person:
      return "person";
    case OperatorKind::recorded:
      return "recorded";
    case OperatorKind::novice:
      return "novice";
    case OperatorKind::learner:
      return "learner";
    default:
      return "expert";
  }
}

std::string sessionText(nlohmann::json session, const SessionOptions& options) {
  const StudyStep& s = options.study;
  if (!s.id.empty())
    session["study"] = {{"id", s.id},
                        {"slot", s.slot},
                        {"group", s.group},
                        {"condition", s.condition},
                        {"block", s.block},
                        {"step", s.step},
                        {"protocol_sha256", s.protocol_sha256}};
  return session.dump();
}

bool isSimulated(const SessionOptions& options, const NeedleWorld& world) {
  return isSimulated(options.who) || world.station.simulated;
}

haptics::TickConfig tickConfig(const SessionOptions& options, const NeedleWorld& world) {
  haptics::TickConfig config = world.tickConfig();
  config.period_ns = std::llround(1e9 / options.rate_Hz);
  if (options.exact_geometry) config.blend_ns = 0;  // every tick has its own
  const station::DeviceSetup& device = world.station.device;
  const bool has_buttons =
      !isSimulated(options.who) && device.driver != station::DeviceDriver::mouse;
  if (!has_buttons) config.safety.deadman_button = 0;  // nobody could hold it
  config.device_turns = isSimulated(options.who) || device.capabilities.has_orientation;
  return config;
}

record::SessionInfo sessionInfo(const SessionOptions& options, const NeedleWorld& world,
                                const std::filesystem::path& folder) {
  record::SessionInfo info;
  info.uuid = options.uuid;
  info.started_utc = utcNow();
  info.software = std::string("palpa ") + PALPA_VERSION;
  info.command = options.command;
  info.session_json = sessionText({{"seed", options.seed},
                                   {"bench_seed", options.benchSeed()},
                                   {"operator", nameOf(options.who)},
                                   {"knows_patient", options.knows_patient},
                                   {"simulated", isSimulated(options, world)},
                                   {"trainee", options.trainee},
                                   {"force_feedback", options.force_feedback},
                                   {"side", anatomy::name(world.patient.side)},
                                   {"augment", options.augment},
                                   {"skin_deflection", options.skin_deflection},
                                   {"handedness", options.left_handed ? "left" : "right"},
                                   {"virtual_time", options.fast},
                                   {"camera_rate_Hz", world.station.camera_rate_Hz},
                                   {"assessed", options.assess},
                                   {"X_DA", json(world.X_DA)},
                                   {"X_WA", json(world.X_WA)},
                                   {"X_WD", json(world.station.X_WD)}},
                                  options);
  info.station_json = world.station.file.json().dump();
  info.task_json = world.task.source;
  info.patient_glb = bytesOf(world.patient, folder);
  if (world.expert_path) {
    std::ifstream stream(world.task.expert_path);
    info.expert_path_json.assign(std::istreambuf_iterator<char>(stream),
                                 std::istreambuf_iterator<char>());
  }
  info.tick_config = tickConfig(options, world);
  return info;
}

}  // namespace palpa::cli

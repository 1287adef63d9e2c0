#include <cmath>

#include <nlohmann/json.hpp>

#include "anatomy/patient/patient_file.h"
#include "apps/session/needle_world.h"
#include "apps/session/output_folder.h"
#include "apps/session/session_facts.h"
#include "apps/station/assets.h"
#include "apps/twin/learning_hand.h"
#include "apps/twin/operator.h"

namespace palpa::session {
namespace {

std::unique_ptr<twin::Hand> operatorOf(const SessionOptions& options,
                                       const twin::OperatorSkill& skill,
                                       const twin::VisibleAnatomy& anatomy, const Pose& X_ET) {
  if (options.who != OperatorKind::learner)
    return std::make_unique<twin::Operator>(skill, anatomy, X_ET, options.seed);
  return std::make_unique<twin::LearningHand>([options,
                                               from = twin::readOperatorSkill(options.learner.from),
                                               to = twin::readOperatorSkill(options.learner.to),
                                               anatomy, X_ET](int trial) {
    const LearnerOptions& learner = options.learner;
    return std::make_unique<twin::Operator>(between(from, to, learner.level(trial)), anatomy, X_ET,
                                            learner.seed + static_cast<std::uint64_t>(trial - 1));
  });
}

}  // namespace

SessionDevices::Hands needleHands(const SessionOptions& options, const NeedleWorld& world) {
  const twin::OperatorSkill skill = twin::readOperatorSkill(operatorFile(options, ""));
  const twin::VisibleAnatomy anatomy = world.visible(skill, options.knows_patient);
  twin::VirtualBenchSetup bench{
      .station = world.station,
      .hand = operatorOf(options, skill, anatomy, world.station.X_ET),
      .X_DE_start =
          twin::needlePickedUp(world.station, world.X_WA, anatomy.entry_A, options.left_handed),
      .watched_W = world.X_WA * anatomy.entry_A,
      .normal_W = world.X_WA.rotation() * anatomy.normal_A,
      .seed = options.benchSeed()};
  const MouseHandSetup mouse{
      .X_DA = world.X_DA,
      .X_ET = world.station.X_ET,
      .anatomy = world.visible(twin::readOperatorSkill(operatorFile({}, "")), false),
      .left_handed = options.left_handed};
  return {std::move(bench), mouse};
}

namespace {

nlohmann::json json(const Pose& X) {
  const PackedPose p = pack(X);
  return {{"p_m", p.p}, {"q_wxyz", p.q}};
}

}  // namespace

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

record::SessionInfo sessionInfo(const SessionOptions& options, const NeedleWorld& world) {
  record::SessionInfo info = infoOf(options, headOf(options, world), world.task.source,
                                    {{"knows_patient", options.knows_patient},
                                     {"side", anatomy::name(world.patient.side)},
                                     {"augment", options.augment},
                                     {"skin_deflection", options.skin_deflection},
                                     {"handedness", options.left_handed ? "left" : "right"},
                                     {"camera_rate_Hz", world.station.camera_rate_Hz},
                                     {"X_DA", json(world.X_DA)},
                                     {"X_WA", json(world.X_WA)},
                                     {"X_WD", json(world.station.X_WD)}});
  info.station_json = world.station.file.json().dump();
  info.patient_glb = anatomy::glbOf(world.patient, "the session's patient");
  if (world.expert_path) info.expert_path_json = world.expert_path->source;
  info.tick_config = tickConfig(options, world);
  return info;
}

}  // namespace palpa::session

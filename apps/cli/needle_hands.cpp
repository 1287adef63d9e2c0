#include "apps/cli/needle_hands.h"

#include "apps/station/assets.h"
#include "apps/twin/learning_hand.h"
#include "apps/twin/operator.h"

namespace palpa::cli {
namespace {

twin::OperatorSkill skillOf(OperatorKind who) {
  return twin::readOperatorSkill(station::assetFile(
      who == OperatorKind::novice ? "operators/novice.json" : "operators/expert.json"));
}

/// A learner at a trial. The clavicle guides whoever feels it: nobody learns to lean on it where it
/// is not felt.
twin::OperatorSkill learnt(const SessionOptions& options, const twin::OperatorSkill& from,
                           const twin::OperatorSkill& to, double level) {
  twin::OperatorSkill skill = between(from, to, level);
  if (!options.force_feedback) skill.guide = from.guide;
  return skill;
}

std::unique_ptr<twin::Hand> operatorOf(const SessionOptions& options,
                                       const twin::OperatorSkill& skill,
                                       const twin::VisibleAnatomy& anatomy, const Pose& X_ET) {
  if (options.who != OperatorKind::learner)
    return std::make_unique<twin::Operator>(skill, anatomy, X_ET, options.seed);
  return std::make_unique<twin::LearningHand>(
      [options, from = twin::readOperatorSkill(options.learner.from),
       to = twin::readOperatorSkill(options.learner.to), anatomy, X_ET](int trial) {
        const LearnerOptions& learner = options.learner;
        return std::make_unique<twin::Operator>(
            learnt(options, from, to, learner.level(trial)), anatomy, X_ET,
            learner.seed + static_cast<std::uint64_t>(trial - 1));
      });
}

}  // namespace

SessionDevices::Hands needleHands(const SessionOptions& options, const NeedleWorld& world) {
  const twin::OperatorSkill skill = skillOf(options.who);
  const twin::VisibleAnatomy anatomy = world.visible(skill, options.knows_patient);
  twin::VirtualBench::Setup bench{
      world.station,
      operatorOf(options, skill, anatomy, world.station.X_ET),
      twin::needlePickedUp(world.station, world.X_WA, anatomy.entry_A, options.left_handed),
      world.X_WA * anatomy.entry_A,
      world.X_WA.rotation() * anatomy.normal_A,
      options.benchSeed(),
      {},
      nullptr,
      {}};
  const MouseHand::Setup mouse{world.X_DA, world.station.X_ET,
                               world.visible(skillOf(OperatorKind::expert), false),
                               options.left_handed};
  return {std::move(bench), mouse};
}

}  // namespace palpa::cli

#pragma once

#include <array>
#include <memory>

#include "apps/twin/hand.h"
#include "apps/twin/operator_skills.h"

namespace palpa::twin {

/// What anybody sees: the object on its stand. O: its middle at rest, x from the second tool to the
/// first, z up.
struct VisibleObject {
  Pose X_AO = Pose::Identity();
  double half = 0.03;  ///< m
};

/// Two fingers of one simulated person. For each thing: close until it is felt, lift it, hold it
/// (how heavy is it?), squeeze it further (how hard is it?), put it down, let go; then which of the
/// two had more of what the screen asks. Knows what is on the screen and what the fingers feel;
/// nothing else.
std::array<std::unique_ptr<Hand>, 2> squeezingHands(const SqueezingSkill& skill,
                                                    const VisibleObject& object, const Pose& X_ET,
                                                    std::uint64_t seed);

}  // namespace palpa::twin

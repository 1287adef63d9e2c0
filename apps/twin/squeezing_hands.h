#pragma once

#include <array>
#include <filesystem>
#include <memory>
#include <string>

#include "apps/twin/hand.h"

namespace palpa::twin {

/// How a simulated person compares two things between two fingers; fixed beforehand in
/// assets/operators/squeeze_*.json, each figure with unit and source. SI units here.
struct SqueezingSkill {
  std::string name;
  HandGrip grip;                       ///< of each finger's tool
  double tremor_rms = 0, look_sd = 0;  ///< m
  double close_speed = 0;              ///< m/s, of each finger, when it closes and squeezes
  double hold = 0, squeeze = 0;        ///< N: to lift; to tell how hard it is
  double weber_stiffness = 0, weber_weight = 0;  ///< standard deviation of ln of what is felt
};
SqueezingSkill readSqueezingSkill(const std::filesystem::path& file);

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

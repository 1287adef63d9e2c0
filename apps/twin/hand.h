#pragma once

#include <cstdint>

#include "apps/runtime/bus.h"
#include "apps/twin/device_twin.h"

namespace palpa::twin {

/// A simulated person's hand at a simulated device. Knows what is on the screen and what it feels; nothing else.
class Hand {
 public:
  struct Senses {
    std::int64_t now_ns = 0;
    Pose X_DE = Pose::Identity();   ///< where the own hand is (proprioception)
    Vec3 f_grip_D = Vec3::Zero();   ///< force of the hand on the tool
    const runtime::Displayed* seen = nullptr;
  };
  struct Action {
    Pose X_DH = Pose::Identity();   ///< where the hand wants the tool
    double plunger = 0;
    bool gives_up = false;          ///< says so once: the trial can be aborted
    std::uint32_t buttons = 0;
  };
  virtual ~Hand() = default;
  virtual Action act(const Senses& senses, double dt) = 0;
  virtual const HandGrip& grip() const = 0;
};

}  // namespace palpa::twin

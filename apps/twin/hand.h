#pragma once

#include <cstdint>

#include "apps/runtime/bus.h"
#include "apps/twin/device_twin.h"

namespace palpa::twin {

/// A simulated person's hand at a simulated device. Knows what is on the screen and what it feels;
/// nothing else.
class Hand {
 public:
  struct Senses {
    std::int64_t now_ns = 0;
    Pose X_DE = Pose::Identity();  ///< where the own hand is (proprioception)
    Vec3 f_grip_D = Vec3::Zero();  ///< force of the hand on the tool
    const runtime::Displayed* seen = nullptr;
    /// of the fingers on the tool: without what moves the hand itself
    Vec3 f_fingers_D = Vec3::Zero();
  };
  /// What is said; grade: of the lump marked last; chooses: of what the screen asks.
  enum class WordKind { none, gives_up, done, grade, chooses };
  /// What whoever leads the hand says, once.
  struct Word {
    WordKind kind = WordKind::none;
    double diameter = 0;             ///< m; of a grade: of the lump marked last
    int hardness = 0, mobility = 0;  ///< 1 soft, 2 hard; 1 fixed, 2 mobile; 0: not said
    int choice = 0;                  ///< 1, 2, ...
  };
  struct Action {
    Pose X_DH = Pose::Identity();  ///< where the hand wants the tool
    double plunger = 0;
    std::uint32_t buttons = 0;
    Word says;
  };
  virtual ~Hand() = default;
  virtual Action act(const Senses& senses, double dt) = 0;
  virtual const HandGrip& grip() const = 0;
};

}  // namespace palpa::twin

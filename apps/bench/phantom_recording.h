#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "apps/bench/led_pair.h"
#include "apps/twin/phantom/phantom_twin.h"

namespace palpa::bench {

/// How the phantom is felt: as it is, or through a device's encoders and a force sensor that
/// carries a tool.
enum class Noise { none, realistic };
const char* nameOf(Noise noise);

/// One tick on a simulated phantom.
struct PhantomTick {
  Vec3 tip = Vec3::Zero(), dp = Vec3::Zero();  ///< m, as measured
  Vec3 f_r = Vec3::Zero();  ///< N, reaction on the tool, as measured: without the tool's weight and
                            ///< inertia
  Vec3 true_tip = Vec3::Zero();  ///< for the judge only
  twin::PhantomTouch truth;      ///< for the judge only
};

inline constexpr double kPhantomTick = 1e-3;  ///< s

/// The tip led over a phantom. Position and force pass the same low-pass where there is noise, and
/// are late by the same.
std::vector<PhantomTick> recordTouch(twin::PhantomTwin phantom, const twin::LedTip& tip,
                                     Noise noise, std::uint64_t seed);
std::vector<std::array<PhantomTick, 2>> recordTouches(twin::PhantomPairTwin phantom,
                                                      const LedPair& tips, Noise noise,
                                                      std::uint64_t seed);

}  // namespace palpa::bench

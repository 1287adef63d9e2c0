#pragma once

#include "apps/bench/contact_study.h"
#include "haptics/safety/passive_law.h"

namespace palpa::bench {

/// A lump that lies in the phantom and is taken away: the hand's force against that on the phantom
/// without it, rms over rms, over the fresh motions of one tool. `plain`, `lumped`: of one
/// silicone.
struct TakenFigures {
  double left = 0;           ///< what is still felt of it
  double there = 0;          ///< the same with nothing taken
  double taken_N_per_m = 0;  ///< the spring that is taken, at most
  int iterations = 0;        ///< most of the solvers in a tick
};
TakenFigures takenFigures(const twin::Phantom& plain, const twin::Phantom& lumped,
                          const haptics::TouchAugmentation& law, Noise noise);

/// A hand that trembles and moves from place to place with a simulated device, with a band of its
/// motion damped and without. Of the true tip:
struct SteadiedFigures {
  double tremor = 1;     ///< rms of its 8 to 12 Hz, of that without
  double voluntary = 0;  ///< rms of what its 0 to 2 Hz differ, of these without
  double beside = 1;     ///< rms of its 4 to 8 Hz, of that without: what a damped band costs
  double largest_N = 0;
};
struct SteadiedCase {
  twin::DeviceTruth truth;
  twin::HandGrip grip;
  haptics::DampedBand band{8, 12, 20};
  double tremor_rms = 120e-6;  ///< m, of the hand by itself
  std::uint64_t seed = 1;
};
SteadiedFigures steadiedFigures(const SteadiedCase& one);

}  // namespace palpa::bench

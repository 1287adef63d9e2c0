#pragma once

#include <array>

#include "haptics/flight_record.h"
#include "haptics/modulation/modulation.h"
#include "haptics/modulation/virtual_inclusion.h"

/// A lump that lies in the real object and is not felt: what it adds to the reaction is told by its
/// law, and taken off (negative modulation; Jeon, Choi & Harders 2015, their 10.16, solved for the
/// part without the lump).
namespace palpa::haptics {

/// One tool on an object with lumps, frame P, whose z is the outward normal above them: here the
/// shape is known, for so is the lump's place in it.
struct TouchAboveLumps {
  bool touching = false;
  Vec3 p_M = Vec3::Zero();  ///< m, the middle of the round tip
  Vec3 dp = Vec3::Zero();   ///< m, its motion in this tick
  Vec3 f_r = Vec3::Zero();  ///< N, the reaction of the object, lumps and all
};

struct TakenState {
  std::array<InclusionState, kMostLumps> lumps;
  std::array<DahlState, 2> friction;  ///< of each tool on the object without them
};
static_assert(std::is_trivially_copyable_v<TakenState>);

struct TakenLumps {
  std::array<InclusionContact, 2> contacts;             ///< of the object without them
  std::array<Vec3, 2> f_d{Vec3::Zero(), Vec3::Zero()};  ///< N, of the devices on the tools
  std::array<Packed3, kMostLumps> d{};                  ///< m, how far they are pushed
  int iterations = 0;                                   ///< of all solvers
};

inline constexpr int kMostPlainIterations = 16;

/// Whether such a lump is taken off.
bool isTaken(const PlacedLump& lump) noexcept;

/// For every tool that touches:
///     f_r . z = H(x - x0, x') + sum f_T(x) . z          solved for x: f_T of the taken lumps,
///                                                       as `feelInclusion` has it
///     f_plain = H z - drag(H)                           what the object alone would give back
///     f_d = s ((H - f_r . z) z + min(1, 2 f_T . z / f_r . z) (f_plain - f_r)_t)
/// x by a bracketed secant: both parts grow with it, and it lies between 0 and what the whole
/// reaction would take. So of a newton that is sensed never more than a newton is taken, whatever
/// the laws err, and what stays is no spring that pushes outward. Across z the lump's push and its
/// friction cannot be told apart well enough, so the friction of the object alone takes their
/// place, all of it where the lumps add half of the force, and never more than is sensed; where
/// they add nothing nothing is done. f_T falls with the distance by q = 1: without it a lump is
/// taken for a quarter too strong where it is felt from 12 mm beside it [chosen on the eight
/// mock-ups of assets/phantoms; of 0, 0.7, 1 and 1.5]. s: the largest share of the lumps. Two tools
/// one after the other. Invalid figures take nothing. No allocation, no exception.
/// `surfaces`: the object's law under each tool.
TakenLumps takeLumps(const std::array<StiffnessModulation, 2>& surfaces,
                     const std::array<VirtualInclusion, kMostLumpKinds>& kinds,
                     const PlacedLumps& lumps, double tip_radius,
                     const std::array<TouchAboveLumps, 2>& tools, double dt,
                     TakenState* state) noexcept;

/// N/m: the steepest rise of what the lump adds, right above it and pressed slowly, down to `deep`,
/// m: how stiff a spring is taken away. Not for the tick.
double steepestRise(VirtualInclusion lump, double tip_radius, double deep) noexcept;

}  // namespace palpa::haptics

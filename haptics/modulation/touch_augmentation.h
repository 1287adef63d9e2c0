#pragma once

#include <array>
#include <cstdint>
#include <type_traits>

#include "haptics/flight_record.h"
#include "haptics/materials/texture.h"
#include "haptics/modulation/learnt_map.h"
#include "haptics/modulation/modulation.h"
#include "haptics/modulation/taken_lumps.h"
#include "haptics/modulation/virtual_inclusion.h"

/// What haptic augmented reality adds to a real object under one tool or two, in one tick: another
/// stiffness and friction, a texture, lumps that are not there, or not felt though they are.
namespace palpa::haptics {

struct TouchAugmentation {
  /// of the whole object; the real friction for the wanted one leaves it as it is
  FrictionModulation surface;
  std::array<VirtualInclusion, kMostLumpKinds> kinds;
  double tip_radius = 0;            ///< m, of both tools: each touches at p_M - tip_radius u_n
  std::uint8_t other_friction = 0;  ///< 0: friction stays the real one, and nothing is done for it
  std::uint8_t reserved[7]{};
  TextureLaw texture;  ///< of the whole surface; no speeds: none
  LearntMap map;       ///< how the object differs from `surface.contact` from place to place
};
static_assert(std::is_trivially_copyable_v<TouchAugmentation>);

/// One tool: the middle of its round tip, m, and the real object's reaction on it, N (tool weight
/// and dynamics taken off), in one frame with the lumps.
struct ToolTouch {
  bool present = false;  ///< there is such a tool, and its readings are good
  Vec3 p_M = Vec3::Zero(), f_r = Vec3::Zero();
  double friction = 1;  ///< times the law's wanted friction, where that is not the real one
};

struct TouchAugmentationState {
  std::array<FrictionModulationState, 2> surface;
  std::array<InclusionState, kMostLumps> lumps;
  TakenState taken;
  std::array<TextureState, 2> texture;
  std::array<Packed3, 2> p_before{};    ///< m
  std::array<std::uint32_t, 2> held{};  ///< p_before is there
};
static_assert(std::is_trivially_copyable_v<TouchAugmentationState>);

struct AugmentedTouch {
  std::array<Modulated, 2> touch;  ///< what was felt of the real object, and what is changed of it
  std::array<Vec3, 2> f_d{Vec3::Zero(),
                          Vec3::Zero()};  ///< N, of the devices on the tools, all together
  /// N, the part of f_d that asks for no motion: a source, left out of the passivity's account
  std::array<Vec3, 2> f_source{Vec3::Zero(), Vec3::Zero()};
  /// N, parts of f_d: of the virtual lumps, and what takes real ones away
  std::array<Vec3, 2> f_lumps{Vec3::Zero(), Vec3::Zero()};
  std::array<Vec3, 2> f_taken{Vec3::Zero(), Vec3::Zero()};
  std::uint8_t taking = 0;              ///< 1: f_taken has the place of what changes the surface
  std::array<Packed3, kMostLumps> d{};  ///< m, how far the lumps are pushed, in their own frames
  int iterations = 0;  ///< of all lumps' solvers; at most kMostLumps kMostInclusionIterations
};

/// Unit: the lump's normal; z where it has none that is upward.
Vec3 outwardOver(const PlacedLump& lump) noexcept;

///     f_d* = (k~ x* - f_n*) u_n*  [+ f_targ* - f_real*]
///            +  w* u_n*  +  sum over lumps (f_T* + f_t* (f_T* . u_n*) / f_n*)
/// w: of the texture (`textureForce`), by the real normal force and what slides.
/// The real object is that of `lawAt` under each tool: where there is a map, k, b and mu are those
/// of its place.
/// f_targ: of mu and B of the wanted friction, times the tool's factor (0 or more; else 1).
/// Where lumps are real and taken off, `takeLumps` has the place of the first line: nothing else is
/// changed of the surface then. Each lump feels both tools, and no other lump. Where there is no
/// contact there is no force. Below a curved surface a lump's bed lies across the normal over it:
/// what is felt of the lump is computed in the frame in which that is z. No allocation, no
/// exception.
AugmentedTouch augmentTouch(const TouchAugmentation& law, const PlacedLumps& lumps,
                            const std::array<ToolTouch, 2>& tools, double dt,
                            TouchAugmentationState* state) noexcept;

}  // namespace palpa::haptics

#pragma once

#include <array>
#include <memory>
#include <vector>

#include "apps/twin/hand.h"
#include "apps/twin/lump_search.h"
#include "apps/twin/operator_skills.h"

/// Simulated persons who find out by feel: in soft tissue, over a floor, between two fingers, under
/// one that strokes, and below a surface that beats.
namespace palpa::twin {

/// The fingers, one or two, of a simulated person who searches a soft thing for lumps, in vertical
/// strips: presses, judges how far it gave way at each pressure against what the nearest ordinary
/// places gave, looks closer where it gave less, marks by holding still with the button, grades.
/// Two fingers search side by side, strips apart; the closer look is the first one's alone, and
/// before it marks, both roll what is between them. Knows what is on the screen and what the
/// fingers feel; nothing else.
std::vector<std::unique_ptr<Hand>> palpatingFingers(const PalpatingSkill& skill,
                                                    const VisiblePhantom& phantom, const Pose& X_ET,
                                                    int fingers, std::uint64_t seed);

/// What anybody sees and has been told: the floor's outline, magnified; that three elements lie
/// equally spaced on a circle, each with a pit in its middle.
struct VisibleFloor {
  Pose X_AF = Pose::Identity();
  double magnification = 10;
  double unit = 60e-6;     ///< m in the hand
  double handle_mass = 0;  ///< kg, that the hand has got used to
  double start_height = 20, circle = 200.0 / 3, disc = 25,
         groove = 35;  ///< U; groove: its outer rim
};

/// One simulated person searching: goes down to the floor, round the circle, notices jolts, takes
/// the elements to lie where most jolts were, strokes over each, and stays in the middle of the one
/// that felt roughest; from there looks for its pit. Knows what is on the screen and what it feels;
/// nothing else.
std::unique_ptr<Hand> searchingHand(const SearchingSkill& skill, const VisibleFloor& floor,
                                    const Pose& X_ET, std::uint64_t seed);

/// Where three elements lie, equally spaced, by the angles (rad) at which jolts were noticed: the
/// direction of one of them, 0 to 2 pi / 3, about which most jolts are within `half` of an
/// element's middle; of several, the middle of the widest range of them, of equals the one nearest
/// `start`, which is the answer where nothing tells.
double orientationBy(const std::vector<double>& angles, double half, double start);

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

/// One simulated person stroking over surfaces, one after the other: first in the air, to know what
/// moving the tool takes; then down until it presses as hard as meant, to and fro, and off. What
/// rubs by what presses, both as the fingers feel them, is how rough it seems:
///     (f_along - f_along in the air) / (f_n - f_n in the air),   each time exp(s n), n normal
/// Says "done" for the next surface, then which of two is rougher, or all from the smoothest to the
/// roughest, as the screen asks. `X_AP`: the drawn block, origin in the middle of its top, z up.
/// Knows what is on the screen and what the fingers feel; nothing else.
std::unique_ptr<Hand> strokingHand(const StrokingSkill& skill, const Pose& X_AP, const Pose& X_ET,
                                   std::uint64_t seed);

/// One simulated person who examines a pulse: knows where the artery usually lies (along y of the
/// block, through its middle), presses at places across that line, from the middle outward, and
/// waits at each for beats (BeatSense); goes back to the middle of where they were strongest; an
/// expert then varies the pressure until they are strongest. Marks it with the button, says "done",
/// counts what is felt while the screen says so, says the number and what the rhythm is by the felt
/// intervals (rhythmBy). Knows what is on the screen and what the fingers feel; nothing else.
std::unique_ptr<Hand> pulseHand(const PulseSkill& skill, const Pose& X_AP, const Pose& X_ET,
                                std::uint64_t seed);

}  // namespace palpa::twin

#pragma once

#include <array>

#include "anatomy/geometry/local_geometry.h"

/// The colours of the program's pictures. Vein and artery differ in luminance as well as in hue, so
/// that they stay apart for colour-blind eyes; chrome is neutral, and only an alarm is loud.
namespace palpa::scene {

using Rgb = std::array<double, 3>;
using Rgba = std::array<double, 4>;

namespace colour {
inline constexpr Rgb kBorder{0.20, 0.22, 0.25};
inline constexpr Rgb kClear{0, 0, 0};  ///< where a display is looked through
inline constexpr Rgb kPanel{0.075, 0.085, 0.100};
inline constexpr Rgb kBehindBottom{0.085, 0.100, 0.120};  ///< AR view without a picture
inline constexpr Rgb kBehindTop{0.190, 0.220, 0.255};
inline constexpr Rgb kTable{0.47, 0.52, 0.55};            ///< what a patient lies on
inline constexpr Rgb kShadow{0.04, 0.03, 0.05};           ///< of a tool, on the skin
inline constexpr Rgb kRing{0.99, 0.97, 0.90};             ///< about where a needle went in
inline constexpr Rgba kPlate{0.035, 0.045, 0.060, 0.74};  ///< under text
inline constexpr Rgb kText{0.96, 0.97, 0.98};
inline constexpr Rgb kTextDim{0.66, 0.70, 0.75};
inline constexpr Rgb kMark{1.00, 0.80, 0.30};  ///< amber badge
inline constexpr Rgba kAlarmPlate{0.72, 0.08, 0.05, 0.94};
inline constexpr Rgb kAdvice{0.45, 0.76, 0.96};  ///< edge of a calm notice
inline constexpr Rgb kTickGood{0.18, 0.78, 0.60},
    kTickBad{0.95, 0.45, 0.18};  ///< on a replay's strip
inline constexpr Rgb kSteel{0.80, 0.83, 0.86};
inline constexpr Rgb kNeedle{0.97, 0.98, 1.00};        ///< its line on the screen
inline constexpr Rgb kNeedleInside{1.00, 0.66, 0.50};  ///< the same, under the skin
inline constexpr Rgb kLumen{0.10, 0.10, 0.12};
inline constexpr Rgb kHub{0.88, 0.52, 0.66};  ///< 18G is pink (ISO 6009)
inline constexpr Rgb kGlass{0.80, 0.90, 0.97};
inline constexpr Rgb kRubber{0.13, 0.14, 0.16};
inline constexpr Rgb kPlastic{0.90, 0.92, 0.94};
inline constexpr Rgb kTip{0.93, 0.93, 0.88};  ///< of the palpation probe
inline constexpr Rgb kInk{0.10, 0.14, 0.20};
inline constexpr Rgb kBlood{0.50, 0.02, 0.03};          ///< of a vein
inline constexpr Rgb kArterialBlood{0.93, 0.16, 0.12};  ///< three times as bright
inline constexpr Rgb kAir{0.94, 0.97, 1.00};            ///< bubbles
inline constexpr Rgb kTrail{0.99, 0.82, 0.26};
// Felt lightly, firmly, deeply: as maps show the sea, paler where it is shallow. Each has its
// brightness, whatever lies below.
inline constexpr Rgba kFeltLight{0.66, 0.92, 1.00, 0.44};
inline constexpr Rgba kFeltMedium{0.18, 0.62, 0.88, 0.48};
inline constexpr Rgba kFeltDeep{0.01, 0.20, 0.58, 0.55};
inline constexpr Rgb kFound{
    0.98, 0.86,
    0.30};  ///< a lump; yellow and vermilion differ for colour-blind eyes, by hue and by brightness
inline constexpr Rgb kMissed{0.90, 0.40, 0.10};
inline constexpr Rgb kNormal{0.72, 0.72, 0.74};   ///< what belongs there
inline constexpr Rgb kSection{0.86, 0.72, 0.62};  ///< the skin's outline in fixed views
}  // namespace colour

/// For an organ whose file gives none (plain white).
inline constexpr Rgb organColour(Organ organ) {
  switch (organ) {
    case Organ::skin:
      return {0.87, 0.70, 0.60};
    case Organ::fascia:
    case Organ::muscle:
      return {0.62, 0.28, 0.26};
    case Organ::clavicle:
    case Organ::rib:
    case Organ::sternum:
    case Organ::scapula:
    case Organ::spine:
      return {0.93, 0.89, 0.78};
    case Organ::cartilage:
      return {0.76, 0.82, 0.84};
    case Organ::airway:
      return {0.80, 0.84, 0.72};
    case Organ::lung:
      return {0.88, 0.62, 0.66};
    case Organ::vein:
      return {0.20, 0.38, 0.80};
    case Organ::artery:
      return {0.93, 0.36, 0.16};
    case Organ::inclusion:
      return {0.90, 0.62, 0.20};
    case Organ::none:
      break;
  }
  return {0.7, 0.7, 0.7};
}

}  // namespace palpa::scene

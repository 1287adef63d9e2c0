#pragma once

#include <string>
#include <string_view>

/// Colours told apart with every common kind of colour vision (Okabe & Ito, "Color Universal
/// Design", 2008). Pages use them through the CSS variables of style.h, which have a lighter form
/// for dark screens; where two things share a picture their line style or shape differs as well.
namespace palpa::report::palette {

inline constexpr std::string_view kBlack = "#000000";
inline constexpr std::string_view kOrange = "#E69F00";
inline constexpr std::string_view kSkyBlue = "#56B4E9";
inline constexpr std::string_view kGreen = "#009E73";
inline constexpr std::string_view kYellow = "#F0E442";
inline constexpr std::string_view kBlue = "#0072B2";
inline constexpr std::string_view kVermillion = "#D55E00";
inline constexpr std::string_view kPurple = "#CC79A7";

}  // namespace palpa::report::palette

namespace palpa::report {

/// What a span or moment means for the learner; decides colour and shape.
enum class Tone { neutral, good, guide, bad };

const char* cssClass(Tone tone);
Tone toneOfMoment(
    const std::string& kind);  ///< "vein", "lung", "bone", ...; unknown ones are neutral

/// The page's style sheet: light, dark, telephone, paper.
std::string styleSheet();

}  // namespace palpa::report

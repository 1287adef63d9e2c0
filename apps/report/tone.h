#pragma once

#include <string>

namespace palpa::report {

/// What a span or moment means for the learner; decides colour and shape.
enum class Tone { neutral, good, guide, bad };

const char* cssClass(Tone tone);
Tone toneOfSpan(const std::string& kind);  ///< "phase", "good", "guide", "bad"
Tone toneOfMoment(
    const std::string& kind);  ///< "vein", "lung", "bone", ...; unknown ones are neutral

}  // namespace palpa::report

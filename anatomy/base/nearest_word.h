#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>

namespace palpa {

/// The known word that was probably meant by what was typed: the one that the fewest changes make
/// of it (a letter more, less, other, or two swapped: optimal string alignment), the first of
/// equally near ones. A capital for a small letter and "_" for "-" count a quarter. None where more
/// than a third of the letters would have to change, unless it is the one known word that begins
/// so.
std::optional<std::string> nearestWord(std::string_view typed, std::span<const std::string> known);

/// " (did you mean NAME?)" for the end of a sentence that refuses `typed`, each with `mark` about
/// it; empty where nothing is near.
std::string didYouMean(std::string_view typed, std::span<const std::string> known,
                       std::string_view mark = "\"");

}  // namespace palpa

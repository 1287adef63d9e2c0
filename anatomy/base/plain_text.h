#pragma once

#include <cstddef>
#include <string>
#include <string_view>

namespace palpa {

/// Text from elsewhere (a network, a log) as one line that may stand on a screen or in a terminal:
/// control characters, line ends, marks that turn the direction of writing, and what is no UTF-8
/// become '?'. At most `most` bytes, never half a character.
std::string plainText(std::string_view text, std::size_t most);

}  // namespace palpa

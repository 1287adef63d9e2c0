#pragma once

#include <cstddef>
#include <string>
#include <string_view>

namespace palpa {

/// RFC 4648 with padding, no line breaks.
std::string base64(std::string_view bytes);

/// A text as a field of a CSV, RFC 4180: quoted only where needed, quotes doubled.
std::string csvField(const std::string& text);

/// Text from elsewhere (a network, a log) as one line that may stand on a screen or in a terminal:
/// control characters, line ends, marks that turn the direction of writing, and what is no UTF-8
/// become '?'. At most `most` bytes, never half a character.
std::string plainText(std::string_view text, std::size_t most);

/// The characters of UTF-8, as Unicode numbers them; each byte that is none of it becomes U+FFFD.
std::u32string lettersOf(std::string_view text);

/// Before a std::regex is made where several threads may make one: libstdc++ fills a table of the
/// locale at each letter's first use, unguarded. Here all of it, once. Any thread.
void preparePatterns();

}  // namespace palpa

#pragma once

#include <filesystem>
#include <string>
#include <string_view>

namespace palpa {

/// A family of letters that a Debian package brings.
struct Font {
  const char* family;        ///< as Cairo and style sheets call it
  const char *plain, *bold;  ///< TrueType files
  const char* package;
  const char* letters;  ///< what a person calls those that no other has
};

/// What a whole text is drawn with, in windows, pictures and on paper: Nanum Barun Gothic where it
/// has a Korean letter (it has Latin, Greek and Cyrillic ones, too), else DejaVu Sans.
const Font& fontOf(std::string_view text);

/// Whether a key's letter is one of those that DejaVu Sans has or Nanum Barun Gothic has.
bool hasFont(char32_t letter);

bool isThere(const Font& font, const std::filesystem::path& root = "/");

}  // namespace palpa

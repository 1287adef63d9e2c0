#include "anatomy/base/text_forms.h"

#include <openssl/evp.h>
#include <algorithm>
#include <iterator>
#include <locale>
#include <utility>

namespace palpa {

std::string base64(std::string_view bytes) {
  std::string text((bytes.size() + 2) / 3 * 4, '\0');
  EVP_EncodeBlock(reinterpret_cast<unsigned char*>(text.data()),
                  reinterpret_cast<const unsigned char*>(bytes.data()),
                  static_cast<int>(bytes.size()));
  return text;
}

std::string csvField(const std::string& text) {
  if (text.find_first_of(",\"\r\n") == std::string::npos) return text;
  std::string quoted = "\"";
  for (const char c : text) quoted += c == '"' ? std::string("\"\"") : std::string(1, c);
  return quoted + '"';
}

namespace {

constexpr char32_t kNone = 0xffffffff;

struct Read {
  char32_t character = kNone;  ///< kNone: no UTF-8
  std::size_t size = 1;
};

bool goesOn(char c) { return (static_cast<unsigned char>(c) & 0xc0) == 0x80; }

/// How many bytes a character has that begins with `first`; 0: none does.
std::size_t sizeOf(unsigned char first) {
  if (first < 0x80) return 1;
  if (first < 0xc2) return 0;
  if (first < 0xe0) return 2;
  if (first < 0xf0) return 3;
  return first < 0xf5 ? 4 : 0;
}

/// The first character of `text`, which is not empty.
Read firstOf(std::string_view text) {
  constexpr char32_t kLeast[] = {0, 0, 0x80, 0x800, 0x10000};
  constexpr unsigned char kBits[] = {0, 0x7f, 0x1f, 0x0f, 0x07};
  const auto first = static_cast<unsigned char>(text.front());
  const std::size_t size = sizeOf(first);
  if (size == 0 || size > text.size()) return {};
  char32_t character = first & kBits[size];
  for (std::size_t i = 1; i < size; ++i) {
    if (!goesOn(text[i])) return {};
    character = character << 6 | (static_cast<unsigned char>(text[i]) & 0x3f);
  }
  const bool half = character >= 0xd800 && character <= 0xdfff;
  if (character < kLeast[size] || half || character > 0x10ffff) return {};
  return {character, size};
}

/// Of those that a terminal or a screen would obey rather than show.
bool isObeyed(char32_t c) {
  constexpr std::pair<char32_t, char32_t> kRanges[] = {
      {0x00, 0x1f},     {0x7f, 0x9f},     {0x61c, 0x61c},   {0x200e, 0x200f},
      {0x2028, 0x202e}, {0x2060, 0x206f}, {0xfeff, 0xfeff}, {0xfff9, 0xfffb}};
  return std::any_of(std::begin(kRanges), std::end(kRanges),
                     [c](const auto& range) { return c >= range.first && c <= range.second; });
}

}  // namespace

std::string plainText(std::string_view text, std::size_t most) {
  std::string plain;
  while (!text.empty()) {
    const Read read = firstOf(text);
    const bool shown = read.character != kNone && !isObeyed(read.character);
    if (plain.size() + (shown ? read.size : 1) > most) break;
    plain.append(shown ? text.substr(0, read.size) : "?");
    text.remove_prefix(read.size);
  }
  return plain;
}

std::u32string lettersOf(std::string_view text) {
  std::u32string letters;
  while (!text.empty()) {
    const Read read = firstOf(text);
    letters += read.character == kNone ? U'\ufffd' : read.character;
    text.remove_prefix(read.size);
  }
  return letters;
}

void preparePatterns() {
  [[maybe_unused]] static const bool done = [] {
    constexpr int kLetters = 256;
    char all[kLetters], narrow[kLetters];
    for (int i = 0; i < kLetters; ++i) all[i] = static_cast<char>(i);
    std::use_facet<std::ctype<char>>(std::locale()).narrow(all, all + kLetters, '\0', narrow);
    return true;
  }();
}

}  // namespace palpa

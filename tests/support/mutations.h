#pragma once

#include <algorithm>
#include <iterator>
#include <string>

#include "damage.h"

namespace palpa::test {

/// A place in a file; every other time among the first bytes, where headers stand.
inline std::size_t placeIn(const std::string& bytes, DamageDice& dice) {
  constexpr std::size_t kHeader = 400;
  return dice.below(dice.below(2) ? bytes.size() : std::min(bytes.size(), kHeader));
}

/// A number becomes one that no file should hold.
inline void replaceNumber(std::string* bytes, DamageDice& dice) {
  static const char* const kNumbers[] = {
      "0",   "-1",  "1e308",      "-1e308",     "1e999",
      "nan", "inf", "4294967295", "2147483647", "18446744073709551616",
      "1e9", "0.5", "1e-300",     "100000",     "99999999999999999999999999999999"};
  const std::size_t from = bytes->find_first_of("0123456789", placeIn(*bytes, dice));
  if (from == std::string::npos) return;
  const std::size_t end = bytes->find_first_not_of("0123456789.eE+-", from);
  bytes->replace(from, std::min(end, bytes->size()) - from,
                 kNumbers[dice.below(std::size(kNumbers))]);
}

/// What stands between two quotation marks becomes too long, damaged, or something else.
inline void replaceText(std::string* bytes, DamageDice& dice) {
  static const std::string kTexts[] = {std::string(100'000, 'x'), "\xC3\x28\xFF", "",
                                       "\\u0000\\n\\u001b[2J",    "../nowhere",   "%s%n",
                                       std::string(300, '.'),     "\xE2\x80\xAE"};
  const std::size_t open = bytes->find('"', placeIn(*bytes, dice));
  const std::size_t close = open == std::string::npos ? open : bytes->find('"', open + 1);
  if (close == std::string::npos) return;
  bytes->replace(open + 1, close - open - 1, kTexts[dice.below(std::size(kTexts))]);
}

inline void dropBracket(std::string* bytes, DamageDice& dice) {
  const std::size_t at = bytes->find_first_of("{}[]<>\",:;=\n", placeIn(*bytes, dice));
  if (at != std::string::npos) bytes->erase(at, 1);
}

/// Nested deeper than a reader's stack might hold.
inline void nest(std::string* bytes, DamageDice& dice) {
  constexpr std::size_t kDeep = 20'000;
  std::string deep;
  if (dice.below(2))
    deep = std::string(kDeep, '[') + std::string(kDeep, ']');
  else
    for (std::size_t i = 0; i < kDeep; ++i) deep += "{\"a\":";
  const std::size_t at = bytes->find_first_of(":[,>", placeIn(*bytes, dice));
  bytes->insert(at == std::string::npos ? 0 : at + 1, deep);
}

inline void changeBytes(std::string* bytes, DamageDice& dice) {
  for (std::size_t hits = 1 + dice.below(8); hits > 0; --hits) {
    char& byte = (*bytes)[placeIn(*bytes, dice)];
    byte = static_cast<char>(dice.below(2) ? byte ^ (1 << dice.below(8)) : dice.below(256));
  }
}

/// A file as damage or ill will may leave it, changed in one place or a few.
inline std::string mutated(std::string bytes, DamageDice& dice) {
  for (std::size_t changes = 1 + dice.below(3); changes > 0 && !bytes.empty(); --changes) {
    const std::size_t at = placeIn(bytes, dice);
    switch (dice.below(12)) {
      case 0:
        bytes.resize(at);
        break;
      case 1:
        bytes.insert(at, bytes.substr(placeIn(bytes, dice), 1 + dice.below(500)));
        break;
      case 2:
        bytes.erase(at, 1 + dice.below(64));
        break;
      case 3:
        dropBracket(&bytes, dice);
        break;
      case 4:
        nest(&bytes, dice);
        break;
      case 5:
      case 6:
        replaceText(&bytes, dice);
        break;
      case 7:
      case 8:
      case 9:
        replaceNumber(&bytes, dice);
        break;
      default:
        changeBytes(&bytes, dice);
    }
  }
  return bytes;
}

}  // namespace palpa::test

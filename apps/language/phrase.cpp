#include "apps/language/phrase.h"

#include <algorithm>

#include "anatomy/base/error.h"

namespace palpa::language {
namespace {

struct Place {
  std::size_t at, end;
  int number;
};

/// The next "{7}" from `from` on; its `at` is npos where none follows.
Place nextPlace(std::string_view text, std::size_t from) {
  for (std::size_t at = text.find('{', from); at != std::string_view::npos;
       at = text.find('{', at + 1)) {
    std::size_t end = at + 1;
    int number = 0;
    while (end < text.size() && text[end] >= '0' && text[end] <= '9' && number < 100)
      number = 10 * number + (text[end++] - '0');
    if (end > at + 1 && end < text.size() && text[end] == '}') return {at, end + 1, number};
  }
  return {std::string_view::npos, 0, 0};
}

struct Pair {
  std::string_view small, large;
};
/// Those that begin a word in the languages shipped.
constexpr Pair kPairs[] = {
    {"à", "À"},
    {"á", "Á"},
    {"â", "Â"},
    {"ã", "Ã"},
    {"ä", "Ä"},
    {"ç", "Ç"},
    {"è", "È"},
    {"é", "É"},
    {"ê", "Ê"},
    {"í", "Í"},
    {"î", "Î"},
    {"ñ", "Ñ"},
    {"ó", "Ó"},
    {"ô", "Ô"},
    {"õ", "Õ"},
    {"ö", "Ö"},
    {"ú", "Ú"},
    {"ü", "Ü"},
    {"œ", "Œ"},
    {"α", "Α"},
    {"β", "Β"},
    {"γ", "Γ"},
    {"δ", "Δ"},
    {"ε", "Ε"},
    {"ζ", "Ζ"},
    {"η", "Η"},
    {"θ", "Θ"},
    {"ι", "Ι"},
    {"κ", "Κ"},
    {"λ", "Λ"},
    {"μ", "Μ"},
    {"ν", "Ν"},
    {"ξ", "Ξ"},
    {"ο", "Ο"},
    {"π", "Π"},
    {"ρ", "Ρ"},
    {"σ", "Σ"},
    {"τ", "Τ"},
    {"υ", "Υ"},
    {"φ", "Φ"},
    {"χ", "Χ"},
    {"ψ", "Ψ"},
    {"ω", "Ω"},
    {"ά", "Ά"},
    {"έ", "Έ"},
    {"ή", "Ή"},
    {"ί", "Ί"},
    {"ό", "Ό"},
    {"ύ", "Ύ"},
    {"ώ", "Ώ"},
    // of the language that nobody speaks
    {"ƀ", "Ƀ"},
    {"đ", "Đ"},
    {"ƒ", "Ƒ"},
    {"ĝ", "Ĝ"},
    {"ĥ", "Ĥ"},
    {"ĵ", "Ĵ"},
    {"ķ", "Ķ"},
    {"ł", "Ł"},
    {"ɱ", "Ɱ"},
    {"ƥ", "Ƥ"},
    {"ɋ", "Ɋ"},
    {"ř", "Ř"},
    {"š", "Š"},
    {"ŧ", "Ŧ"},
    {"ʋ", "Ʋ"},
    {"ŵ", "Ŵ"},
    {"ẋ", "Ẋ"},
    {"ý", "Ý"},
    {"ž", "Ž"},
};

std::string changed(const std::string& text, bool to_large) {
  if (text.empty()) return text;
  const char first = text[0];
  if (to_large && first >= 'a' && first <= 'z')
    return static_cast<char>(first - 'a' + 'A') + text.substr(1);
  if (!to_large && first >= 'A' && first <= 'Z')
    return static_cast<char>(first - 'A' + 'a') + text.substr(1);
  for (const Pair& pair : kPairs) {
    const std::string_view from = to_large ? pair.small : pair.large;
    const std::string_view to = to_large ? pair.large : pair.small;
    if (text.starts_with(from)) return std::string(to) + text.substr(from.size());
  }
  return text;
}

}  // namespace

std::string withCapital(const std::string& text) { return changed(text, true); }
std::string withoutCapital(const std::string& text) { return changed(text, false); }

int columnsOf(std::string_view text) {
  int columns = 0;
  for (std::size_t i = 0; i < text.size(); ++i) {
    const auto byte = static_cast<unsigned char>(text[i]);
    if (byte >> 6 == 2) continue;  // within a letter
    columns += 1;
    if (byte >> 4 != 0xe || i + 1 >= text.size()) continue;
    const int page = (byte & 15) << 6 | (text[i + 1] & 63);  // of 64 letters
    const bool wide = (page >= 0x1100 >> 6 && page < 0x1160 >> 6) ||
                      (page >= 0x2e80 >> 6 && page < 0xa4d0 >> 6) ||
                      (page >= 0xac00 >> 6 && page < 0xd7c0 >> 6) ||
                      (page >= 0xff00 >> 6 && page < 0xff80 >> 6);
    columns += wide ? 1 : 0;
  }
  return columns;
}

char lower(char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c; }
bool isLetter(char c) { return lower(c) >= 'a' && lower(c) <= 'z'; }
bool isLetterOrDigit(char c) { return isLetter(c) || (c >= '0' && c <= '9'); }

Phrase::Phrase(const std::string& id, const std::string& translation) {
  std::vector<int> places;
  std::size_t from = 0;
  for (Place next = nextPlace(id, 0); next.at != std::string::npos; next = nextPlace(id, from)) {
    fixed.push_back(id.substr(from, next.at - from));
    places.push_back(next.number);
    from = next.end;
  }
  fixed.push_back(id.substr(from));
  for (const std::string& part : fixed)
    letters += static_cast<int>(std::count_if(part.begin(), part.end(), isLetter));

  from = 0;
  for (Place next = nextPlace(translation, 0); next.at != std::string::npos;
       next = nextPlace(translation, from)) {
    const auto found = std::find(places.begin(), places.end(), next.number);
    if (found == places.end())
      throw UsageError(
          "has the place {" + std::to_string(next.number) + "}, but its message has none",
          "the translation \"" + translation + "\"", "Correct it in the catalogue");
    said.push_back({translation.substr(from, next.at - from), -1});
    said.push_back({"", static_cast<int>(found - places.begin())});
    from = next.end;
  }
  said.push_back({translation.substr(from), -1});
}

std::string PhraseIndex::beginning(std::string_view text, std::size_t length) {
  std::string key(text.substr(0, length));
  std::transform(key.begin(), key.end(), key.begin(), lower);
  return key;
}

void PhraseIndex::add(const Phrase& phrase) {
  by_beginning_[beginning(phrase.head(), std::min(phrase.head().size(), kBeginning))].push_back(
      &phrase);
}

void PhraseIndex::sort() {
  for (auto& [beginning, all] : by_beginning_)
    std::stable_sort(all.begin(), all.end(),
                     [](const Phrase* a, const Phrase* b) { return a->letters > b->letters; });
}

}  // namespace palpa::language

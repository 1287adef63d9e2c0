#include "apps/language/letters.h"

#include <string_view>

namespace palpa::language {
namespace {

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

}  // namespace palpa::language

#include "apps/language/pseudo.h"

#include <algorithm>

#include "apps/language/phrase.h"

namespace palpa::language {
namespace {

/// DejaVu Sans has all of these.
constexpr std::string_view kSmall[] = {"á", "ƀ", "ç", "đ", "é", "ƒ", "ĝ", "ĥ", "í",
                                       "ĵ", "ķ", "ł", "ɱ", "ñ", "ó", "ƥ", "ɋ", "ř",
                                       "š", "ŧ", "ú", "ʋ", "ŵ", "ẋ", "ý", "ž"};
constexpr std::string_view kLarge[] = {"Á", "Ƀ", "Ç", "Đ", "É", "Ƒ", "Ĝ", "Ĥ", "Í",
                                       "Ĵ", "Ķ", "Ł", "Ɱ", "Ñ", "Ó", "Ƥ", "Ɋ", "Ř",
                                       "Š", "Ŧ", "Ú", "Ʋ", "Ŵ", "Ẋ", "Ý", "Ž"};

/// Vowels twice until the text is a third longer.
std::string marked(const std::string& id) {
  const auto letters = std::count_if(id.begin(), id.end(), isLetter);
  long more = (letters + 2) / 3;
  std::string out;
  for (const char c : id) {
    if (!isLetter(c)) {
      out += c;
      continue;
    }
    const auto& alphabet = c >= 'a' ? kSmall : kLarge;
    const std::string_view letter = alphabet[static_cast<std::size_t>(lower(c) - 'a')];
    out += letter;
    if (more > 0 && std::string_view("aeioun").find(lower(c)) != std::string_view::npos) {
      out += kSmall[static_cast<std::size_t>(lower(c) - 'a')];
      --more;
    }
  }
  for (; more > 0; --more) out += "·";
  return out;
}

}  // namespace

std::vector<PoFile::Message> pseudoMessages(const PoFile& messages) {
  std::vector<PoFile::Message> all;
  for (const PoFile::Message& message : messages.messages)
    all.push_back({message.id, marked(message.id)});
  return all;
}

}  // namespace palpa::language

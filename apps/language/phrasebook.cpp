#include "apps/language/phrasebook.h"

#include <algorithm>
#include <deque>

#include "apps/language/phrase.h"
#include "apps/language/reading.h"

namespace palpa::language {
namespace {

constexpr std::size_t kLongest = 800;  // bytes that are read as one

bool isLineEnd(char c) { return c == '\n' || c == '\r' || c == '\t'; }

/// Where the sentence, the line or the column that begins at `from` ends.
std::size_t endOfPart(std::string_view text, std::size_t from) {
  for (std::size_t at = from; at < text.size(); ++at) {
    if (isLineEnd(text[at])) return at;
    if (text[at] == ' ' && at + 1 < text.size() && text[at + 1] == ' ') return at;
    if (at - from > kLongest && text[at] == ' ') return at;
  }
  return text.size();
}

int gapAt(std::string_view text, std::size_t from) {
  const std::size_t end = std::min(text.find_first_not_of(' ', from), text.size());
  return static_cast<int>(end - from);
}

}  // namespace

struct Phrasebook::Pages {
  std::deque<Phrase> phrases;
  std::map<std::string, const Phrase*, std::less<>> alone;  ///< those without a place
  PhraseIndex whole, behind;
  NumberForm numbers;
};

Phrasebook::Phrasebook() = default;
Phrasebook::~Phrasebook() = default;
Phrasebook::Phrasebook(Phrasebook&&) noexcept = default;
Phrasebook& Phrasebook::operator=(Phrasebook&&) noexcept = default;

Phrasebook::Phrasebook(const std::vector<PoFile::Message>& messages, NumberForm numbers) {
  auto pages = std::make_unique<Pages>();
  pages->numbers = std::move(numbers);
  for (const PoFile::Message& message : messages) {
    if (message.translation.empty()) continue;
    const Phrase& phrase = pages->phrases.emplace_back(message.id, message.translation);
    if (phrase.letters == 0) continue;
    if (phrase.fixed.size() == 1) pages->alone.emplace(message.id, &phrase);
    (phrase.beginsWithAPlace() ? pages->behind : pages->whole).add(phrase);
  }
  pages->whole.sort();
  pages->behind.sort();
  pages_ = std::move(pages);
}

std::string Phrasebook::said(std::string_view english) const {
  if (isEnglish()) return std::string(english);
  std::string out;
  int ahead = 0;  // columns that what is said takes more than the English, in this line
  for (std::size_t at = 0; at < english.size();) {
    if (isLineEnd(english[at])) {
      out += english[at++];
      ahead = 0;
      continue;
    }
    if (english[at] == ' ') {
      const int gap = gapAt(english, at);
      const int kept = gap < 2 ? gap : std::max(2, gap - ahead);
      out.append(static_cast<std::size_t>(kept), ' ');
      ahead += kept - gap;
      at += static_cast<std::size_t>(gap);
      continue;
    }
    const std::size_t end = endOfPart(english, at);
    const std::string_view part = english.substr(at, end - at);
    const std::string_view bare = part.substr(0, part.find_last_not_of(".,;: ") + 1);
    const auto found = pages_->alone.find(bare);
    const std::string said =
        found != pages_->alone.end()
            ? found->second->said.front().text + std::string(part.substr(bare.size()))
            : Reading(part, pages_->whole, pages_->behind).said(pages_->numbers);
    ahead += columnsOf(said) - columnsOf(part);
    out += said;
    at = end;
  }
  return out;
}

}  // namespace palpa::language

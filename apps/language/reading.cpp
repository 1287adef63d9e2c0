#include "apps/language/reading.h"

#include <algorithm>

namespace palpa::language {
namespace {

constexpr int kALetter = 10, kAPhrase = 3, kAPlace = 1,
              kOtherCase = 1;               // worth, and what they cost
constexpr int kMostEffort = 100'000;        // comparisons at one place of the text
constexpr std::size_t kLongestPutIn = 240;  // bytes
constexpr int kMostEnds = 4;                // of what is put in, tried

}  // namespace

/// A phrase that is tried from one place of a range on.
struct Reading::Trial {
  Range range;
  const Choices& later;
  const Phrase* phrase = nullptr;
  bool other_case = false;
  int worth = 0;
  std::vector<Range> put_in;
  Choice best;
  int most = 0;  ///< no phrase here is worth more
};

bool Reading::standsAt(std::string_view fixed, std::size_t at, Range range) const {
  return at + fixed.size() <= range.end && text_.substr(at, fixed.size()) == fixed;
}

/// Where a part of a sentence may begin or end.
bool Reading::isBreak(std::size_t at, Range range) const {
  if (at == range.begin || at == range.end) return true;
  static constexpr std::string_view kMarks = ".,;:";
  const auto isMark = [&](std::size_t i) {  // not the point of a number
    return kMarks.find(text_[i]) != std::string_view::npos &&
           (i + 1 >= range.end || text_[i + 1] == ' ');
  };
  if (isMark(at) || text_[at] == ')' || text_[at] == '(' || text_[at - 1] == '(') return true;
  return text_[at - 1] == ' ' && at >= 2 && at - 2 >= range.begin && isMark(at - 2);
}

/// Behind a letter, or as part of a path, an address or an option.
bool Reading::isWithinAName(std::size_t at, Range range) const {
  if (at == range.begin) return false;
  const char before = text_[at - 1];
  if (before == '-') return at - 1 == range.begin || !isLetterOrDigit(text_[at - 2]);
  return isLetterOrDigit(before) ||
         std::string_view("/\\_=.@").find(before) != std::string_view::npos;
}

/// Within an option, or one of a command's first two words: "palpa report trainee".
bool Reading::isTyped(std::size_t at) const {
  std::size_t from = at;
  while (from > 0 && (isLetterOrDigit(text_[from - 1]) || text_[from - 1] == '-')) --from;
  if (text_.substr(from, at - from).starts_with("--")) return true;
  for (int words = 0; words < 2 && from > 1 && text_[from - 1] == ' '; ++words) {
    const std::size_t end = --from;
    while (from > 0 && text_[from - 1] >= 'a' && text_[from - 1] <= 'z') --from;
    const bool begins =
        from == 0 || std::string_view(" (:\"").find(text_[from - 1]) != std::string_view::npos;
    if (begins && text_.substr(from, end - from) == "palpa") return true;
    if (from == end) return false;
  }
  return false;
}

/// A name that ends before `at` does not end there.
bool Reading::goesOn(std::size_t at, Range range) const {
  if (at == range.end) return false;
  if (isLetterOrDigit(text_[at])) return true;
  if (text_[at] == '.') return at + 1 < range.end && isLetterOrDigit(text_[at + 1]);
  return std::string_view("/\\_=@").find(text_[at]) != std::string_view::npos;
}

std::size_t Reading::tokenEnd(std::size_t at, Range range) const {
  if (!isLetterOrDigit(text_[at])) return at + 1;
  while (at < range.end && isLetterOrDigit(text_[at])) ++at;
  return at;
}

/// What stands fast in part `part` ends at `from`: what follows?
void Reading::follow(std::size_t part, std::size_t from, Trial* trial) {
  const Phrase& phrase = *trial->phrase;
  const auto& fixed = phrase.fixed;
  if (++effort_ > kMostEffort) return;
  if (part + 1 == fixed.size()) {
    const bool cut =
        !fixed[part].empty() && isLetterOrDigit(fixed[part].back()) && goesOn(from, trial->range);
    const int worth = trial->worth + trial->later[from - trial->range.begin].worth;
    if (!cut && worth > trial->best.worth)
      trial->best = {worth, trial->phrase, from, trial->put_in, trial->other_case};
    return;
  }
  // A plural's ending may be nothing at all, and so may a sentence that is only sometimes there.
  const bool may_be_empty = !fixed[part].empty() && fixed[part].back() != ' ';
  const std::size_t first = may_be_empty ? from : from + 1;
  const std::size_t last = std::min(trial->range.end, from + kLongestPutIn);
  const std::string& next = fixed[part + 1];
  int ends = 0;
  for (std::size_t end = first; end <= last && ends < kMostEnds; ++end) {
    const bool fits = next.empty() ? isBreak(end, trial->range) : standsAt(next, end, trial->range);
    if (!fits) continue;
    ++ends;
    putIn(part + 1, {from, end}, end + next.size(), trial);
  }
  if (next.empty() && last == trial->range.end && ends == kMostEnds)
    putIn(part + 1, {from, last}, last, trial);
}

void Reading::putIn(std::size_t part, Range what, std::size_t from, Trial* trial) {
  if (effort_ > kMostEffort) return;
  // To the end of all it is what stands there in any case.
  const int worth = what.end == trial->range.end
                        ? trial->later[what.begin - trial->range.begin].worth
                        : choices(what).front().worth;
  trial->worth += worth;
  trial->put_in.push_back(what);
  follow(part, from, trial);
  trial->put_in.pop_back();
  trial->worth -= worth;
}

void Reading::tryPhrase(const Phrase& phrase, std::size_t at, std::size_t head, Trial* trial) {
  const std::string& fixed = phrase.head();
  if (++effort_ > kMostEffort || trial->best.worth >= trial->most) return;
  const bool after_place = phrase.beginsWithAPlace();
  const bool exact = standsAt(fixed, head, trial->range);
  // A single word may be a command or a name: "Palpa" is not palpa.
  const bool begins = isBreak(head, trial->range) && lower(text_[head]) != text_[head];
  const bool may_differ = phrase.hasSeveralWords() || begins;
  const bool other = !exact && !after_place && may_differ && isLetter(fixed[0]) &&
                     lower(fixed[0]) == lower(text_[head]) &&
                     standsAt(std::string_view(fixed).substr(1), head + 1, trial->range);
  if (!exact && !other) return;
  trial->phrase = &phrase;
  trial->other_case = other;
  trial->worth = kALetter * phrase.letters - kAPhrase - (other ? kOtherCase : 0) -
                 kAPlace * static_cast<int>(phrase.fixed.size() - 1);
  trial->put_in.clear();
  if (after_place)
    putIn(1, {at, head}, head + fixed.size(), trial);
  else
    follow(0, head + fixed.size(), trial);
}

/// Phrases that begin at `at`, and what stands fast in them at `head`.
void Reading::tryAt(std::size_t at, std::size_t head, Trial* trial) {
  (at == head ? whole_ : behind_)
      .at(text_.substr(head, trial->range.end - head),
          [&](const Phrase& phrase) { tryPhrase(phrase, at, head, trial); });
}

Reading::Choice Reading::choiceAt(std::size_t at, Range range, const Choices& later) {
  const std::size_t end = tokenEnd(at, range);
  Trial trial{range, later, nullptr, false, 0, {}, {}, 0};
  const std::string_view rest = text_.substr(at, range.end - at);
  trial.most =
      kALetter * static_cast<int>(std::count_if(rest.begin(), rest.end(), isLetter)) - kAPhrase;
  trial.best = {later[end - range.begin].worth, nullptr, end, {}, false};
  if (isWithinAName(at, range) || isTyped(at)) return trial.best;
  if (range.begin == 0 && range.end == text_.size()) effort_ = 0;
  tryAt(at, at, &trial);
  if (!isBreak(at, range)) return trial.best;
  const std::size_t last = std::min(range.end, at + kLongestPutIn);
  for (std::size_t head = at + 1; head < last; ++head) {
    tryAt(at, head, &trial);
    if (text_[head] == ' ' && (text_[head - 1] == ';' || text_[head - 1] == '.')) break;
  }
  return trial.best;
}

const Reading::Choices& Reading::choices(Range range) {
  if (const auto found = known_.find(range); found != known_.end()) return found->second;
  Choices all(range.end - range.begin + 1);
  for (std::size_t at = range.end; at-- > range.begin;)
    all[at - range.begin] = choiceAt(at, range, all);
  return known_.emplace(range, std::move(all)).first->second;
}

std::string Reading::saidPhrase(const Choice& choice, const NumberForm& numbers) {
  std::string out;
  for (const Phrase::Piece& piece : choice.phrase->said)
    out += piece.place < 0 ? piece.text
                           : said(choice.put_in[static_cast<std::size_t>(piece.place)], numbers);
  if (!choice.other_case) return out;
  return isLetter(choice.phrase->head()[0]) && choice.phrase->head()[0] >= 'a'
             ? withCapital(out)
             : withoutCapital(out);
}

std::string Reading::said(Range range, const NumberForm& numbers) {
  const Choices& all = choices(range);
  std::string out, as_it_is;
  for (std::size_t at = range.begin; at < range.end;) {
    const Choice& choice = all[at - range.begin];
    if (!choice.phrase) {
      as_it_is += text_.substr(at, choice.next - at);
    } else {
      out += numbersIn(as_it_is, numbers) + saidPhrase(choice, numbers);
      as_it_is.clear();
    }
    at = choice.next;
  }
  return out + numbersIn(as_it_is, numbers);
}

namespace {

bool isDigit(char c) { return c >= '0' && c <= '9'; }
bool isOfAName(char c) {
  return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '_' || c == '/' || c == '\\';
}

/// Digits, points and commas from `at` on, without a mark at the end that is the sentence's.
std::string_view figureAt(std::string_view text, std::size_t at) {
  std::size_t end = at;
  while (end < text.size() && (isDigit(text[end]) || text[end] == '.' || text[end] == ',')) ++end;
  while (!isDigit(text[end - 1])) --end;
  return text.substr(at, end - at);
}

/// "1,250" or "12,500,000": groups of three behind one to three digits.
bool hasGroups(std::string_view whole) {
  const std::size_t first = whole.find(',');
  if (first == std::string_view::npos || first == 0 || first > 3) return false;
  for (std::size_t at = first; at < whole.size(); at += 4) {
    if (whole[at] != ',' || whole.size() - at < 4) return false;
    for (std::size_t i = 1; i < 4; ++i)
      if (!isDigit(whole[at + i])) return false;
  }
  return true;
}

std::string written(std::string_view figure, const NumberForm& form) {
  const std::size_t point = figure.find('.');
  const std::string_view whole = figure.substr(0, point);
  const bool has_tenths = point != std::string_view::npos;
  const std::string_view tenths = has_tenths ? figure.substr(point + 1) : std::string_view();
  const bool grouped = hasGroups(whole);
  if (tenths.find_first_of(".,") != std::string_view::npos ||
      (!grouped && whole.find(',') != std::string_view::npos))
    return std::string(figure);
  std::string out;
  for (const char c : whole) out += c == ',' ? form.group : std::string(1, c);
  if (has_tenths) out += form.point + std::string(tenths);
  return out;
}

}  // namespace

std::string numbersIn(std::string_view english, const NumberForm& form) {
  if (form == NumberForm()) return std::string(english);
  std::string out;
  for (std::size_t at = 0; at < english.size();) {
    if (!isDigit(english[at])) {
      out += english[at++];
      continue;
    }
    const std::string_view figure = figureAt(english, at);
    const std::size_t end = at + figure.size();
    const bool named = (at > 0 && (isOfAName(english[at - 1]) || english[at - 1] == '.')) ||
                       (end < english.size() && isOfAName(english[end]));
    out += named ? std::string(figure) : written(figure, form);
    at = end;
  }
  return out;
}

}  // namespace palpa::language

#pragma once

#include <map>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "apps/language/phrase.h"

namespace palpa::language {

/// How a language writes numbers. Files keep their point; this is for what people read.
struct NumberForm {
  std::string point = ".";  ///< between units and tenths
  std::string group = ",";  ///< between thousands

  bool operator==(const NumberForm&) const = default;
};

/// An English text with its numbers written so: "1,250.5 mm" -> "1.250,5 mm". Only numbers that
/// stand alone: no versions (1.2.3), no addresses, no names of files.
std::string numbersIn(std::string_view english, const NumberForm& form);

/// One English text, read as phrases: dynamic programming from its end to its beginning. `whole`
/// are the phrases that begin with what stands fast, `behind` those that begin with a place. At
/// most a hundred thousand comparisons at each place; what is left then is read as no phrase.
class Reading {
 public:
  Reading(std::string_view text, const PhraseIndex& whole, const PhraseIndex& behind)
      : text_(text), whole_(whole), behind_(behind) {}

  std::string said(const NumberForm& numbers) { return said({0, text_.size()}, numbers); }

 private:
  struct Range {
    std::size_t begin, end;
    bool operator<(const Range& other) const {
      return begin != other.begin ? begin < other.begin : end < other.end;
    }
  };
  /// What is best done at one place of the text.
  struct Choice {
    int worth = 0;                   ///< of everything from here on
    const Phrase* phrase = nullptr;  ///< nothing: what stands here is no phrase
    std::size_t next = 0;            ///< where it goes on
    std::vector<Range> put_in;
    bool other_case = false;  ///< its first letter is of the other case here
  };
  using Choices = std::vector<Choice>;  ///< for each byte of a range, and its end

  struct Trial;
  const Choices& choices(Range range);
  Choice choiceAt(std::size_t at, Range range, const Choices& later);
  void tryAt(std::size_t at, std::size_t head, Trial* trial);
  void tryPhrase(const Phrase& phrase, std::size_t at, std::size_t head, Trial* trial);
  void follow(std::size_t part, std::size_t from, Trial* trial);
  void putIn(std::size_t part, Range what, std::size_t from, Trial* trial);
  bool standsAt(std::string_view fixed, std::size_t at, Range range) const;
  bool isBreak(std::size_t at, Range range) const;
  bool isWithinAName(std::size_t at, Range range) const;
  bool isTyped(std::size_t at) const;
  bool goesOn(std::size_t at, Range range) const;
  std::size_t tokenEnd(std::size_t at, Range range) const;
  std::string said(Range range, const NumberForm& numbers);
  std::string saidPhrase(const Choice& choice, const NumberForm& numbers);

  const std::string_view text_;
  const PhraseIndex& whole_;
  const PhraseIndex& behind_;
  std::map<Range, Choices> known_;
  int effort_ = 0;
};

}  // namespace palpa::language

#pragma once

#include <algorithm>
#include <cstddef>
#include <map>
#include <string>
#include <string_view>
#include <vector>

namespace palpa::language {

/// One message: what stands fast in it, between the places {1}, {2} ... of what is put in.
struct Phrase {
  /// Throws UsageError.
  Phrase(const std::string& id, const std::string& translation);

  std::vector<std::string> fixed;  ///< one more than places; the first and the last may be empty
  struct Piece {
    std::string text;
    int place = -1;  ///< of these, instead of a text
  };
  std::vector<Piece> said;
  int letters = 0;  ///< in all that stands fast

  bool beginsWithAPlace() const { return fixed.front().empty(); }
  bool endsWithAPlace() const { return fixed.back().empty(); }
  bool hasSeveralWords() const {
    return fixed.size() > 1 || fixed[0].find(' ') != std::string::npos;
  }
  /// What stands fast first.
  const std::string& head() const { return fixed[beginsWithAPlace() ? 1 : 0]; }
};

/// Phrases by how what stands fast in them begins; upper and lower case are one.
class PhraseIndex {
 public:
  void add(const Phrase& phrase);
  /// When all are there: of those that begin alike the longest first.
  void sort();
  /// Calls `look` with all that may stand at the beginning of `text`.
  template <class Look>
  void at(std::string_view text, const Look& look) const {
    for (std::size_t length = std::min(text.size(), kBeginning); length > 0; --length)
      if (const auto found = by_beginning_.find(beginning(text, length));
          found != by_beginning_.end())
        for (const Phrase* phrase : found->second) look(*phrase);
  }

 private:
  static constexpr std::size_t kBeginning = 3;  ///< bytes that are looked up
  static std::string beginning(std::string_view text, std::size_t length);
  std::map<std::string, std::vector<const Phrase*>, std::less<>> by_beginning_;
};

/// A UTF-8 text with a capital first letter, or without one: Latin and Greek; others have none.
std::string withCapital(const std::string& text);
std::string withoutCapital(const std::string& text);
/// Of a terminal that a UTF-8 text takes: two for a Korean or Chinese letter.
int columnsOf(std::string_view text);
bool isLetter(char c);
bool isLetterOrDigit(char c);
char lower(char c);

}  // namespace palpa::language

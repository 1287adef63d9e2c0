#include "anatomy/base/nearest_word.h"

#include <algorithm>
#include <array>
#include <vector>

namespace palpa {
namespace {

constexpr std::size_t kLongestWord = 100;
constexpr std::size_t kShortestBeginning = 3;
constexpr int kWholeChange = 4, kSlightChange = 1;

/// Capitals as small letters, "_" as "-".
char folded(char c) {
  if (c == '_') return '-';
  return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
}

int costOf(char a, char b) {
  if (a == b) return 0;
  return folded(a) == folded(b) ? kSlightChange : kWholeChange;
}

/// Four times the changes that make `b` of `a`.
int changes(std::string_view a, std::string_view b) {
  // Rows of the table of distances between beginnings: the last but one, the last, this one.
  std::array<std::vector<int>, 3> rows;
  for (std::vector<int>& row : rows) row.resize(b.size() + 1);
  for (std::size_t j = 0; j <= b.size(); ++j) rows[1][j] = static_cast<int>(j) * kWholeChange;
  for (std::size_t i = 1; i <= a.size(); ++i) {
    rows[2][0] = static_cast<int>(i) * kWholeChange;
    for (std::size_t j = 1; j <= b.size(); ++j) {
      rows[2][j] = std::min({rows[1][j] + kWholeChange, rows[2][j - 1] + kWholeChange,
                             rows[1][j - 1] + costOf(a[i - 1], b[j - 1])});
      if (i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1])
        rows[2][j] = std::min(rows[2][j], rows[0][j - 2] + kWholeChange);
    }
    std::rotate(rows.begin(), rows.begin() + 1, rows.end());
  }
  return rows[1][b.size()];
}

/// One change in any word of two letters and more, then a third of the letters.
int most(std::string_view typed, std::string_view word) {
  const std::size_t letters = std::max(typed.size(), word.size());
  if (letters < 2) return kSlightChange;
  return kWholeChange * static_cast<int>(std::max<std::size_t>(1, letters / 3));
}

std::optional<std::string> onlyOneThatBegins(std::string_view typed,
                                             std::span<const std::string> known) {
  std::optional<std::string> one;
  if (typed.size() < kShortestBeginning) return one;
  for (const std::string& word : known) {
    if (!word.starts_with(typed)) continue;
    if (one) return std::nullopt;
    one = word;
  }
  return one;
}

}  // namespace

std::optional<std::string> nearestWord(std::string_view typed, std::span<const std::string> known) {
  if (typed.empty() || typed.size() > kLongestWord) return std::nullopt;
  std::optional<std::string> nearest;
  int least = 0;
  for (const std::string& word : known) {
    if (word.empty() || word.size() > kLongestWord) continue;
    const int here = changes(typed, word);
    if (here > most(typed, word) || (nearest && here >= least)) continue;
    nearest = word;
    least = here;
  }
  return nearest ? nearest : onlyOneThatBegins(typed, known);
}

std::string didYouMean(std::string_view typed, std::span<const std::string> known,
                       std::string_view mark) {
  const std::optional<std::string> meant = nearestWord(typed, known);
  if (!meant) return "";
  return " (did you mean " + std::string(mark) + *meant + std::string(mark) + "?)";
}

}  // namespace palpa

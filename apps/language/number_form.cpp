#include "apps/language/number_form.h"

namespace palpa::language {
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

#include "apps/report/page/numbers.h"

#include <algorithm>
#include <charconv>
#include <cmath>

namespace palpa::report {
namespace {

std::string plain(double value, int decimals) {
  char text[400];  // the largest double has 309 digits before the point
  const auto end =
      std::to_chars(text, text + sizeof(text), value, std::chars_format::fixed, decimals);
  std::string digits(text, end.ptr);
  const bool zero = digits.find_first_of("123456789") == std::string::npos;
  return zero && digits[0] == '-' ? digits.substr(1) : digits;
}

void dropTrailingZeros(std::string& digits) {
  if (digits.find('.') == std::string::npos) return;
  digits.erase(digits.find_last_not_of('0') + 1);
  if (digits.back() == '.') digits.pop_back();
}

/// Minus sign U+2212, and U+202F between thousands from 10 000 on.
std::string dressed(const std::string& digits) {
  const bool negative = digits[0] == '-';
  const std::size_t start = negative ? 1 : 0;
  const std::size_t point = std::min(digits.find('.'), digits.size());
  const std::size_t whole = point - start;
  std::string text = negative ? "\u2212" : "";
  for (std::size_t i = start; i < digits.size(); ++i) {
    if (whole > 4 && i > start && i < point && (point - i) % 3 == 0) text += "\u202f";
    text += digits[i];
  }
  return text;
}

}  // namespace

std::string shortest(double value) {
  char text[32];
  return {text, std::to_chars(text, text + sizeof(text), value).ptr};
}

std::string fixed(double value, int decimals) {
  return std::isfinite(value) ? dressed(plain(value, decimals)) : "–";
}

std::string trimmed(double value, int decimals) {
  if (!std::isfinite(value)) return "–";
  std::string digits = plain(value, decimals);
  dropTrailingZeros(digits);
  return dressed(digits);
}

std::string coordinate(double value) {
  std::string digits = plain(std::isfinite(value) ? value : 0, 1);
  dropTrailingZeros(digits);
  return digits;
}

}  // namespace palpa::report

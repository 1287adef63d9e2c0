#include "apps/study/analysis/exhibit.h"

#include <algorithm>
#include <charconv>
#include <cmath>

namespace palpa::study_analysis {

std::string number(double value, int decimals) {
  if (!std::isfinite(value)) return "–";
  char text[400];  // the largest double has 309 digits before the point
  const auto end =
      std::to_chars(text, text + sizeof text, value, std::chars_format::fixed, decimals);
  std::string digits(text, end.ptr);
  if (digits[0] == '-' && digits.find_first_of("123456789") == std::string::npos)
    digits.erase(0, 1);
  return digits[0] == '-' ? "\u2212" + digits.substr(1) : digits;
}

std::string percent(double share) { return number(100 * share, 0) + " %"; }

std::string pWords(double p) {
  if (!std::isfinite(p)) return "p: none";
  return p < 0.001 ? "p < 0.001" : "p = " + number(p, 3);
}

std::string joined(const std::vector<std::string>& parts, const std::string& last) {
  std::string text;
  for (std::size_t i = 0; i < parts.size(); ++i)
    text += (i == 0 ? "" : i + 1 == parts.size() ? last : ", ") + parts[i];
  return text;
}

std::string capitalised(std::string text) {
  if (!text.empty() && text[0] >= 'a' && text[0] <= 'z')
    text[0] = static_cast<char>(text[0] - 'a' + 'A');
  return text;
}

int decimalsFor(double value) {
  const double size = std::abs(value);
  return size >= 100 || !std::isfinite(size) ? 0 : size >= 10 ? 1 : size >= 1 ? 2 : 3;
}

void addOnce(std::vector<std::string>& list, const std::string& text) {
  if (std::find(list.begin(), list.end(), text) == list.end()) list.push_back(text);
}

}  // namespace palpa::study_analysis

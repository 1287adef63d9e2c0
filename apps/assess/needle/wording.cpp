#include "apps/assess/needle/wording.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>

namespace palpa::assess {
namespace {

std::string number(double value, int decimals) {
  char text[48];
  std::snprintf(text, sizeof text, "%.*f", decimals, value);
  return text;
}

}  // namespace

std::string millimetres(double metres) { return number(1000 * metres, 1) + " mm"; }

std::string degrees(double radians) {
  const double deg = radians * 180 / M_PI;
  return number(deg, std::abs(deg) < 2 ? 1 : 0) + "°";
}

std::string seconds(double s) { return number(s, s < 0.1 ? 2 : 1) + " s"; }
std::string newtons(double n) { return number(n, 1) + " N"; }

std::string counted(int n, const std::string& one, const std::string& many) {
  return std::to_string(n) + " " + (n == 1 ? one : many);
}

std::string duration(const std::vector<Interval>& stretches) {
  if (stretches.empty()) return "never";
  const std::string held = "for " + seconds(heldTime(stretches));
  const std::string start = "at " + seconds(stretches.front().from_s);
  if (stretches.size() == 1) return held + " " + start;
  return held + " in " + std::to_string(stretches.size()) + " contacts, first " + start;
}

std::string offsetWords(const Vec3& offset_L) {
  static constexpr const char* kPositive[] = {"too medial", "too deep to the back", "too cephalad"};
  static constexpr const char* kNegative[] = {"too lateral", "too far forward", "too caudal"};
  std::array<int, 3> order{0, 1, 2};
  std::stable_sort(order.begin(), order.end(),
                   [&](int a, int b) { return std::abs(offset_L[a]) > std::abs(offset_L[b]); });
  std::string words;
  for (const int i : order) {
    if (std::abs(offset_L[i]) < 0.0005) continue;
    words += (words.empty() ? " (" : ", ") + millimetres(std::abs(offset_L[i])) + " " +
             (offset_L[i] > 0 ? kPositive[i] : kNegative[i]);
  }
  return words.empty() ? words : words + ")";
}

std::string list(const std::vector<std::string>& parts) {
  std::string words;
  for (std::size_t i = 0; i < parts.size(); ++i)
    words += (i == 0 ? "" : i + 1 == parts.size() ? " and " : ", ") + parts[i];
  return words;
}

}  // namespace palpa::assess

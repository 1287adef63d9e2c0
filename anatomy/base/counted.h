#pragma once

#include <concepts>
#include <string>

/// Counts in words: "1 trial", not "1 trials".
namespace palpa {

/// "1 trial", "3 trials". `one`: a noun whose plural ends in s.
std::string counted(std::integral auto count, const std::string& one) {
  std::string words = std::to_string(count);
  words.append(" ").append(one);
  if (count != 1) words.append("s");
  return words;
}

/// "once", "0 times", "3 times".
std::string howOften(std::integral auto count) {
  return count == 1 ? "once" : counted(count, "time");
}

}  // namespace palpa

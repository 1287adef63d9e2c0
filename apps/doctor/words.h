#pragma once

#include <cstdio>
#include <string>

namespace palpa::doctor {

/// As printf, at most 191 bytes: for figures within a verdict.
template <class... Numbers>
std::string text(const char* pattern, Numbers... numbers) {
  char line[192];
  std::snprintf(line, sizeof line, pattern, numbers...);
  return line;
}

}  // namespace palpa::doctor

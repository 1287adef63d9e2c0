#pragma once

#include <cstdio>
#include <string>
#include <vector>

/// Is a station well? Each question is asked of the world in one place and judged in another, so
/// that every fault can be put before the judge.
namespace palpa::doctor {

/// absent: this station has none, and needs none. note: a session can start, but something should
/// be done. ill: no session can.
enum class State { well, absent, note, ill };

/// What was found about one thing, for whoever stands beside it.
struct Finding {
  std::string subject;  ///< "camera"
  State state = State::well;
  std::string verdict;   ///< "15.0 pictures a second, in focus"
  std::string fix = {};  ///< what to do; empty where nothing is to be done
};
using Findings = std::vector<Finding>;

/// "well", "none", "note", "ill".
const char* name(State state);

/// Nothing is ill.
bool canStart(const Findings& findings);

/// An error's words as a finding; the last sentence of an Error is what to do.
Finding troubled(const std::string& subject, State state, const std::string& error);

/// As JSON: {"can_start": true, "findings": [{"subject", "state", "verdict", "fix"}]}.
std::string toJson(const Findings& findings);

/// As printf, at most 191 bytes: for figures within a verdict.
template <class... Numbers>
std::string text(const char* pattern, Numbers... numbers) {
  char line[192];
  std::snprintf(line, sizeof line, pattern, numbers...);
  return line;
}

}  // namespace palpa::doctor

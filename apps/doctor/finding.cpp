#include "apps/doctor/finding.h"

#include <algorithm>
#include <nlohmann/json.hpp>

namespace palpa::doctor {

const char* name(State state) {
  switch (state) {
    case State::well:
      return "well";
    case State::absent:
      return "none";
    case State::note:
      return "note";
    case State::ill:
      return "ill";
  }
  return "";
}

bool canStart(const Findings& findings) {
  return std::none_of(findings.begin(), findings.end(),
                      [](const Finding& f) { return f.state == State::ill; });
}

Finding troubled(const std::string& subject, State state, const std::string& error) {
  const std::size_t end = error.find(". ");
  if (end == std::string::npos)
    return {subject, state, error, "Look at what is named, then ask again"};
  return {subject, state, error.substr(0, end), error.substr(end + 2)};
}

std::string toJson(const Findings& findings) {
  nlohmann::json list = nlohmann::json::array();
  for (const Finding& f : findings)
    list.push_back(
        {{"subject", f.subject}, {"state", name(f.state)}, {"verdict", f.verdict}, {"fix", f.fix}});
  return nlohmann::json{{"can_start", canStart(findings)}, {"findings", list}}.dump(
      2, ' ', false, nlohmann::json::error_handler_t::replace);
}

}  // namespace palpa::doctor

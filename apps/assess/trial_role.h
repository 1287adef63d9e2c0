#pragma once

#include <string>

namespace palpa::assess {

/// Whether a trial of this role counts: a practice trial that is scored, or one in assessment,
/// where every aid is off.
inline bool countsAsScored(const std::string& role) {
  return role == "scored" || role == "assessed";
}

/// No aid is shown or felt.
inline bool inAssessment(const std::string& role) { return role == "assessed"; }

}  // namespace palpa::assess

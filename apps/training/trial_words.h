#pragma once

#include <cstdint>
#include <string>
#include <string_view>

namespace palpa::training {

/// What a trial is for. Records, tables and pages hold the names that `nameOf` gives.
enum class Role : std::uint8_t {
  none,             ///< "": not told
  scored,           ///< "scored"
  assessed,         ///< "assessed": every aid is off
  familiarisation,  ///< "familiarisation"
  demonstration,    ///< "demonstration"
  guided,           ///< "guided": something on the screen leads the hand
  not_scored        ///< "not scored": the station is not calibrated, for one
};

/// How a trial ended.
enum class Outcome : std::uint8_t {
  none,       ///< "": it has not ended
  success,    ///< "success": the goal was reached
  done,       ///< "done": the trainee has searched, answered, chosen
  time,       ///< "time": the limit was reached
  passes,     ///< "passes": one pass of the needle too many
  mistaken,   ///< "mistaken": what was aspirated was not told, or told wrong
  aborted,    ///< "aborted"
  voided,     ///< "void": does not count
  not_scored  ///< "not scored"
};

const std::string& nameOf(Role role);
const std::string& nameOf(Outcome outcome);

/// Of a recorded text. A role that is not known counts for nothing: `not_scored`.
Role roleNamed(std::string_view name);
/// Of a recorded text; `none` for one that is not known.
Outcome outcomeNamed(std::string_view name);

/// Of a recorded text: the trial does not count.
bool isVoid(std::string_view outcome);

/// Whether a trial of this role counts: a practice trial that is scored, or one in assessment.
bool countsAsScored(Role role);
/// And it was not taken out.
bool countsAsScored(Role role, Outcome outcome);

/// No aid is shown or felt.
bool inAssessment(Role role);

}  // namespace palpa::training

#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

/// What the store keeps, as plain values. Times are UTC, ISO 8601 to the second; dates
/// "2027-03-01".
namespace palpa::record {

/// Somebody who trains, known by a pseudonym; the list that tells names stays with the educator, on
/// paper.
struct Trainee {
  std::string id;                    ///< 1 to 32 letters, digits, - or _
  std::string group;                 ///< "novice", "experienced", ...: the educator's words
  std::string experience;            ///< "3rd year", "50 lines", ...
  std::string handedness = "right";  ///< "right", "left"
  std::string added_utc;
  std::string consent_utc;   ///< to keeping training records; empty: not given
  std::string research_utc;  ///< to use in studies; empty: not given
  std::string retain_until;  ///< a date; empty: no limit was set
};

struct StoredCalibration {
  std::string name;  ///< "registration", "tool", ...
  std::string made_utc, sha256, verdict;
};

/// A session of a trainee: where its evidence is, and what it was made with.
struct StoredSession {
  std::string uuid;
  std::string trainee;
  std::int64_t arrival = 0;  ///< 1, 2, ... of this trainee: the order in which sessions came,
                             ///< whatever clocks said; 0: not yet stored
  std::string started_utc;
  std::string software, task, station;
  bool simulated = false;
  std::string study;      ///< empty: none
  std::int64_t slot = 0;  ///< of the trainee's way through the study
  std::string evidence;   ///< path of session.palpa where it was made
  std::string evidence_sha256;
  std::string facts_json;  ///< what the session said of itself: operator, side, augmentation, ...
  std::vector<StoredCalibration> calibrations;
};

struct Metric {
  std::string name;  ///< as in the table of metrics
  double value = 0;  ///< not a number: does not apply to this trial
};

struct StoredEvent {
  std::int64_t t_ns = 0;  ///< session time
  std::string kind, text;
  double value = 0;
};

struct StoredTrial {
  std::int64_t number = 0;                ///< 1, 2, ... in its session
  std::int64_t start_ns = 0, end_ns = 0;  ///< session time
  std::string role;                       ///< "scored", "familiarisation", ...
  std::uint64_t seed = 0;
  bool force_feedback = true;
  std::string outcome, reason;
  bool success = false;
  std::string score_json;  ///< as the evidence has it
  std::vector<Metric> metrics;
  std::vector<StoredEvent> events;
  double metric(const std::string& name) const;  ///< not a number where it has none of that name
};

}  // namespace palpa::record

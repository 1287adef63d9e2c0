#pragma once

#include <limits>
#include <string>

#include "tests/store/trials.h"

/// Trials as the records of a centre hold them.
namespace palpa::link_test {

inline record::Trainee person(const std::string& id, bool agreed = true) {
  const std::string when = agreed ? "2026-03-01T09:00:00Z" : "";
  return {id,   "novice",    "3rd year, left \"early\"", "left", "2026-03-01T09:00:00Z", when,
          when, "2027-03-01"};
}

/// 32 hexadecimal digits of a UUID whose last ones are `n`.
inline std::string uuidOf(int n) {
  const std::string digits = std::to_string(n);
  return "0a1b2c3d-4e5f-4a6b-8c7d-" + std::string(12 - digits.size(), '0') + digits;
}

inline record::StoredSession sessionOf(const std::string& trainee, int n, bool simulated = false) {
  record::StoredSession s = record::sessionOf(trainee, uuidOf(n));
  s.simulated = simulated;
  s.evidence = "/home/somebody/out/session.palpa";
  s.facts_json =
      R"({"operator":"person","trainee":"X","study":{"id":"pilot","group":"FF","condition":"with"}})";
  return s;
}

inline record::StoredTrial trialOf(int number, double total = 913.24) {
  record::StoredTrial t = record::trialOf(number, total);
  t.start_ns = number * 100'000'000'000;
  t.end_ns = t.start_ns + 31'524'000'000;
  t.metrics = {{"total", total},
               {"time_s", 31.524},
               {"success", 1},
               {"closest_artery_mm", std::numeric_limits<double>::quiet_NaN()}};
  t.events = {{5'000'000'000, "puncture", "The skin was punctured, at 5 s", 1.5}};
  return t;
}

}  // namespace palpa::link_test

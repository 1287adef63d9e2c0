#pragma once

#include <limits>
#include <string>

#include "apps/record/store/record_store.h"

/// People, sessions and trials as tests store them.
namespace palpa::record {

inline Trainee novice(const std::string& id) {
  return {id, "novice",    "3rd year", "right", "2026-03-01T10:00:00Z", "2026-03-01T10:00:00Z",
          "", "2027-03-01"};
}

inline StoredSession sessionOf(const std::string& trainee, const std::string& uuid) {
  StoredSession s;
  s.uuid = uuid;
  s.trainee = trainee;
  s.started_utc = "2026-03-01T10:00:00Z";
  s.software = "palpa 1";
  s.task = "paracentesis";
  s.station = "virtual bench";
  s.evidence = "/somewhere/" + uuid + "/session.palpa";
  s.evidence_sha256 = std::string(64, 'a');
  s.facts_json = R"({"operator":"person"})";
  s.calibrations = {{"tool", "2026-02-01T08:00:00Z", std::string(64, 'b'), "pass"}};
  return s;
}

inline StoredTrial trialOf(std::int64_t number, double total = 913.24) {
  StoredTrial t;
  t.number = number;
  t.start_ns = number * 1'000'000'000;
  t.end_ns = t.start_ns + 31'524'000'000;
  t.role = "scored";
  t.seed = 0xfedcba9876543210u;
  t.outcome = "success";
  t.success = true;
  t.score_json = R"({"TOTAL":913.24})";
  t.metrics = {{"closest_artery", std::numeric_limits<double>::quiet_NaN()}, {"total", total}};
  t.events = {{5, "puncture", "The skin was punctured", 1.5},
              {9, "note", "It's a note: ü", std::numeric_limits<double>::quiet_NaN()}};
  return t;
}

}  // namespace palpa::record

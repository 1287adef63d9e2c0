#pragma once

#include <gtest/gtest.h>

#include <cstdlib>
#include <nlohmann/json.hpp>

#include "apps/record/store/record_store.h"
#include "program.h"

namespace palpa::cli_test {

inline const std::string kShipped = PALPA_SOURCE_DIR "/assets";

inline nlohmann::json protocolText() {
  const std::string task = kShipped + "/tasks/paracentesis.json";
  return {
      {"version", 1},
      {"id", "small"},
      {"title", "A small study"},
      {"source", "made up"},
      {"groups",
       {{{"name", "novice"}, {"means", "new"}}, {{"name", "experienced"}, {"means", "old"}}}},
      {"conditions",
       {{{"name", "FF"}, {"means", "felt"}},
        {{"name", "NO"}, {"means", "not felt"}, {"sets", {{"force_feedback", false}}}}}},
      {"allocation", {{"conditions", {"FF", "NO"}}, {"block", 2}}},
      {"trial_seed", 40},  // that and the next are short trials
      {"sessions",
       {{{"name", "only"},
         {"blocks", {{{"name", "trials"}, {"task", task}, {"trials", 2}, {"condition", "drawn"}}}},
         {"questionnaire", kShipped + "/protocols/questionnaires/paracentesis_pilot.json"}}}}};
}

class Study : public testing::Test {
 protected:
  Study() { ::setenv("XDG_STATE_HOME", here.path().c_str(), 1); }  // what waits is kept there
  ~Study() override { ::unsetenv("XDG_STATE_HOME"); }

  Outcome run(const std::vector<std::string>& more, const std::string& records = "records.sqlite") {
    std::vector<std::string> words{
        "study", "run",   "--protocol", "protocol.json", "--records",
        records, "--out", "out",        "--station",     quickStation("virtual_bench.json")};
    words.insert(words.end(), more.begin(), more.end());
    return palpa(words, here.path());
  }
  Outcome runTrainee(std::vector<std::string> more = {},
                     const std::string& records = "records.sqlite") {
    for (const char* word :
         {"--trainee", "T001", "--operator", "expert", "--fast", "--no-views", "--quiet"})
      more.emplace_back(word);
    return run(more, records);
  }
  Outcome status() {
    return palpa({"study", "status", "--protocol", "protocol.json", "--records", "records.sqlite"},
                 here.path());
  }
  void addTrainee(const std::string& id, const std::string& group, bool research = true) {
    std::vector<std::string> words{"records",   "trainee",       "add", "--id",
                                   id,          "--group",       group, "--consent",
                                   "--records", "records.sqlite"};
    if (research) words.emplace_back("--research");
    ASSERT_EQ(palpa(words, here.path()).exit_code, 0);
  }
  record::RecordStore store() { return record::RecordStore((here / "records.sqlite").string()); }

  const Folder here;
  const std::string protocol = here.file("protocol.json", protocolText().dump());
  const std::string answers = here.file(
      "answers.json",
      R"({"useful": 4, "needed": 5, "skin_real": 2, "bone_real": 3, "seen_real": 3, "learned": 4, "tiring": 1, "remarks": "fine"})");
};

}  // namespace palpa::cli_test

#pragma once

#include <gtest/gtest.h>

#include <fstream>
#include <functional>
#include <nlohmann/json.hpp>
#include <string>

#include "anatomy/base/error.h"
#include "apps/study/protocol.h"
#include "tests/support/files.h"

namespace palpa::study {

/// Two groups, two conditions drawn, a third that is not; two sessions, the first of two blocks,
/// the second with a questionnaire.
inline nlohmann::json smallProtocol() {
  return nlohmann::json::parse(R"({
    "version": 1, "id": "small", "title": "A small study", "source": "made up",
    "groups": [{"name": "novice", "means": "new"}, {"name": "experienced", "means": "old"}],
    "always": {"navigation": false},
    "conditions": [{"name": "A", "means": "felt", "sets": {"force_feedback": true}}, {"name": "B", "means": "not felt", "sets": {"force_feedback": false}}, {"name": "plain", "means": "as ever"}],
    "allocation": {"conditions": ["A", "B"], "block": 4},
    "trial_seed": 7,
    "sessions": [
      {"name": "first", "blocks": [
        {"name": "try", "task": "task.json", "role": "familiarisation", "trials": 1, "condition": "plain", "rest_s": 60},
        {"name": "train", "task": "task.json", "trials": 5, "condition": "drawn", "rest_after": 2, "rest_s": 100}]},
      {"name": "second", "days_after": 2, "blocks": [{"name": "test", "task": "task.json", "trials": 2, "condition": "plain"}], "questionnaire": "questions.json"}
    ]})");
}

inline nlohmann::json smallQuestionnaire() {
  return nlohmann::json::parse(
      R"({"version": 1, "id": "after", "title": "After it", "source": "made up", "items": [
    {"id": "useful", "kind": "likert", "points": 5, "question": "Was it useful?", "low": "no", "high": "yes"},
    {"id": "remarks", "kind": "text", "question": "Anything else?", "may_be_left": true}]})");
}

/// The file, with its task and questionnaire beside it.
inline std::filesystem::path written(const nlohmann::json& protocol,
                                     const nlohmann::json& questionnaire = smallQuestionnaire()) {
  const auto* test = testing::UnitTest::GetInstance()->current_test_info();
  const auto folder =
      test::freshFolder("study", std::string(test->test_suite_name()) + "-" + test->name());
  std::ofstream(folder / "task.json") << R"({"version": 1, "engine": "needle"})";
  std::ofstream(folder / "questions.json") << questionnaire.dump();
  std::ofstream(folder / "protocol.json") << protocol.dump();
  return folder / "protocol.json";
}

inline std::string complaintOf(const std::function<void()>& action) {
  try {
    action();
  } catch (const UsageError& e) {
    return e.what();
  }
  return "";
}

}  // namespace palpa::study

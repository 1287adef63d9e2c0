#include <gtest/gtest.h>

#include <map>
#include <set>

#include "apps/record/store/study_store.h"
#include "study_bench.h"

/// A protocol filled with virtual trainees.
namespace palpa::cli_test {
namespace {

using nlohmann::json;

/// The same people, however many there are of them and whoever works on them.
TEST_F(Study, VirtualTraineesFillAProtocol) {
  const auto simulate = [&](const std::string& records, const std::string& each,
                            const std::string& workers, const std::string& out) {
    return palpa({"study", "run", "--protocol", "protocol.json", "--simulate", each, "--learning",
                  "learners.json", "--seed", "3", "--workers", workers, "--records", records,
                  "--station", quickStation("virtual_bench.json"), "--out", out, "--quiet"},
                 here.path());
  };
  const auto group = [](const char* name, double start) {
    return json{{"name", name},   {"subjects", 9},     {"start", start},        {"start_sd", 0.05},
                {"asymptote", 1}, {"asymptote_sd", 0}, {"rate_per_trial", 0.3}, {"rate_sd", 0.1}};
  };
  here.file("learners.json",
            json{{"version", 1},
                 {"id", "few"},
                 {"title", "Few"},
                 {"planted", "nothing much"},
                 {"engine", "needle"},
                 {"from", kShipped + "/operators/novice.json"},
                 {"to", kShipped + "/operators/expert.json"},
                 {"groups", {group("novice", 0.5), group("experienced", 0.9)}},
                 {"conditions",
                  {{{"name", "FF"}, {"rate_times", 1}}, {{"name", "NO"}, {"rate_times", 0.5}}}}}
                .dump());
  json text = protocolText();
  text["sessions"][0]["blocks"][0]["trials"] = 1;
  here.file("protocol.json", text.dump());
  const Outcome two = simulate("two.sqlite", "2", "2", "A"),
                one = simulate("one.sqlite", "1", "1", "B");
  ASSERT_EQ(two.exit_code, 0) << two.err;
  ASSERT_EQ(one.exit_code, 0) << one.err;
  EXPECT_TRUE(says(two.out, "Simulated: 4 trainees with 1 ")) << two.out;
  EXPECT_EQ(simulate("two.sqlite", "2", "2", "A").exit_code, 0);  // all is done: nothing is added
  record::RecordStore a((here / "two.sqlite").string()), b((here / "one.sqlite").string());
  const auto trials = a.trials({.study = "small"}), same = b.trials({.study = "small"});
  ASSERT_EQ(trials.size(), 4u);
  ASSERT_EQ(same.size(), 2u);
  for (const std::size_t i : {0u, 1u})  // the first of each group
    EXPECT_EQ(trials[2 * i].trial.score_json, same[i].trial.score_json);
  std::map<std::string, int> conditions;
  std::set<double> totals;
  for (std::size_t i = 0; i < trials.size(); ++i) {
    EXPECT_TRUE(trials[i].session.simulated);
    const json facts = json::parse(trials[i].session.facts_json);
    EXPECT_EQ(facts.at("operator"), "learner");
    EXPECT_EQ(facts.at("simulated"), true);
    ++conditions[facts.at("study").at("group").get<std::string>() +
                 facts.at("study").at("condition").get<std::string>()];
    totals.insert(trials[i].trial.metric("total"));
  }
  EXPECT_EQ(conditions.size(), 4u);  // balanced: one of two of each group in each condition
  EXPECT_EQ(totals.size(), 4u);      // no two people's trials are alike
  for (const auto& e : record::StudyStore(a).enrolments("small")) EXPECT_TRUE(e.simulated);
  for (const auto& t : a.trainees()) EXPECT_EQ(t.experience, "simulated");
}

}  // namespace
}  // namespace palpa::cli_test

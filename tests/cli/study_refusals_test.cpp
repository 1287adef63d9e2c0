#include <gtest/gtest.h>

#include "apps/record/store/study_store.h"
#include "study_bench.h"

/// What a study refuses, and what it does not tell.
namespace palpa::cli_test {
namespace {

using nlohmann::json;

TEST_F(Study, RefusesWhoCannotTakePart) {
  const auto refused = [&](const char* words) {
    const Outcome outcome = runTrainee();
    EXPECT_EQ(outcome.exit_code, 2) << outcome.out;
    EXPECT_EQ(outcome.errLines(), 1) << outcome.err;
    EXPECT_TRUE(says(outcome.err, words)) << outcome.err;
  };
  refused("is not in the records");
  addTrainee("T001", "novice", false);
  refused("has not agreed to studies");
  ASSERT_EQ(palpa({"records", "trainee", "change", "--id", "T001", "--research", "--group",
                   "surgeon", "--records", "records.sqlite"},
                  here.path())
                .exit_code,
            0);
  refused("not one of the study's");
  ASSERT_EQ(palpa({"records", "trainee", "change", "--id", "T001", "--group", "novice", "--records",
                   "records.sqlite"},
                  here.path())
                .exit_code,
            0);
  json text = protocolText();
  text["excluded"] = json::array({"T001"});
  here.file("protocol.json", text.dump());
  refused("excluded by the protocol");
  // An expert whose trials made the task's expert path.
  json path = json::parse(contentOf(kShipped + "/tasks/paracentesis_expert_path.json")),
       task = json::parse(contentOf(kShipped + "/tasks/paracentesis.json"));
  path["experts"].push_back("T001");
  here.file("paracentesis_expert_path.json", path.dump());
  task["materials"] = kShipped + "/materials/needle.json";
  here.file("task.json", task.dump());
  text = protocolText();
  text["sessions"][0]["blocks"][0]["task"] = "task.json";
  here.file("protocol.json", text.dump());
  refused("made the expert path");
  text["conditions"][0]["name"] = "GG";
  here.file("protocol.json", text.dump());
  refused("\"FF\", which is not one of the protocol's conditions");
  EXPECT_TRUE(
      record::StudyStore(*std::make_unique<record::RecordStore>((here / "records.sqlite").string()))
          .enrolments("small")
          .empty());
}

/// Before anybody is enrolled.
TEST_F(Study, OfVirtualTraineesRefusesAFilmOfWhatNoPictureShows) {
  here.file("protocol.json", protocolText().dump());
  const Outcome outcome =
      palpa({"study", "run", "--protocol", "protocol.json", "--simulate", "1", "--learning",
             kShipped + "/protocols/learners/paracentesis_learners.json", "--tracking", "model",
             "--record-video", "--records", "records.sqlite"},
            here.path());
  EXPECT_EQ(outcome.exit_code, 2) << outcome.out;
  EXPECT_TRUE(says(outcome.err, "--record-video with --tracking model")) << outcome.err;
  EXPECT_FALSE(std::filesystem::exists(here / "records.sqlite"));
}

/// The path's file keeps the pseudonyms of those who made it.
TEST_F(Study, ExpertsAreKnownByTheirPseudonyms) {
  ASSERT_EQ(palpa(session({"--seed", kShortTrial, "--trainee", "E01", "--out", "E"}), here.path())
                .exit_code,
            0);
  const Outcome made =
      palpa({"calibrate", "experts", "--from", "E/session.palpa", "E/session.palpa",
             "E/session.palpa", "--least", "3", "--out", "path.json"},
            here.path());
  ASSERT_EQ(made.exit_code, 0) << made.err;
  EXPECT_EQ(json::parse(contentOf(here / "path.json")).at("experts"), json::array({"E01"}));
}

TEST_F(Study, AChangedProtocolIsAnotherStudy) {
  json text = protocolText();
  text["sessions"][0]["blocks"][0]["trials"] = 1;
  here.file("protocol.json", text.dump());
  addTrainee("T001", "novice");
  ASSERT_EQ(runTrainee({"--answers", "answers.json"}).exit_code, 0);
  text["trial_seed"] = 5;
  here.file("protocol.json", text.dump());
  const Outcome changed = runTrainee();
  EXPECT_EQ(changed.exit_code, 2);
  EXPECT_TRUE(says(changed.err, "with another protocol file")) << changed.err;
}

TEST_F(Study, TellsNoConditionWhereItIsBlind) {
  json text = protocolText();
  text["blind"] = json::array({"educator"});
  text["sessions"][0]["blocks"][0]["trials"] = 1;
  text["conditions"][0]["means"] = "with the secret";
  text["conditions"][1]["means"] = "without the secret";
  here.file("protocol.json", text.dump());
  addTrainee("T001", "novice");
  const Outcome blind = runTrainee({"--answers", "answers.json"});
  ASSERT_EQ(blind.exit_code, 0) << blind.err;
  for (const std::string& said : {blind.out, status().out})
    EXPECT_FALSE(says(said, "secret") || says(said, "FF") || says(said, "NO ")) << said;
  EXPECT_TRUE(says(status().out, "novice         1 place assigned; balanced again after 1 more"))
      << status().out;
}

TEST_F(Study, WrongUsageIsNamed) {
  const auto complains = [&](const std::vector<std::string>& more, const char* about) {
    const Outcome outcome = run(more);
    EXPECT_EQ(outcome.exit_code, 2) << outcome.err;
    EXPECT_EQ(outcome.errLines(), 1) << outcome.err;
    EXPECT_TRUE(says(outcome.err, about)) << outcome.err;
  };
  complains({}, "needs --trainee or --simulate");
  complains({"--simulate"}, "needs --learning");
  here.file("x.json", "{}");
  complains({"--trainee", "T001", "--learning", "x.json"}, "goes with --simulate only");
  complains({"--trainee", "T001", "--simulate", "2"}, "exclude each other");
  complains({"--trainee", "Dr. Smith"}, "pseudonym");
  complains({"--simulate", "2", "--learning", "none.json"},
            "--learning needs a file that is there, not 'none.json'");
}

}  // namespace
}  // namespace palpa::cli_test

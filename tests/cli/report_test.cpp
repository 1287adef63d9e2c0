#include <gtest/gtest.h>

#include "program.h"

/// The pages of a trainee and of a group, from the records.
namespace palpa::cli_test {
namespace {

TEST(Report, PagesOfPracticeComeFromTheRecords) {
  const Folder here;
  const auto run = [&](std::vector<std::string> words) {
    words.insert(words.end(), {"--records", "records.sqlite"});
    return palpa(words, here.path());
  };
  ASSERT_EQ(run({"records", "trainee", "add", "--id", "T017", "--group", "novice", "--consent"})
                .exit_code,
            0);
  ASSERT_EQ(palpa(session({"--trainee", "T017", "--seed", "40", "--trials", "2", "--out", "A"}),
                  here.path())
                .exit_code,
            0);
  ASSERT_EQ(run({"records", "add", "A"}).exit_code, 0);

  const Outcome trainee = run({"report", "trainee", "--id", "T017", "--out", "P"});
  ASSERT_EQ(trainee.exit_code, 0) << trainee.err;
  EXPECT_TRUE(says(trainee.out, "P/trainee.html (2 trials)")) << trainee.out;
  const std::string page = contentOf(here / "P/trainee.html");
  for (const char* words : {"Trainee T017", "SIMULATED", "2 scored trials in 1 session",
                            "takes at least 13", "Costs most now:"})
    EXPECT_TRUE(says(page, words)) << words;

  const Outcome cohort = run({"report", "cohort", "--group", "novice", "--acceptable", "0.05",
                              "--unacceptable", "0.10", "--out", "C"});
  ASSERT_EQ(cohort.exit_code, 0) << cohort.err;
  const std::string group = contentOf(here / "C/cohort.html");
  for (const char* words : {"Group: novice", "SIMULATED", "1 trainee, 2 scored trials",
                            "Fewer than 41 trials cannot certify anybody"})
    EXPECT_TRUE(says(group, words)) << words;

  for (const auto& [words, about] :
       {std::pair{std::vector<std::string>{"report", "trainee", "--id", "T018"},
                  "is not in the records"},
        std::pair{std::vector<std::string>{"report", "cohort", "--group", "nobody"},
                  "has no trials"},
        std::pair{std::vector<std::string>{"report", "trainee", "--id", "T017", "--acceptable",
                                           "0.5", "--unacceptable", "0.2"},
                  "acceptable < unacceptable"}}) {
    const Outcome outcome = run(words);
    EXPECT_EQ(outcome.exit_code, 2) << outcome.err;
    EXPECT_TRUE(says(outcome.err, about)) << outcome.err;
  }
}

}  // namespace
}  // namespace palpa::cli_test

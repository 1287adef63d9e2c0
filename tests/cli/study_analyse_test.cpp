#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <map>
#include <nlohmann/json.hpp>

#include "apps/record/store/record_store.h"
#include "apps/study/analysis/power_analysis.h"
#include "program.h"

/// From the records of a study, or a table, to its page.
namespace palpa::cli_test {
namespace {

constexpr char kStudyProtocol[] =
    R"({"version": 1, "id": "pilot", "title": "A pilot", "analysis": "paracentesis pilot",
  "groups": [{"name": "novice", "means": "n"}, {"name": "experienced", "means": "e"}],
  "conditions": [{"name": "NO", "means": "without force feedback"}, {"name": "FF", "means": "with force feedback"}]})";

/// A drawn study as its stations would have sent it: a session a subject, with a familiarisation
/// and a void trial that do not count.
void fillStudyRecords(const std::filesystem::path& file) {
  record::RecordStore store(file.string());
  std::map<std::string, int> trials;
  for (const study_analysis::StudyRow& row :
       study_analysis::drawStudy(study_analysis::pilotModels(), 5, 10, 1)) {
    record::StoredSession session;
    session.uuid = "uuid-" + row.subject;
    session.trainee = row.subject;
    session.simulated = true;
    session.study = "pilot";
    session.software = "palpa 0.1.0";
    session.facts_json = nlohmann::json{
        {"study",
         {{"id", "pilot"},
          {"slot", 1},
          {"group", row.group},
          {"condition", row.condition},
          {"block", "trials"},
          {"step", 2}}}}.dump();
    if (!trials.contains(row.subject))
      store.addTrainee({row.subject, row.group, "", "right", "", "", "", ""});
    const auto add = [&](const char* role, const char* outcome, double total) {
      record::StoredTrial trial;
      trial.number = ++trials[row.subject];
      trial.role = role;
      trial.outcome = outcome;
      trial.metrics = {
          {"total", total}, {"time_s", row.metric("time_s")}, {"closest_pleura_mm", std::nan("")}};
      store.addTrial(session, trial);
    };
    if (row.trial == 1) add("familiarisation", "done", 1e6);
    if (row.trial == 3) add("scored", "void", 1e6);
    add("scored", "done", row.metric("total"));
  }
}

TEST(StudyAnalyse, RecordsBecomeTablesFiguresAndAPage) {
  const Folder here;
  fillStudyRecords(here / "records.sqlite");
  const std::string protocol = here.file("pilot.json", kStudyProtocol);
  const Outcome done = palpa({"study", "analyse", "--protocol", protocol, "--records",
                              "records.sqlite", "--as-published", "--out", "A"},
                             here.path());
  ASSERT_EQ(done.exit_code, 0) << done.err;
  EXPECT_TRUE(says(done.out, "SIMULATED: 200 of 200 trials")) << done.out;
  EXPECT_TRUE(says(done.out, "Novice, with force feedback: "));
  EXPECT_TRUE(says(done.out, "A/report.html"));
  for (const char* file : {"table_3", "table_4", "table_5", "table_6", "figure_4", "figure_5",
                           "figure_6", "table_6_as_published", "mixed_model_total"}) {
    EXPECT_TRUE(std::filesystem::exists(here / "A" / (std::string(file) + ".csv"))) << file;
    EXPECT_EQ(nlohmann::json::parse(contentOf(here / "A" / (std::string(file) + ".json")))
                  .at("simulated"),
              true);
  }
  const auto six = nlohmann::json::parse(contentOf(here / "A/table_6_as_published.json"));
  EXPECT_EQ(six["rows"][0][3], 50)
      << "ten trials of five subjects: neither familiarisation nor void trials";
  EXPECT_TRUE(says(contentOf(here / "A/report.html"), "A pilot"));
}

/// The same rows as a table give the same figures.
TEST(StudyAnalyse, ATableGivesTheSameAsRecords) {
  const Folder here;
  fillStudyRecords(here / "records.sqlite");
  std::string csv = "SUBJECT,GROUP,CONDITION,BLOCK,TRIAL,SIMULATED,total,time_s\n";
  for (const study_analysis::StudyRow& row :
       study_analysis::drawStudy(study_analysis::pilotModels(), 5, 10, 1)) {
    char line[200];
    std::snprintf(line, sizeof line, "%s,%s,%s,trials,%d,1,%.17g,%.17g\n", row.subject.c_str(),
                  row.group.c_str(), row.condition.c_str(), row.trial, row.metric("total"),
                  row.metric("time_s"));
    csv += line;
  }
  const std::string protocol = here.file("pilot.json", kStudyProtocol),
                    table = here.file("rows.csv", csv);
  ASSERT_EQ(palpa({"study", "analyse", "--protocol", protocol, "--records", "records.sqlite",
                   "--out", "A"},
                  here.path())
                .exit_code,
            0);
  const Outcome by_table = palpa(
      {"study", "analyse", "--protocol", protocol, "--csv", table, "--out", "B"}, here.path());
  ASSERT_EQ(by_table.exit_code, 0) << by_table.err;
  for (const char* file : {"table_4.csv", "table_6.csv", "mixed_model_total.csv"})
    EXPECT_EQ(contentOf(here / "A" / file), contentOf(here / "B" / file)) << file;
  const Outcome ordered = palpa({"study", "analyse", "--csv", table, "--kind", "paracentesis pilot",
                                 "--groups", "experienced,novice", "--out", "C"},
                                here.path());
  EXPECT_TRUE(says(ordered.out, "Experienced, NO: ")) << ordered.out << ordered.err;
}

TEST(StudyAnalyse, SaysInOneLineWhatIsWrong) {
  const Folder here;
  const auto refused = [&](std::vector<std::string> words, const std::string& line) {
    words.insert(words.begin(), {"study", "analyse"});
    const Outcome outcome = palpa(words, here.path());
    EXPECT_EQ(outcome.exit_code, 2) << line;
    EXPECT_EQ(outcome.errLines(), 1) << outcome.err;
    EXPECT_TRUE(says(outcome.err, line)) << outcome.err;
  };
  refused({}, "needs --protocol, --study or --csv");
  refused({"--study", "none", "--records", "records.sqlite"},
          "holds no scored trial of the study \"none\"");
  refused({"--csv", "missing.csv"}, "missing.csv: cannot be read");
  refused({"--csv", here.file("a.csv", "SUBJECT,GROUP,CONDITION,BLOCK,TRIAL,total\nA,g,c,b,1,x\n")},
          "line 2: column total");
  refused({"--csv", here.file("b.csv", "SUBJECT,GROUP,CONDITION,BLOCK,TRIAL,total\nA,g,c,b,1,4\n"),
           "--kind", "pilot"},
          "is not a kind of analysis");
  refused({"--protocol", here.file("p.json", "{\"id\": \"p\", \"analysis\": \"other\"}")},
          "field analysis");
  EXPECT_FALSE(std::filesystem::exists(here / "out"));
}

TEST(StudyPlan, PrintsPowerAndFalsePositives) {
  const Folder here;
  const Outcome done = palpa({"study", "plan", "--simulate", "200"}, here.path());
  EXPECT_EQ(done.exit_code, 0) << done.err;
  for (const char* words :
       {"SIMULATED: 200 studies", "(power)", "(false positives)", "as published"})
    EXPECT_TRUE(says(done.out, words)) << done.out;
}

}  // namespace
}  // namespace palpa::cli_test

#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <sstream>

#include "program.h"

/// An assessed trial from the session to the verdict: raters' forms, agreement, the page.
namespace palpa::cli_test {
namespace {

Outcome inHere(std::vector<std::string> words, const Folder& here, bool records = true) {
  if (records) words.insert(words.end(), {"--records", "records.sqlite"});
  return palpa(words, here.path());
}

/// The sheet that `rate form` left, filled in: every item `item`, every aspect `grade`.
std::string filledIn(const Folder& here, const std::string& item, const std::string& grade) {
  std::istringstream lines(contentOf(here / "form.csv"));
  std::string text, value = item;
  for (std::string line; std::getline(lines, line);) {
    if (says(line, "# 1 to 5")) value = grade;
    text += line + (line.ends_with(",") ? value : "") + "\n";
  }
  return text;
}

TEST(Rate, FromTheFormToTheVerdict) {
  const Folder here;
  ASSERT_EQ(inHere({"records", "trainee", "add", "--id", "T001"}, here).exit_code, 0);
  const Outcome run = palpa({"subclavian", "--assess", "--operator", "expert", "--fast",
                             "--no-views", "--station", quickStation("virtual_bench.json"),
                             "--seed", kShortTrial, "--trainee", "T001", "--out", "A"},
                            here.path());
  ASSERT_EQ(run.exit_code, 0) << run.err;
  EXPECT_TRUE(says(run.out, "Assessment: every aid is off")) << run.out;
  EXPECT_TRUE(says(contentOf(here / "A/report.html"), "Not certified (simulated)"));
  EXPECT_TRUE(says(contentOf(here / "A/trials.csv"), "T001"));  // an assessed trial is scored
  const Outcome too_early = inHere({"rate", "form", "--session", "A"}, here);
  EXPECT_EQ(too_early.exit_code, 2);
  EXPECT_TRUE(says(too_early.err, "Bring the session into the records first")) << too_early.err;
  ASSERT_EQ(inHere({"records", "add", "A"}, here).exit_code, 0);

  const Outcome form =
      inHere({"rate", "form", "--session", "A", "--trial", "1", "--out", "form.html"}, here);
  EXPECT_EQ(form.exit_code, 0) << form.err;
  for (const char* words :
       {"simulator: done", "T001 (simulated)", "Global rating of a needle procedure"})
    EXPECT_TRUE(says(contentOf(here / "form.html"), words)) << words;
  here.file("one.csv", filledIn(here, "done", "4"));
  here.file("other.csv", filledIn(here, "done", "2"));
  for (const auto& [rater, sheet] : {std::pair("R1", "one.csv"), std::pair("R2", "other.csv")}) {
    const Outcome entered =
        inHere({"rate", "enter", "--session", "A", "--rater", rater, "--answers", sheet}, here);
    EXPECT_EQ(entered.exit_code, 0) << entered.err;
    EXPECT_TRUE(says(entered.out, "25 of 25 items of the checklist, 6 of 6 grades")) << entered.out;
  }
  const Outcome agreement = inHere({"rate", "agreement"}, here);
  EXPECT_EQ(agreement.exit_code, 0) << agreement.err;
  EXPECT_TRUE(
      says(agreement.out,
           "1 rated trial in the records file records.sqlite; simulated trials are among them"))
      << agreement.out;
  EXPECT_TRUE(says(agreement.out, "Checklist, R1 and R2: 25 items, 100 % alike, no kappa"))
      << agreement.out;
  EXPECT_TRUE(says(agreement.out, "R1 and simulator: 18 items")) << agreement.out;

  const Outcome passed =
                    inHere({"report", "trial", "A", "--rater", "R1", "--out", "r1.html"}, here),
                failed =
                    inHere({"report", "trial", "A", "--rater", "R2", "--out", "r2.html"}, here);
  EXPECT_TRUE(says(passed.out, "Trial 1 (simulated): Pass")) << passed.out << passed.err;
  EXPECT_TRUE(says(contentOf(here / "r1.html"), "Pass (simulated)"));
  EXPECT_TRUE(says(failed.out, "Fail: Global rating: 2 of 5 on average; 3 is asked for."))
      << failed.out << failed.err;
  const Outcome sheet = inHere(
      {"report", "certificate", "A", "--answers", "one.csv", "--rater", "R1", "--out", "c.pdf"},
      here, false);
  ASSERT_EQ(sheet.exit_code, 0) << sheet.err;
  ASSERT_EQ(std::system(("pdftotext -layout '" + (here / "c.pdf").string() + "'").c_str()), 0);
  const std::string certified = contentOf(here / "c.txt");
  for (const char* words :
       {"SIMULATED", "Access to the subclavian vein", "Passed", "T001", "simulator and rater R1",
        "items of the checklist were done", "4 of 5 on average", "cannot certify anybody",
        "Signature of the rater"})
    EXPECT_TRUE(says(certified, words)) << words << " in\n" << certified;
  here.file("signed.csv", "# rater: R7\n" + contentOf(here / "one.csv"));
  ASSERT_EQ(inHere({"report", "certificate", "A", "--answers", "signed.csv", "--out", "s.pdf"},
                   here, false)
                .exit_code,
            0);
  const Outcome anothers = inHere(
      {"report", "certificate", "A", "--answers", "signed.csv", "--rater", "R1", "--out", "t.pdf"},
      here, false);
  EXPECT_EQ(anothers.exit_code, 2);
  EXPECT_TRUE(says(anothers.err, "rater R7: filled in this sheet, not R1")) << anothers.err;
  const Outcome refused = inHere(
      {"report", "certificate", "A", "--answers", "other.csv", "--rater", "R2", "--out", "d.pdf"},
      here, false);
  EXPECT_EQ(refused.exit_code, 2);
  EXPECT_TRUE(says(refused.err, "was not passed: Global rating: 2 of 5")) << refused.err;
  EXPECT_FALSE(std::filesystem::exists(here / "d.pdf"));
  const Outcome beside = inHere({"report", "trial", "A", "--beside", "A", "--answers", "one.csv",
                                 "--standard", "90", "--out", "b.html"},
                                here, false);
  EXPECT_EQ(beside.exit_code, 0) << beside.err;
  EXPECT_TRUE(
      says(contentOf(here / "b.html"), "The dash-dotted line is trial 1 of a simulated expert"));
}

TEST(Rate, MistakesAreSaid) {
  const Folder here;
  const auto refused = [&](const std::vector<std::string>& words, const std::string& expected) {
    const Outcome outcome = palpa(words, here.path());
    EXPECT_EQ(outcome.exit_code, 2) << outcome.out;
    EXPECT_EQ(outcome.errLines(), 1) << outcome.err;
    EXPECT_TRUE(says(outcome.err, expected)) << outcome.err;
  };
  here.file("bad.csv", "item,value\nsteril,done\n");
  here.file("bad.json", "{}");
  refused({"rate", "enter", "--session", "nobody", "--rater", "R1", "--answers", "bad.csv",
           "--records", "r.sqlite"},
          "bad.csv, line 2: names \"steril\"");
  refused({"rate", "form", "--checklist", "bad.json", "--records", "r.sqlite"},
          "bad.json: field \"version\" is missing");
  here.file("filled.csv", "item,value\nsterile,done\n");
  refused({"rate", "form", "--out", "filled.html", "--records", "r.sqlite"}, "may hold answers");
  refused({"rate", "form", "--out", "filled.csv", "--records", "r.sqlite"}, "must end with .html");
  EXPECT_TRUE(says(contentOf(here / "filled.csv"), "sterile,done"));
  refused({"rate", "form", "--checklist", "none.json", "--records", "r.sqlite"},
          "none.json: cannot be read");
  refused({"rate", "enter", "--session", "A", "--rater", "Dr Smith", "--answers", "bad.csv"},
          "pseudonym");
  refused({"subclavian", "--assess", "--guide", "on", "--fast", "--operator", "expert"},
          "--guide on with --assess");
  refused({"subclavian", "--assess", "--presentation", "substitution", "--fast", "--operator",
           "expert"},
          "--presentation with --assess");
  refused(
      {"subclavian", "--presentation", "pilot", "--guide", "on", "--fast", "--operator", "expert"},
      "--guide on");
  refused({"subclavian", "--presentation", "pilto", "--fast", "--operator", "expert"}, "pilot");
  refused({"search", "--assess", "--mode", "augmented", "--fast", "--operator", "expert"},
          "--mode augmented with --assess");
}

}  // namespace
}  // namespace palpa::cli_test

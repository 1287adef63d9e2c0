#include <gtest/gtest.h>

#include <locale>

#include "anatomy/base/error.h"
#include "synthetic_report.h"

namespace palpa::report {
namespace {

using namespace test;
namespace fs = std::filesystem;

/// The two sample rows of Tzafestas et al. 2008.
std::vector<assess::TrialAssessment> paperRows() {
  assess::TrialAssessment first, second;
  first.trial = 1;
  first.seed = 18446744073709551615u;
  first.simulated = true;
  first.values = {0, 0, 0, 1, 6, 0, 18, 27, 31524, true};
  first.rules = second.rules = "2";
  first.total = 913.24;
  second.trial = 2;
  second.force_feedback = false;
  second.values = {0, 25, 0, 9, 4, 982.5, 12, 51, 157840, false};
  second.total = 3970.4;
  return {first, second};
}

constexpr const char* kHeader =
    "USER_ID,FF,COL_LUNG,COL_RIB,COL_ART,COL_VEIN,PHASE_1,PHASE_2,ECON_MEAN,ECON_VAR,TIME,SUCCESS,"
    "TRIAL,SEED,SIMULATED,TOTAL,AUGMENTED,RULES\n";

TEST(TrialsCsv, IsThisText) {
  const fs::path file = freshFolder("csv") / "trials.csv";
  writeTrialsCsv("P07", paperRows(), file);
  EXPECT_EQ(slurp(file), std::string(kHeader) +
                             "P07,1,0,0,0,1,6,0,18,27,31524,1,1,18446744073709551615,1,913.24,0,2\n"
                             "P07,0,0,25,0,9,4,982.5,12,51,157840,0,2,0,0,3970.4,0,2\n");
}

TEST(TrialsCsv, QuotesWhatNeedsIt) {
  const fs::path file = freshFolder("csv_quotes") / "trials.csv";
  writeTrialsCsv("a,\"b\"\n", {paperRows()[1]}, file);
  EXPECT_EQ(slurp(file),
            std::string(kHeader) +
                "\"a,\"\"b\"\"\n\",0,0,25,0,9,4,982.5,12,51,157840,0,2,0,0,3970.4,0,2\n");
}

struct CommaPoint : std::numpunct<char> {
  char do_decimal_point() const override { return ','; }
  char do_thousands_sep() const override { return '.'; }
  std::string do_grouping() const override { return "\3"; }
};

TEST(TrialsCsv, IsTheSameInALocaleWithCommas) {
  const fs::path folder = freshFolder("csv_locale");
  writeTrialsCsv("P", paperRows(), folder / "a.csv");
  const std::locale before = std::locale::global(std::locale(std::locale(), new CommaPoint));
  writeTrialsCsv("P", paperRows(), folder / "b.csv");
  std::locale::global(before);
  EXPECT_EQ(slurp(folder / "a.csv"), slurp(folder / "b.csv"));
}

TEST(TrialsCsv, HasAHeaderWithoutTrialsAndAnErrorWithoutFolder) {
  const fs::path folder = freshFolder("csv_empty");
  writeTrialsCsv("P", {}, folder / "trials.csv");
  EXPECT_EQ(slurp(folder / "trials.csv"), kHeader);
  EXPECT_THROW(writeTrialsCsv("P", {}, folder / "missing" / "trials.csv"), Error);
}

}  // namespace
}  // namespace palpa::report

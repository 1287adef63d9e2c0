#include <gtest/gtest.h>

#include <cmath>

#include "anatomy/base/error.h"
#include "apps/study/analysis/study_row.h"

namespace palpa::study_analysis {
namespace {

std::string refusalOf(const std::string& csv) {
  try {
    rowsOfCsv(csv, "t.csv");
  } catch (const UsageError& e) {
    return e.what();
  }
  return "";
}

TEST(StudyCsv, ReadsRowsInAnyOrderAndNumbersThem) {
  const std::vector<StudyRow> rows = rowsOfCsv(
      "\xef\xbb\xbfTRIAL,SUBJECT,GROUP,CONDITION,BLOCK,SESSION,time_s,total,SIMULATED,ROLE,"
      "OUTCOME\r\n"
      "1,\"B, the \"\"second\"\"\",novice,FF,test,1,12.5,,1,scored,done\r\n"
      "\r\n"
      "2,A,experienced,NO,test,2,3,5,0,scored,done\n"
      "7,A,experienced,NO,base,1,1,1e2,0,scored,done\n"
      "9,A,experienced,NO,base,1,1,-4,0,scored,done\n"
      "1,A,experienced,NO,base,1,1,1,0,familiarisation,done\n"
      "8,A,experienced,NO,base,1,1,1,0,scored,void",
      "t.csv");
  ASSERT_EQ(rows.size(), 4u);
  EXPECT_EQ(rows[0].subject, "B, the \"second\"");
  EXPECT_TRUE(rows[0].simulated);
  EXPECT_EQ(rows[0].metric("time_s"), 12.5);
  EXPECT_TRUE(std::isnan(rows[0].metric("total")));
  EXPECT_TRUE(std::isnan(rows[0].metric("unknown")));
  for (std::size_t i = 1; i < 4; ++i) EXPECT_EQ(rows[i].overall, static_cast<int>(i));
  EXPECT_EQ(rows[1].metric("total"), 100);
  EXPECT_EQ(rows[2].trial, 2);
  EXPECT_EQ(rows[3].block, "test");
  EXPECT_EQ(rows[3].trial, 1);
}

TEST(StudyCsv, SaysWhatItCannotRead) {
  const std::string header = "SUBJECT,GROUP,CONDITION,BLOCK,TRIAL,time_s\n";
  for (const auto& [csv, words] : std::vector<std::pair<std::string, std::string>>{
           {"", "t.csv: is empty"},
           {"SUBJECT,GROUP,CONDITION,BLOCK,time_s\nA,g,c,b,1\n", "has no column TRIAL"},
           {"SUBJECT,SUBJECT,GROUP,CONDITION,BLOCK,TRIAL,time_s\n",
            "has more than one column SUBJECT"},
           {"SUBJECT,GROUP,CONDITION,BLOCK,TRIAL\nA,g,c,b,1\n", "has no figures"},
           {"SUBJECT,GROUP,CONDITION,BLOCK,TRIAL,x,x\n", "has two columns x"},
           {header, "holds no scored trial"},
           {header + "A,g,c,b,1\n", "line 2: has 5 cells where the header has 6"},
           {header + "A,g,c,b,1,2\nA,g,c,b,2,1.2.3\n",
            "line 3: column time_s: \"1.2.3\" is not a number"},
           {header + "A,g,c,b,1,nan\n", "is not a number"},
           {header + "A,g,c,b,1.5,2\n", "column TRIAL must be a whole number from 1"},
           {header + "A,g,c,b,-1,2\n", "column TRIAL must be a whole number from 1"},
           {header + ",g,c,b,1,2\n", "has no subject"},
           {header + "A,g,c,b,,2\n", "has no trial number"},
           {header + "A,g,c,b,1,2\nA,g,c,b,1,3\n", "subject A: trial 1 of block b occurs twice"},
           {header + "A,g,c,b,1,2\nA,h,c,b,2,3\n", "is in two groups, \"g\" and \"h\""},
           {header + "\"A,g,c,b,1,2\n", "a quoted text has no end"},
           {header + "\"A\"x,g,c,b,1,2\n", "something follows a quoted text"}})
    EXPECT_NE(refusalOf(csv).find(words), std::string::npos) << words << " | " << refusalOf(csv);
}

/// Any damage is refused in words or read; nothing else happens.
TEST(StudyCsv, SurvivesEveryCutAndFlip) {
  const std::string good =
      "SUBJECT,GROUP,CONDITION,BLOCK,TRIAL,time_s\n\"A\",g,c,b,1,2.5\nB,g,\"c\",b,2,3\n";
  for (std::size_t i = 0; i < good.size(); ++i)
    for (const char c : {'"', ',', '\n', '\r', '\0', '9'}) {
      std::string bad = good;
      bad[i] = c;
      refusalOf(bad);
      refusalOf(good.substr(0, i));
    }
  EXPECT_EQ(refusalOf(good), "");
}

}  // namespace
}  // namespace palpa::study_analysis

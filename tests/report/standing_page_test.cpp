#include <gtest/gtest.h>

#include "apps/report/page/html.h"
#include "apps/report/page/standing.h"
#include "well_formed.h"

namespace palpa::report {
namespace {

using progress::Group;

const Group kExperts{"experts", "8 of 10 of their trials",
                     true,      3,
                     60,        {{"total", 400, 500, 700}, {"success", 1, 1, 1}}};
const Group kOthers{"others who train here",
                    "the middle half of them",
                    false,
                    9,
                    80,
                    {{"total", 800, 900, 1300}, {"time_s", 30, 40, 50}}};

progress::JudgedTrial trialOf(std::vector<metrics::MetricValue> figures,
                              training::Role role = training::Role::scored) {
  return {role, training::Outcome::success, std::move(figures)};
}

std::string written(const std::vector<progress::JudgedTrial>& trials,
                    const std::vector<Group>& groups) {
  Html html;
  writeStanding(html, training::Engine::needle, trials, groups);
  return html.str();
}

bool says(const std::string& page, const std::string& text) {
  return page.find(text) != std::string::npos;
}

TEST(StandingPage, TellsWhatOthersReachInTheFiguresUnit) {
  const std::string page = written(
      {trialOf({{"total", 1000}, {"time_s", 61}, {"success", 1}}), trialOf({{"total", 650}})},
      {kExperts, kOthers});
  EXPECT_EQ(faultOf(page), "");
  EXPECT_TRUE(says(page,
                   "650 points to 1000 points; experts 400 points to 700 points; others who "
                   "train here 800 points to 1300 points"))
      << page;
  EXPECT_TRUE(says(page, "61 s; others who train here 30 s to 50 s"));
  EXPECT_TRUE(says(page, "(less is better)"));
  EXPECT_TRUE(says(page, "experts (simulated): where 8 of 10 of their trials lie"));
  EXPECT_FALSE(says(page, "others who train here (simulated)"));
  EXPECT_FALSE(says(page, "Successful")) << "yes or no has no range";
}

TEST(StandingPage, SaysNothingWhereNobodyOrNothingCounts) {
  EXPECT_EQ(written({trialOf({{"total", 1000}})}, {}), "");
  EXPECT_EQ(written({}, {kExperts}), "");
  EXPECT_EQ(written({trialOf({{"total", 1000}}, training::Role::familiarisation)}, {kExperts}), "");
  EXPECT_EQ(written({trialOf({{"path_length_mm", 3}})}, {kExperts}), "");
}

TEST(StandingPage, MarksStandWhereTheValuesAre) {
  // 400 to 1300 with a margin of 4 % on either side: 364 to 1336, drawn 1000 wide.
  const std::string page = written({trialOf({{"total", 850}})}, {kExperts, kOthers});
  EXPECT_TRUE(says(page, "class=\"here\" x=\"497.5\"")) << page;  // the middle, less half a mark
}

}  // namespace
}  // namespace palpa::report

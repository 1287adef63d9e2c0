#include <gtest/gtest.h>

#include "synthetic_report.h"
#include "well_formed.h"

namespace palpa::report {
namespace {

using namespace test;

std::string written(const SessionReport& report, const std::string& name) {
  const std::filesystem::path file = freshFolder(name) / "report.html";
  writeReport(report, file);
  return slurp(file);
}

bool contains(const std::string& page, const std::string& text) {
  return page.find(text) != std::string::npos;
}

std::size_t count(const std::string& page, const std::string& text) {
  std::size_t found = 0;
  for (std::size_t at = page.find(text); at != std::string::npos; at = page.find(text, at + 1))
    ++found;
  return found;
}

/// A square vein, 40 mm along the way and 20 mm deep.
assess::NeedleViews views() {
  assess::NeedleViews v;
  v.target_A = {0.040, 0.020, 0};
  v.entry_acceptable = 0.003;
  const Eigen::Vector2d corner(0.025, 0.025);
  const auto view = [&](const char* title, const Vec3& origin, const Vec3& across, const Vec3& up) {
    assess::NeedleView one;
    one.title = title;
    one.plane = {origin, across, up};
    one.low = -corner;
    one.high = corner;
    return one;
  };
  v.skin = view("From in front", Vec3::Zero(), Vec3::UnitX(), Vec3::UnitZ());
  v.way = view("From the side", Vec3::Zero(), Vec3::UnitX(), -Vec3::UnitY());
  v.way.high.x() = 0.045;
  v.vein = view("As the needle sees it", v.target_A, Vec3::UnitZ(), -Vec3::UnitY());
  v.vein.cut.push_back(
      {Organ::vein, true, {{-0.005, -0.005}, {0.005, -0.005}, {0.005, 0.005}, {-0.005, 0.005}}});
  return v;
}

/// One pass, straight to (40, 20, z) mm from an entry at (x, 0, 0).
std::vector<assess::TrialSample> pass(double x, double z) {
  std::vector<assess::TrialSample> samples;
  const Vec3 entry(x, 0, 0), way = Vec3(0.040, 0.020, z) - entry;
  for (int i = 0; i <= 200; ++i) {
    assess::TrialSample s;
    s.t_s = 0.01 * i;
    s.axis_A = way.normalized();
    s.depth = way.norm() * (i - 20) / 180.0;
    s.tip_A = entry + s.depth * s.axis_A;
    s.phase = i < 20 ? haptics::NeedlePhase::outside : haptics::NeedlePhase::inserted;
    if (i == 20) s.events = haptics::kSkinPunctured;
    samples.push_back(s);
  }
  return samples;
}

SessionReport with(const std::vector<assess::TrialSample>& samples) {
  SessionReport report = syntheticReport(1);
  report.trials[0].samples = samples;
  report.views = views();
  return report;
}

TEST(TrackPage, ShowsWhereThePassWentInAndWhatItWasAimedAt) {
  const std::string page = written(with(pass(0.005, 0)), "track");
  EXPECT_EQ(faultOf(page), "");
  EXPECT_TRUE(contains(page, "Where the needle went"));
  // A view of 50 mm is 268.2 px wide: the entry 5 mm right of the middle; the aim in the middle.
  EXPECT_TRUE(contains(page, R"(class="pass" cx="160.9" cy="160.1")")) << page;
  EXPECT_EQ(count(page, R"(class="pass")"), 4u);  // entry and aim, wide and narrow
  EXPECT_EQ(count(page, R"(class="organ vein")"), 2u);
  EXPECT_LT(page.find("Where the needle went"), page.find(">Score<"));
}

TEST(TrackPage, HoldsWhatLiesBeyondAtTheEdgeAndMarksIt) {
  const std::string page = written(with(pass(0, 0.045)), "beyond");
  EXPECT_EQ(count(page, R"(class="pass beyond")"), 2u);
  EXPECT_EQ(count(page, R"(class="pass")"), 2u);
}

TEST(TrackPage, SaysThatTheSkinWasNotPierced) {
  std::vector<assess::TrialSample> samples = pass(0, 0);
  samples.resize(20);
  const std::string page = written(with(samples), "none");
  EXPECT_EQ(faultOf(page), "");
  EXPECT_TRUE(contains(page, "The needle did not pierce the skin."));
}

TEST(TrackPage, IsNotOfATaskThatTeachesNoWay) {
  EXPECT_FALSE(contains(written(syntheticReport(1), "no-way"), "Where the needle went"));
}

}  // namespace
}  // namespace palpa::report

#include "apps/evidence/needle_track.h"

#include <gtest/gtest.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "apps/evidence/recorded_session.h"
#include "tests/session/quick_sessions.h"

/// What the replay's pictures show of a recorded trial: the needle where it was.
namespace palpa::session {
namespace {

using nlohmann::json;

double across(const json& p, const json& q) {
  return std::hypot(p[0].get<double>() - q[0].get<double>(),
                    p[1].get<double>() - q[1].get<double>());
}

/// How far a point is from the outline of an organ, mm.
double nearest(const json& view, const char* organ, const json& p) {
  double least = 1e9;
  for (const json& line : view["lines"])
    if (line["organ"] == organ)
      for (const json& q : line["points"]) least = std::min(least, across(p, q));
  return least;
}

class TrackOf : public testing::TestWithParam<anatomy::Side> {};

/// On the left as on the right: the same pictures, mirrored in the patient.
TEST_P(TrackOf, AnExpertLeadsThroughTheSkinIntoTheVein) {
  SessionOptions options = quick(OperatorKind::expert, 3);
  options.side = GetParam();
  Quick<NeedleWorld> world(options);
  const std::filesystem::path folder = freshPlace("track");
  ASSERT_TRUE(runNeedleSession(options, world, folder).trials.at(0).assessment.values.success);
  const evidence::RecordedSession session(folder / "session.palpa");
  ASSERT_TRUE(session.views());
  json track;
  session.eachTrial([&](const record::RecordedTrial&, const evidence::NeedleSamples& samples) {
    track = evidence::needleTrack(*session.views(), samples);
  });
  ASSERT_EQ(track["views"].size(), 3u);
  const std::size_t times = track["t_s"].size();
  EXPECT_GT(times, 100u);
  for (std::size_t i = 1; i < times; ++i)
    EXPECT_GT(track["t_s"][i].get<double>(), track["t_s"][i - 1].get<double>());
  const json &skin = track["views"][0], &way = track["views"][1], &vein = track["views"][2];
  for (const json& view : track["views"]) EXPECT_EQ(view["needle"].size(), times) << view["title"];

  ASSERT_EQ(skin["passes"].size(), 1u);
  EXPECT_LT(across(skin["passes"][0], skin["entry"]), 3 * skin["experts_mm"].get<double>());
  const json& tip = way["needle"].back()[0];
  EXPECT_LT(tip[1].get<double>(), way["entry"][1].get<double>()) << "deeper than the entry";
  EXPECT_GT(tip[0].get<double>(), way["entry"][0].get<double>()) << "on the way";
  ASSERT_FALSE(vein["needle"].back().is_null());
  const double radius = nearest(vein, "vein", vein["target"]);
  EXPECT_GT(radius, 2);
  // The lumen is cut obliquely: longer than the nearest place of its outline tells.
  EXPECT_LT(across(vein["needle"].back()[0], vein["target"]), 1.5 * radius) << "aimed at the vein";
  EXPECT_TRUE(vein["needle"].front().is_null()) << "before the skin it is aimed at nothing";
}

INSTANTIATE_TEST_SUITE_P(Sides, TrackOf,
                         testing::Values(anatomy::Side::right, anatomy::Side::left));

TEST(Track, ABlockHasNoVeinToShow) {
  SessionOptions options = quick(OperatorKind::expert, 3);
  options.task = PALPA_SOURCE_DIR "/assets/tasks/bone_pin.json";
  Quick<NeedleWorld> world(options);
  const std::filesystem::path folder = freshPlace("track-block");
  runNeedleSession(options, world, folder);
  EXPECT_FALSE(evidence::RecordedSession(folder / "session.palpa").views());
}

}  // namespace
}  // namespace palpa::session

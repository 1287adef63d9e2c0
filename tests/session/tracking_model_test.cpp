#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <memory>
#include <nlohmann/json.hpp>
#include <numbers>

#include "anatomy/base/error.h"
#include "apps/assess/statistics/power.h"
#include "apps/assess/statistics/sample.h"
#include "apps/assess/statistics/tests_of_means.h"
#include "apps/record/session_file.h"
#include "apps/session/session_facts.h"
#include "apps/session/session_pictures.h"
#include "tests/session/quick_sessions.h"
#include "tests/support/counts.h"

/// Sessions whose board is tracked by a model in place of pictures.
namespace palpa::session {
namespace {

SessionOptions tracked(Tracking by, std::uint64_t seed = 1) {
  SessionOptions options = quick(OperatorKind::expert, seed);
  options.tracking = by;
  return options;
}

TEST(TrackingModelSession, EvidenceAndReportSayThatTheBoardWasTrackedByAModel) {
  for (const Tracking by : {Tracking::images, Tracking::model}) {
    const SessionOptions options = tracked(by);
    Quick<NeedleWorld> world(options);
    const std::filesystem::path folder = freshPlace("tracked_by");
    const SessionResult session = runNeedleSession(options, world, folder);
    ASSERT_TRUE(session.accuracy);
    EXPECT_EQ(session.accuracy->registered, session.accuracy->pictures);
    EXPECT_LT(session.accuracy->entry_p95_mm, 3);
    const record::SessionReader evidence(folder / "session.palpa");
    const bool model = by == Tracking::model;
    EXPECT_EQ(nlohmann::json::parse(evidence.info().session_json).at("tracking"),
              model ? "model" : "images");
    bool said = false;
    for (const report::Fact& fact : stationFactsOf(options, world.station))
      said = said || fact.value == "tracked by a model";
    EXPECT_EQ(said, model);
  }
}

TEST(TrackingModelSession, RepeatsExactly) {
  std::vector<double> totals, errors_mm;
  for (int i = 0; i < 2; ++i) {
    const SessionOptions options = tracked(Tracking::model);
    Quick<NeedleWorld> world(options);
    const SessionResult session = runNeedleSession(options, world, freshPlace("repeats"));
    totals.push_back(session.trials.at(0).assessment.total);
    errors_mm.push_back(session.accuracy.value().entry_median_mm);
  }
  EXPECT_EQ(totals[0], totals[1]);
  EXPECT_EQ(errors_mm[0], errors_mm[1]);
}

TEST(TrackingModelSession, TakesThePlaceOnlyOfPicturesThatNobodySees) {
  const auto refused = [](const auto& change) {
    SessionOptions options = tracked(Tracking::model);
    change(options);
    EXPECT_THROW(settle(options), UsageError);
  };
  refused([](SessionOptions& o) { o.fast = false; });
  refused([](SessionOptions& o) { o.no_views = false; });
  refused([](SessionOptions& o) { o.record_video = true; });
  refused([](SessionOptions& o) {
    o.camera = "shots/*.png";
    o.intrinsics = "lens.json";
    o.board = "tags:6x4:0.030:0.0075";
  });
  SessionOptions good = tracked(Tracking::model);
  EXPECT_NO_THROW(settle(good));
}

/// What the model was not measured on.
TEST(TrackingModelSession, NeedsABenchWithTheTablesBoardAndAGoodCamera) {
  const SessionOptions options = tracked(Tracking::model);
  const NeedleWorld world(options);
  EXPECT_NO_THROW(SessionPictures(options, world.station));
  const auto refused = [&](const char* word, const auto& change) {
    station::Station station = world.station;
    change(station);
    try {
      const SessionPictures pictures(options, station);
      ADD_FAILURE() << word;
    } catch (const UsageError& e) {
      EXPECT_NE(std::string(e.what()).find(word), std::string::npos) << e.what();
    }
  };
  refused("boards", [](station::Station& s) { s.boards.emplace_back(); });
  refused("tracker", [](station::Station& s) { s.tracker.emplace(); });
  refused("camera", [](station::Station& s) { s.design.camera.width = 1280; });
  refused("board", [](station::Station& s) { s.board.rows = 5; });
  const auto inTwin = [](station::Station& s, const char* field, const nlohmann::json& value) {
    nlohmann::json file = s.file.json();
    file["twin"][field] = value;
    s.file = JsonFile(file, s.file.name());
  };
  refused("camera_faults", [&](station::Station& s) {
    inTwin(s, "camera_faults", {{{"kind", "hidden"}, {"from_s", 1}, {"to_s", 2}}});
  });
  refused("camera_distance_mm",
          [&](station::Station& s) { inTwin(s, "camera_distance_mm", 1500); });
}

/// Log of a trial's total with each kind of tracking.
struct Pairs {
  std::vector<double> images, model;
};

void addPair(std::uint64_t seed, NeedleWorld& world, Pairs* pairs) {
  for (const Tracking by : {Tracking::images, Tracking::model}) {
    const SessionResult session =
        runNeedleSession(tracked(by, seed), world, freshPlace("equivalence"));
    const double total = session.trials.at(0).assessment.total;
    (by == Tracking::model ? pairs->model : pairs->images)
        .push_back(std::log(std::max(total, 1.0)));
  }
}

/// Same scores. Without views a simulated hand sees the needle in the patient, wherever both are in
/// the camera's picture: a score depends on tracking only by whether and when the board is seen. So
/// most pairs are equal; what is shown is that nothing else gets through.
/// Two one-sided tests by paired seeds, on the log of the total, margin 10 %. The
/// number of pairs is planned on other seeds, as if pairs had nothing in common: any two sessions
/// with pictures differ by their own scatter times the root of two.
TEST(TrackingModelSession, ScoresAreThoseOfPictures) {
  constexpr double kPower = 0.9;
  constexpr int kLeastPairs = 500;
  constexpr std::uint64_t kPilot = 40001, kJudged = 50001;
  const double margin = std::log(1.1);
  const SessionOptions options = tracked(Tracking::images);
  const auto made = test::fullCounts() ? std::make_unique<NeedleWorld>(options)
                                       : std::make_unique<Quick<NeedleWorld>>(options);
  Pairs pilot, judged;
  const int tried = test::counted(2, 24);
  for (int i = 0; i < tried; ++i) addPair(kPilot + std::uint64_t(i), *made, &pilot);
  const double sd = std::numbers::sqrt2 * statistics::momentsOf(pilot.images).sd;
  const int planned =
      std::max(sd > 0 ? statistics::pairsForEquivalence(margin / sd, kPower) : 2, kLeastPairs);
  std::printf("planned: %d pairs for a power of %.1f, differences scattering by %.3f (%d others)\n",
              planned, kPower, sd, tried);
  const int pairs = test::counted(2, planned);
  for (int i = 0; i < pairs; ++i) {
    addPair(kJudged + std::uint64_t(i), *made, &judged);
    if (i % 10 == 9) std::printf("%d of %d pairs\n", i + 1, pairs), std::fflush(stdout);
  }
  const statistics::Equivalence result =
      statistics::equivalenceOfPairs(judged.model, judged.images, margin);
  std::printf(
      "%d pairs: the model's total is %.4f times that of pictures (90 %%: %.4f to %.4f), "
      "differences scatter by %.4f, p = %.2g\n",
      pairs, std::exp(result.difference), std::exp(result.low), std::exp(result.high), result.sd,
      result.p);
  // Two pairs may differ by chance, as two trials of one operator do; all of them may not.
  if (test::fullCounts())
    EXPECT_LT(result.p, 0.05);
  else
    EXPECT_LT(std::abs(result.difference), 2 * std::log(2));
}

}  // namespace
}  // namespace palpa::session

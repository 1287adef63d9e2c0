#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <memory>
#include <nlohmann/json.hpp>
#include <utility>

#include "anatomy/base/error.h"
#include "anatomy/base/whole_file.h"
#include "apps/assess/statistics/power.h"
#include "apps/assess/statistics/sample.h"
#include "apps/assess/statistics/tests_of_means.h"
#include "apps/record/session_file.h"
#include "apps/session/session_facts.h"
#include "apps/session/session_pictures.h"
#include "apps/station/assets.h"
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
    for (const report::Fact& fact : headOf(options, "", {}, world.station, true).station)
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

/// Of sessions with each kind of tracking, seed by seed, a figure's logarithms.
struct Pairs {
  std::vector<double> images, model;

  std::size_t alike() const {
    std::size_t n = 0;
    for (std::size_t i = 0; i < images.size(); ++i) n += images[i] == model[i];
    return n;
  }
};

struct Figures {
  double log_total;  ///< of the trial's score
  double log_error;  ///< mm; of the registration at the entry point, the report's median
};

Figures figuresOf(Tracking by, std::uint64_t seed, NeedleWorld& world) {
  const SessionResult session =
      runNeedleSession(tracked(by, seed), world, freshPlace("equivalence"));
  return {std::log(std::max(session.trials.at(0).assessment.total, 1.0)),
          std::log(session.accuracy.value().entry_median_mm)};
}

struct Compared {
  Pairs totals, errors;
};

void addPair(std::uint64_t seed, NeedleWorld& world, Compared* all) {
  const Figures images = figuresOf(Tracking::images, seed, world),
                model = figuresOf(Tracking::model, seed, world);
  all->totals.images.push_back(images.log_total);
  all->totals.model.push_back(model.log_total);
  all->errors.images.push_back(images.log_error);
  all->errors.model.push_back(model.log_error);
}

/// Pairs that are needed for this margin, planned on those of other seeds.
int plannedBy(const char* name, const Pairs& pilot, double margin) {
  constexpr double kPower = 0.9, kUpper = 1.33;  // what 24 pairs scatter by: its 95 % upper bound
  const double sd = statistics::equivalenceOfPairs(pilot.model, pilot.images, margin).sd;
  const int needed = sd > 0 ? statistics::pairsForEquivalence(margin / (kUpper * sd), kPower) : 2;
  std::printf("%s: differences scatter by %.4f (%zu pairs of other seeds), %d pairs needed\n", name,
              sd, pilot.images.size(), needed);
  return needed;
}

int plannedPairs(NeedleWorld& world, double margin) {
  constexpr std::uint64_t kPilot = 40001;
  constexpr int kLeastPairs = 500;
  Compared pilot;
  for (int i = 0; i < 24; ++i) addPair(kPilot + std::uint64_t(i), world, &pilot);
  return std::max({plannedBy("total", pilot.totals, margin),
                   plannedBy("error", pilot.errors, margin), kLeastPairs});
}

statistics::Equivalence judged(const char* name, const Pairs& pairs, double margin) {
  const statistics::Equivalence e =
      statistics::equivalenceOfPairs(pairs.model, pairs.images, margin);
  std::printf(
      "%s: %zu pairs, %zu alike to the bit; with the model %.4f times that with pictures (90 %%: "
      "%.4f to %.4f), differences scatter by %.4f, p = %.2g\n",
      name, pairs.images.size(), pairs.alike(), std::exp(e.difference), std::exp(e.low),
      std::exp(e.high), e.sd, e.p);
  return e;
}

/// A model's errors times this must not pass. What a report states is only in part the tracking's:
/// where that part is small, errors twice as large are within the margin, and rightly so. (Of 500
/// sessions 5 % of the stated error's square was the tracking's, so that twice its errors made the
/// stated one 1.08 times as large, and three times should make it 1.20.)
constexpr double kWrong = 3;
Pairs wrongErrors(const Pairs& right, std::uint64_t first_seed, NeedleWorld& world) {
  const std::filesystem::path folder = freshPlace("wrong_figures");
  std::filesystem::create_directories(folder);
  nlohmann::json figures = JsonFile(station::assetFile("tracking/virtual_camera.json")).json();
  for (nlohmann::json& distance : figures["distances"])
    for (const char* part : {"bias_px", "strength"})
      for (nlohmann::json& value : distance[part]) value = kWrong * value.get<double>();
  writeWhole(folder / "figures.json", figures.dump(), Lasts::no);
  nlohmann::json station = world.station.file.json();
  station["twin"]["tracking_figures"] = (folder / "figures.json").string();
  const JsonFile before = std::exchange(world.station.file, JsonFile(station, "station.json"));
  Pairs pairs;
  for (std::size_t i = 0; i < right.images.size(); ++i) {
    pairs.images.push_back(right.images[i]);
    pairs.model.push_back(figuresOf(Tracking::model, first_seed + i, world).log_error);
  }
  world.station.file = before;
  return pairs;
}

/// Same scores: two one-sided tests by paired seeds, on the log of the total, margin 10 %; and the
/// same of the registration's error that a report states, which comes from the tracked poses.
///
/// Of the first little is to be feared. Without views a simulated hand sees the needle in the
/// patient, not in a picture: a score depends on tracking only by whether and when the board is
/// seen. So most pairs are alike, and what is shown is that nothing else gets through. The second
/// is where a wrong model would show.
TEST(TrackingModelSession, ScoresAndStatedErrorsAreThoseOfPictures) {
  constexpr std::uint64_t kJudged = 50001;
  const double margin = std::log(1.1);
  const SessionOptions options = tracked(Tracking::images);
  const auto world = test::fullCounts() ? std::make_unique<NeedleWorld>(options)
                                        : std::make_unique<Quick<NeedleWorld>>(options);
  const int pairs = test::fullCounts() ? plannedPairs(*world, margin) : 3;
  Compared all;
  for (int i = 0; i < pairs; ++i) {
    addPair(kJudged + std::uint64_t(i), *world, &all);
    if (i % 10 == 9) std::printf("%d of %d pairs\n", i + 1, pairs), std::fflush(stdout);
  }
  const statistics::Equivalence total = judged("total", all.totals, margin),
                                error = judged("error", all.errors, margin);
  if (test::fullCounts()) {
    EXPECT_LT(total.p, 0.05);
    EXPECT_LT(error.p, 0.05);
    const statistics::Equivalence control =
        judged("error of a wrong model", wrongErrors(all.errors, kJudged, *world), margin);
    EXPECT_GT(control.p, 0.05);
  }
  // Where pairs are few, chance is allowed for: as much as they show themselves.
  for (const statistics::Equivalence& e : {total, error})
    EXPECT_LT(std::abs(e.difference) - 4 * e.sd / std::sqrt(double(pairs)), margin);
}

}  // namespace
}  // namespace palpa::session

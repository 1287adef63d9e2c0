#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <numeric>
#include <utility>

#include "anatomy/base/whole_file.h"
#include "apps/bench/pictures/tracking_fit.h"
#include "apps/bench/pictures/tracking_scene.h"
#include "apps/station/assets.h"
#include "tests/support/counts.h"
#include "tests/support/files.h"

/// The tracking model beside the pictures that it stands for, on other seeds than its figures are
/// from.
namespace palpa::bench {
namespace {

/// The shipped bench with its camera elsewhere.
station::Station benchAt(double distance_mm) {
  nlohmann::json file = JsonFile(station::assetFile("stations/virtual_bench.json")).json();
  file["twin"]["camera_distance_mm"] = distance_mm;
  const std::filesystem::path path = test::freshFolder("bench", "tracking") / "station.json";
  writeWhole(path, file.dump(), Lasts::no);
  return station::readStation(path);
}

struct Both {
  std::vector<TrackedSession> pictures, model;
};

/// `wrong`: with the model's figures made so many times as large.
Both bothAt(double distance_mm, int sessions, double wrong = 1) {
  constexpr int kPictures = 45;
  constexpr std::uint64_t kFirstSeed = 80001;  // while the model was made, others were looked at
  const station::Station station = benchAt(distance_mm);
  twin::TrackingFigures figures = twin::trackingFiguresOf(station);
  for (twin::TrackingFigures::Distance& at : figures.distances) {
    for (ar::Vector6& bias : at.bias) bias *= wrong;
    for (double& strength : at.strength) strength *= wrong;
  }
  Both both;
  for (int i = 0; i < sessions; ++i) {
    const std::uint64_t seed = kFirstSeed + std::uint64_t(i);
    both.pictures.push_back(trackedSession(station, seed, kPictures, TrackedBy::pictures, figures));
    both.model.push_back(trackedSession(station, seed, kPictures, TrackedBy::model, figures));
  }
  return both;
}

using Figure = double (*)(const PathFigures&);

std::vector<TrackedSession> without(std::size_t i, std::vector<TrackedSession> all) {
  all.erase(all.begin() + std::ptrdiff_t(i));
  return all;
}

/// Standard error of the difference between the figures of both kinds of tracking: each session
/// left out in turn (jackknife).
double standardError(const Both& both, Figure figure) {
  const std::size_t n = both.pictures.size();
  std::vector<double> differences;
  for (std::size_t i = 0; i < n; ++i)
    differences.push_back(figure(figuresOf(without(i, both.model))) -
                          figure(figuresOf(without(i, both.pictures))));
  const double mean = std::accumulate(differences.begin(), differences.end(), 0.0) / double(n);
  double squares = 0;
  for (const double x : differences) squares += (x - mean) * (x - mean);
  return std::sqrt(squares * double(n - 1) / double(n));
}

/// Whether within this share of the pictures' figure, or of `whole` where that is given; where
/// sessions are few, give or take four standard errors.
bool areAlike(const char* name, const Both& both, Figure figure, double share, double whole = 0) {
  const double pictures = figure(figuresOf(both.pictures)), model = figure(figuresOf(both.model));
  const double error = standardError(both, figure),
               allowed =
                   share * (whole > 0 ? whole : pictures) + (test::fullCounts() ? 0 : 4 * error);
  std::printf("%s: pictures %.4f, model %.4f, difference known to %.4f, allowed %.4f\n", name,
              pictures, model, error, allowed);
  return std::abs(model - pictures) <= allowed;
}

/// Root mean squares within `share`; correlations within `correlation`; missed ones within a
/// hundredth of all tags, a twentieth of all pictures.
void expectAllAlike(const Both& both, double share, double correlation) {
  const std::pair<const char*, Figure> spreads[]{
      {"shift, mm", [](const PathFigures& f) { return f.shift_mm; }},
      {"turn, mrad", [](const PathFigures& f) { return f.turn_mrad; }},
      {"filtered shift, mm", [](const PathFigures& f) { return f.filtered_shift_mm; }},
      {"filtered turn, mrad", [](const PathFigures& f) { return f.filtered_turn_mrad; }}};
  for (const auto& [name, figure] : spreads)
    EXPECT_TRUE(areAlike(name, both, figure, share)) << name;
  const std::pair<const char*, Figure> correlations[]{
      {"autocorrelation, 1", [](const PathFigures& f) { return f.autocorrelation[0]; }},
      {"autocorrelation, 3", [](const PathFigures& f) { return f.autocorrelation[1]; }},
      {"autocorrelation, 8", [](const PathFigures& f) { return f.autocorrelation[2]; }},
      {"autocorrelation, 15", [](const PathFigures& f) { return f.autocorrelation[3]; }}};
  for (const auto& [name, figure] : correlations)
    EXPECT_TRUE(areAlike(name, both, figure, correlation, 1)) << name;
  EXPECT_TRUE(areAlike(
      "tags missed", both, [](const PathFigures& f) { return f.tags_missed; }, 0.01, 1));
  EXPECT_TRUE(areAlike(
      "poses missed", both, [](const PathFigures& f) { return f.poses_missed; }, 0.05, 1));
}

/// Where the shipped benches have their camera.
TEST(TrackingModel, PoseErrorsAreThoseOfPictures) {
  expectAllAlike(bothAt(500, test::counted(24, 800)), 0.05, 0.05);
}

/// A model that is wrong by a quarter (of few sessions: by all) is told from pictures.
TEST(TrackingModel, AWrongModelIsFoundOut) {
  const Both both = bothAt(500, test::counted(8, 100), test::counted(2.0, 1.25));
  EXPECT_FALSE(areAlike(
      "shift, mm", both, [](const PathFigures& f) { return f.shift_mm; }, 0.05));
}

/// Where the picture's edge begins to cut tags.
TEST(TrackingModel, PoseErrorsAreNearlyThoseOfPicturesNearby) {
  expectAllAlike(bothAt(470, test::counted(8, 400)), 0.1, 0.1);
}

/// Where tags are so small that some are not found the model is coarser: the correlation of
/// successive pictures is 0.12 too low (apps/twin/README.md).
TEST(TrackingModel, PoseErrorsAreNearlyThoseOfPicturesFarAway) {
  const Both both = bothAt(950, test::counted(12, 400));
  EXPECT_GT(figuresOf(both.pictures).tags_missed, 0.02);
  expectAllAlike(both, 0.1, 0.15);
}

/// Tags drawn as the model draws them give back what they were drawn with.
TEST(TrackingFit, FindsTheWidthsThatTagsWereDrawnWith) {
  RandomStream random(11, "test.widths");
  constexpr TagWidths kDrawn{14.5, 1.5};
  constexpr double kLasting = 0.6;
  std::vector<TagChance> tags;
  std::vector<std::array<TagChance, 2>> repeated;
  for (int i = 0; i < 20000; ++i) {
    const double width = random.uniform(9, 24), common = std::sqrt(kLasting) * random.normal();
    const auto found = [&] {
      return width >
             kDrawn.least + kDrawn.spread * (common + std::sqrt(1 - kLasting) * random.normal());
    };
    repeated.push_back({TagChance{width, found()}, TagChance{width, found()}});
    tags.push_back(repeated.back()[0]);
  }
  const TagWidths widths = fitTagWidths(tags);
  EXPECT_NEAR(widths.least, kDrawn.least, 0.1);  // some 5 sigma: 6,000 tags are in doubt
  EXPECT_NEAR(widths.spread, kDrawn.spread, 0.15);
  EXPECT_NEAR(lastingShareOf(repeated, widths), kLasting, 0.05);
  EXPECT_NEAR(leastWidthOf(tags, kDrawn.spread, 0), kDrawn.least, 0.15);
  EXPECT_EQ(leastWidthOf({{30, true}, {31, true}}, kDrawn.spread, 7), 7);
}

/// Sessions with errors of a known kind.
TEST(PathFigures, AreWhatTheyAreCalled) {
  TrackedSession session;
  for (int i = 0; i < 400; ++i) {
    const double wave = i % 2 ? 1 : -1;
    session.measured.push_back({Vec3(3 + wave, 0, 4), Vec3(0, 2, 0)});
    session.filtered.push_back({Vec3(3, 0, 4), Vec3(0, 0, 1)});
  }
  session.pictures = 500;
  session.tags_missed = 100;
  const PathFigures f = figuresOf({session, session});
  EXPECT_NEAR(f.shift_mm, std::sqrt(26.0), 1e-9);
  EXPECT_NEAR(f.turn_mrad, 2, 1e-12);
  EXPECT_NEAR(f.filtered_shift_mm, 5, 1e-12);
  EXPECT_NEAR(f.filtered_turn_mrad, 1, 1e-12);
  EXPECT_NEAR(f.tags_missed, 0.2, 1e-12);
  EXPECT_NEAR(f.poses_missed, 0.2, 1e-12);
  EXPECT_NEAR(f.autocorrelation[0], -1, 1e-9);  // about its mean
  EXPECT_NEAR(f.autocorrelation[2], 1, 1e-9);
}

}  // namespace
}  // namespace palpa::bench

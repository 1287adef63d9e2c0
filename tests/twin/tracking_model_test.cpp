#include "apps/twin/tracking_model.h"

#include <gtest/gtest.h>

#include <Eigen/Cholesky>

#include "anatomy/base/error.h"
#include "apps/station/assets.h"
#include "apps/twin/bench_truth.h"
#include "tests/support/counts.h"

/// The model by itself: what it says of its errors is what the tracker finds. How well it stands
/// for pictures is judged by tests/bench.
namespace palpa::twin {
namespace {

using ar::Matrix6;
using ar::Vector6;

calibration::CameraModel lens() {
  return {640, 480, 602, 601, 322, 237, {-0.21, 0.09, 0.0006, -0.0004, 0}, 0};
}

/// No error at all.
TrackingFigures perfect() {
  TrackingFigures f;
  f.width = 640;
  f.height = 480;
  f.fx = 602;
  f.decimate = 2;
  f.aside = {-0.2, 0.2};
  f.width_spread = 0.1;
  for (const double distance : {0.3, 1.5}) {
    TrackingFigures::Distance& d = f.distances.emplace_back();
    d.distance = distance;
    d.least_width = {5, 5};
    d.strength = {1, 1};
    d.bias.assign(2, Vector6::Zero());
    d.wander.fill(Vector6::Zero());
  }
  return f;
}

template <class Change>
TrackingFigures with(const Change& change) {
  TrackingFigures f = perfect();
  for (TrackingFigures::Distance& d : f.distances) change(&d);
  return f;
}

/// The error of the best pose, z = L' e, and that pose's misfit.
struct Found {
  Vector6 z;
  double rms_px;
};
Found foundBy(const TrackingModel& model, const Pose& X, std::uint64_t number) {
  const ar::RefinedPose pose = ar::refinePose(X, model.found(X, number), lens());
  return {Eigen::LLT<Matrix6>(pose.information).matrixU() * ar::difference(pose.X_CW, X),
          pose.rms_px};
}

TEST(TrackingModel, WithoutErrorsTheCornersAreTheTrueOnes) {
  const Pose X = boomView(0.5, 0.03);
  const std::vector<ar::BoardPoint> points = TrackingModel(perfect(), lens(), 1).found(X, 7);
  ASSERT_EQ(points.size(), 96u);
  for (const ar::BoardPoint& point : points)
    EXPECT_LT((lens().project(X * point.p_W) - point.pixel).norm(), 1e-9);
}

TEST(TrackingModel, MissesOfCornersMoveNoPose) {
  const TrackingModel model(with([](auto* d) { d->corner_sigma = 0.1; }), lens(), 1);
  double squares = 0;
  constexpr int kPictures = 50;
  for (int i = 0; i < kPictures; ++i) {
    const Found found = foundBy(model, boomView(0.5, 0.001 * i), std::uint64_t(i));
    EXPECT_LT(found.z.norm(), 3e-3);  // second order: 0.1 px over the board's 300
    squares += found.rms_px * found.rms_px / kPictures;
  }
  // 192 coordinates less the pose's six: over 50 pictures known to 0.7 %.
  EXPECT_NEAR(std::sqrt(squares), 0.1 * std::sqrt(186 / 96.0), 0.004);
}

TEST(TrackingModel, BiasIsFoundAgain) {
  Vector6 bias;
  bias << 0.1, -0.05, 0.2, 0.15, -0.3, 0.05;
  const TrackingModel model(with([&](auto* d) { d->bias = {bias, 3 * bias}; }), lens(), 1);
  const double across = 0.1 / std::sqrt(1 - 0.01);  // three quarters of the way
  EXPECT_LT((foundBy(model, boomView(0.7, across), 1).z - 2.5 * bias).norm(),
            0.03);  // of 1.1, second order
}

TEST(TrackingModel, WhiteErrorsHaveTheStatedSpreadAndNoMemory) {
  Vector6 white;
  white << 0.1, 0.2, 0.3, 0.1, 0.2, 0.05;
  const TrackingModel model(with([&](auto* d) { d->white = white; }), lens(), 1);
  const Pose X = boomView(0.5, 0);
  Vector6 squares = Vector6::Zero(), products = Vector6::Zero(), before = Vector6::Zero();
  const int pictures = test::counted(400, 4000);
  for (int i = 0; i < pictures; ++i) {
    const Vector6 z = foundBy(model, X, std::uint64_t(i)).z.cwiseQuotient(white);
    squares += z.cwiseAbs2() / pictures;
    products += z.cwiseProduct(before) / pictures;
    before = z;
  }
  const double four_sigma = 4 / std::sqrt(double(pictures));
  for (int k = 0; k < 6; ++k) {
    EXPECT_NEAR(squares[k], 1, four_sigma * std::sqrt(2)) << k;
    EXPECT_NEAR(products[k], 0, four_sigma) << k;
  }
}

TEST(TrackingModel, WavesRepeatAfterTwoPixelsAndHaveTheStatedCorrelation) {
  RandomStream random(3, "test.waves");
  double squares = 0, products = 0, expected = 0;
  const int waves = test::counted(4800, 24000);
  const Eigen::Vector2d apart(0.15, -0.2);
  for (int i = 0; i < waves; ++i) {
    const std::size_t kind = std::size_t(i) % TrackingFigures::kWaves;
    const PixelWave wave(random, kind);
    const Eigen::Vector2d at(100 * random.uniform(), 100 * random.uniform());
    squares += wave.at(at) * wave.at(at) / waves;
    products += wave.at(at) * wave.at(at + apart) / waves;
    expected += PixelWave::correlation(kind, apart) / waves;
    EXPECT_NEAR(wave.at(at), wave.at(at + Eigen::Vector2d(2, 4)), 1e-9);
  }
  EXPECT_NEAR(squares, 1, 4 * std::sqrt(2.0 / waves));
  EXPECT_NEAR(products, expected, 4 * std::sqrt(2.0 / waves));
}

TEST(TrackingModel, APictureIsAFunctionOfSeedPoseAndNumber) {
  const TrackingFigures figures = with([](auto* d) {
    d->corner_sigma = 0.1;
    d->lasting.setConstant(0.1);
  });
  const Pose X = boomView(0.5, 0);
  const TrackingModel one(figures, lens(), 1), same(figures, lens(), 1), other(figures, lens(), 2);
  one.found(X, 5);  // what was asked before changes nothing
  EXPECT_EQ(one.found(X, 9).at(3).pixel, same.found(X, 9).at(3).pixel);
  EXPECT_NE(one.found(X, 9).at(3).pixel, one.found(X, 10).at(3).pixel);
  EXPECT_NE(one.found(X, 9).at(3).pixel, other.found(X, 9).at(3).pixel);
}

double shareFound(const TrackingFigures& figures, const Pose& X) {
  double found = 0;
  constexpr int kSessions = 100;
  for (int i = 0; i < kSessions; ++i)
    found += double(TrackingModel(figures, lens(), std::uint64_t(i)).found(X, 1).size()) / 96 /
             kSessions;
  return found;
}

TEST(TrackingModel, NarrowTagsAreNotFound) {
  TrackingFigures figures = with([](auto* d) { d->least_width = {14.5, 14.5}; });
  const Pose X = boomView(1.0, 0);
  figures.width_spread = 1;
  for (const double lasting : {0.0, 1.0}) {
    figures.width_lasting = lasting;
    EXPECT_GT(shareFound(figures, boomView(0.5, 0)), 0.999);
    EXPECT_LT(shareFound(figures, boomView(1.5, 0)), 0.02);
    double expected = 0;
    for (int id = 0; id < 24; ++id) {
      std::array<Eigen::Vector2d, 4> pixels;
      for (std::size_t c = 0; c < 4; ++c) pixels[c] = lens().project(X * ar::tagCorners({}, id)[c]);
      expected += 0.5 * std::erfc((14.5 - narrowest(pixels)) / std::sqrt(2.0)) / 24;
    }
    EXPECT_NEAR(shareFound(figures, X), expected, 0.04);  // 2,400 tags: four sigma
  }
}

TEST(TrackingModel, TagsThatReachOverThePicturesEdgeAreNotFound) {
  Pose X = boomView(0.5, 0);
  X.translation().x() += 0.28;  // the board's right half leaves the picture
  const std::size_t found = TrackingModel(perfect(), lens(), 1).found(X, 1).size();
  EXPECT_GT(found, 0u);
  EXPECT_LT(found, 96u);
  EXPECT_EQ(found % 4, 0u);
  X.translation().x() += 5;
  EXPECT_TRUE(TrackingModel(perfect(), lens(), 1).found(X, 1).empty());
}

station::Station shippedStation() {
  return station::readStation(station::assetFile("stations/virtual_bench.json"));
}

TEST(TrackingFigures, AreThereForTheShippedBenches) {
  for (const char* name : {"virtual_bench", "palpation_bench", "search_bench", "falcon"}) {
    const auto station =
        station::readStation(station::assetFile(std::string("stations/") + name + ".json"));
    EXPECT_GE(trackingFiguresOf(station).distances.size(), 2u) << name;
  }
}

/// What the figures were not measured on is refused.
TEST(TrackingFigures, AreOfOneCameraAndBoard) {
  station::Station camera = shippedStation(), board = shippedStation(), decimate = shippedStation();
  camera.design.camera.width = 1280;
  board.board.columns = 5;
  decimate.decimate = 1;
  for (const station::Station& other : {camera, board, decimate})
    EXPECT_THROW(trackingFiguresOf(other), UsageError);
}

/// Too few numbers, or too many, would be read beyond their end.
TEST(TrackingFigures, HaveAsManyNumbersAsPlaces) {
  const JsonFile shipped(station::assetFile("tracking/virtual_camera.json"));
  for (const char* field :
       {"bias_px", "strength", "least_width_px", "lasting_px", "white_px", "wander_px"}) {
    nlohmann::json less = shipped.json(), more = less;
    nlohmann::json &few = less["distances"][1][field], &many = more["distances"][1][field];
    few.erase(0);
    many.push_back(many[0]);
    for (const nlohmann::json& wrong : {less, more})
      EXPECT_THROW(trackingFiguresIn(JsonFile(wrong, "figures.json")), UsageError) << field;
  }
}

TEST(TrackingFigures, AreReadAsTheyWereWritten) {
  const TrackingFigures figures = trackingFiguresOf(shippedStation());
  const std::filesystem::path shipped = station::assetFile("tracking/virtual_camera.json");
  nlohmann::json file = JsonFile(shipped).json(), again = jsonOf(figures);
  for (const char* remark : {"about", "source"}) file.erase(remark);
  EXPECT_EQ(file, again);
}

}  // namespace
}  // namespace palpa::twin

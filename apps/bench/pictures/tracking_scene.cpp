#include "apps/bench/pictures/tracking_scene.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>

#include <opencv2/core/utility.hpp>
#include <opencv2/imgproc.hpp>

#include "anatomy/base/random.h"
#include "apps/twin/bench_truth.h"
#include "ar/boards/board.h"
#include "ar/tracking/board_tracker.h"
#include "calibration/rotation.h"

namespace palpa::bench {
namespace {

constexpr double kNoise = 3;     // gray levels, a webcam's
constexpr double kFocal = 0.73;  // picture widths: 69 degrees across
constexpr double kWay = 1.0;     // s from one end to the other
constexpr double kPeakOverMean = 1.875;

/// A lens as webcams have it.
calibration::CameraModel webcamOf(int width, int height) {
  calibration::CameraModel camera;
  camera.width = width;
  camera.height = height;
  camera.fx = kFocal * width;
  camera.fy = 1.002 * camera.fx;
  camera.cx = 0.507 * width;
  camera.cy = 0.494 * height;
  camera.distortion = {0.05, -0.11, 0.0006, -0.0004, 0.02};
  return camera;
}

twin::VirtualCameraSettings settingsOf(double noise) {
  twin::VirtualCameraSettings settings;
  settings.noise_sigma = noise;
  return settings;
}

}  // namespace

TrackingScene::TrackingScene(const TrackingBenchOptions& options)
    : camera_(webcamOf(options.width, options.height)),
      board_(ar::makeBoard(spec_, 1.0)),
      noisy_(
          std::make_unique<twin::VirtualCamera>(camera_, spec_, settingsOf(kNoise), options.seed)),
      clean_(std::make_unique<twin::VirtualCamera>(camera_, spec_, settingsOf(0), options.seed)),
      seed_(options.seed) {}

Pose TrackingScene::view(double distance, double tilt, double azimuth, double roll) {
  const Mat3 R = calibration::rotationOf(roll * Vec3::UnitZ()) *
                 calibration::rotationOf(tilt * Vec3::UnitX()) * calibration::halfTurnAboutX() *
                 calibration::rotationOf(azimuth * Vec3::UnitZ());
  return makePose(R, Vec3(0, 0, distance));
}

Pose TrackingScene::anyView(RandomStream& random, double distance, double most_tilt) const {
  constexpr double kTurn = 2 * std::numbers::pi;
  const double tilt = most_tilt * random.uniform(), azimuth = kTurn * random.uniform(),
               roll = kTurn * random.uniform();
  return view(distance, tilt, azimuth, roll);
}

cv::Mat TrackingScene::still(const Pose& X_CW, std::uint64_t number) const {
  return noisy_->render(X_CW, number);
}

void TrackingScene::add(const Pose& X_CW, double weight, cv::Mat* sum) const {
  cv::scaleAdd(cv::Mat_<float>(clean_->render(X_CW, 0)), weight, *sum, *sum);
}

cv::Mat TrackingScene::exposed(const cv::Mat& sum, std::uint64_t number) const {
  cv::Mat noise(sum.size(), CV_32F), picture;
  cv::RNG random(seed_ * 1'000'003 + number);
  random.fill(noise, cv::RNG::NORMAL, 0, kNoise);
  cv::Mat(sum + noise).convertTo(picture, CV_8U);
  return picture;
}

Pose HandMotion::operator()(double t) const {
  const double u = std::abs(std::fmod(t / kWay, 2.0) - 1),
               s = u * u * u * (10 - 15 * u + 6 * u * u) - 0.5;
  const double way = peak_ * kWay / kPeakOverMean;
  Pose X = X_CW_;
  X.linear() = calibration::rotationOf(s * Vec3(0.1, 0.15, 0.1)) * X.linear();
  X.translation() += way * s * Vec3(0.9, 0.3, 0.3).normalized();
  return X;
}

Vec3 HandMotion::velocity(double t, const Vec3& p_W) const {
  constexpr double kStep = 1e-4;
  return ((*this)(t + kStep) * p_W - (*this)(t - kStep) * p_W) / (2 * kStep);
}

namespace {

int below(RandomStream& random, int n) {
  return static_cast<int>(random.bits() % static_cast<std::uint64_t>(n));
}

cv::Mat noise(cv::Size size, RandomStream& random) {
  const int grain = 1 << below(random, 4);
  cv::Mat fine(size.height / grain, size.width / grain, CV_8U), picture;
  for (int row = 0; row < fine.rows; ++row)
    for (int column = 0; column < fine.cols; ++column)
      fine.at<unsigned char>(row, column) = static_cast<unsigned char>(random.bits() >> 56);
  cv::resize(fine, picture, size, 0, 0, below(random, 2) ? cv::INTER_NEAREST : cv::INTER_CUBIC);
  return picture;
}

cv::Mat text(cv::Size size, RandomStream& random) {
  cv::Mat page(size, CV_8U, cv::Scalar(240));
  const double scale = random.uniform(0.4, 2.0);
  const int font = below(random, 8), thickness = 1 + below(random, 4);
  for (int y = static_cast<int>(25 * scale); y < size.height; y += static_cast<int>(30 * scale)) {
    std::string line;
    for (int k = 0; k < 100; ++k) line += static_cast<char>('!' + below(random, 94));
    cv::putText(page, line, {5, y}, font, scale, 10, thickness, cv::LINE_AA);
  }
  return page;
}

/// Squares of one size in rows, `cellsOf(i)` a pixel a cell with a white border.
template <class CellsOf>
cv::Mat sheet(cv::Size size, RandomStream& random, const CellsOf& cells_of) {
  cv::Mat page(size, CV_8U, cv::Scalar(255));
  const int side = 30 + below(random, 90), pitch = side + side / 3;
  int i = 0;
  for (int y = 10; y + side < size.height; y += pitch)
    for (int x = 10; x + side < size.width; x += pitch)
      cv::resize(cells_of(i++), page(cv::Rect(x, y, side, side)), {side, side}, 0, 0,
                 cv::INTER_NEAREST);
  return page;
}

cv::Mat randomCells(RandomStream& random) {
  cv::Mat tag(10, 10, CV_8U, cv::Scalar(255));
  tag(cv::Rect(1, 1, 8, 8)) = 0;
  for (int j = 0; j < 36; ++j)
    if (below(random, 2)) tag.at<unsigned char>(2 + j / 6, 2 + j % 6) = 255;
  return tag;
}

}  // namespace

cv::Mat falsePicture(int i, cv::Size size, std::uint64_t seed) {
  constexpr int kLeastCodes = 30;  // of tag16h5, the smallest family
  RandomStream random(seed + static_cast<std::uint64_t>(i) * 7919, "bench.tracking.false");
  switch (i % 4) {
    case 0:
      return noise(size, random);
    case 1:
      return text(size, random);
    case 2: {
      const auto& families = ar::foreignTagFamilies();
      const std::string& family =
          families[static_cast<std::size_t>(below(random, static_cast<int>(families.size())))];
      return sheet(size, random,
                   [&](int k) { return ar::drawForeignTag(family, k % kLeastCodes); });
    }
    default:
      return sheet(size, random, [&](int) { return randomCells(random); });
  }
}

namespace {

constexpr double kPicturesPerSecond = 15;

std::vector<ar::BoardPoint> exactPoints(const ar::TagGridSpec& spec, const Pose& X,
                                        const calibration::CameraModel& truth) {
  std::vector<ar::BoardPoint> points;
  for (int i = 0; i < spec.columns * spec.rows; ++i)
    for (const Vec3& p_W : ar::tagCorners(spec, spec.first_id + i))
      points.push_back({p_W, truth.project(X * p_W)});
  return points;
}

}  // namespace

TrackedSession trackedSession(const station::Station& station, std::uint64_t seed, int pictures,
                              TrackedBy by, const twin::TrackingFigures& figures) {
  const calibration::CameraModel truth = twin::trueCamera(station, seed);
  const auto board = ar::makeBoard(station.board, station.decimate);
  std::optional<twin::VirtualCamera> camera;
  if (by == TrackedBy::pictures)
    camera.emplace(truth, station.board, twin::VirtualCameraSettings{}, seed);
  const twin::TrackingModel model(figures, truth, seed);
  ar::BoardTracker tracker(*board, station.camera);
  const Pose boom = twin::cameraOnBoom(station, seed);
  const double sway = twin::boomSway(station),
               corners = 4.0 * station.board.columns * station.board.rows;
  const Vec3 watched_W(0, 0.26, 0.1);
  TrackedSession session;
  for (; session.pictures < pictures; ++session.pictures) {
    const auto number = std::uint64_t(session.pictures);
    const std::int64_t t_ns = std::llround(1e9 / kPicturesPerSecond * session.pictures);
    const Pose X = twin::swayed(boom, sway, t_ns);
    const auto pose = camera ? tracker.see(camera->render(X, number), t_ns)
                             : tracker.take(model.found(X, number), t_ns);
    session.tags_missed += 1 - (pose ? pose->points : 0) / corners;
    const Pose exact = ar::refinePose(X, exactPoints(station.board, X, truth), station.camera).X_CW;
    const auto errorOf = [&](const Pose& X_CW) {
      return TrackedSession::Error{1e3 * (X_CW * watched_W - exact * watched_W),
                                   1e3 * ar::difference(X_CW, exact).head<3>()};
    };
    if (pose) session.measured.push_back(errorOf(pose->X_CW));
    const ar::PoseLookup filtered = tracker.track().at(t_ns);
    if (filtered.how != ar::Lookup::none) session.filtered.push_back(errorOf(filtered.X));
  }
  return session;
}

namespace {

struct RmsOf {
  double squares = 0, n = 0;
  void add(const Vec3& v) {
    squares += v.squaredNorm();
    ++n;
  }
  double value() const { return n > 0 ? std::sqrt(squares / n) : 0; }
};

}  // namespace

PathFigures figuresOf(const std::vector<TrackedSession>& sessions) {
  PathFigures figures;
  RmsOf shift, turn, filtered_shift, filtered_turn;
  std::array<double, kTrackingLags.size()> products{};
  double squares = 0, pictures = 0, poses = 0;
  for (const TrackedSession& session : sessions) {
    Vec3 mean = Vec3::Zero();
    const double n = std::max(double(session.measured.size()), 1.0);
    for (const auto& e : session.measured) {
      shift.add(e.shift_mm);
      turn.add(e.turn_mrad);
      mean += e.shift_mm / n;
    }
    for (const auto& e : session.filtered) {
      filtered_shift.add(e.shift_mm);
      filtered_turn.add(e.turn_mrad);
    }
    for (const auto& e : session.measured) squares += (e.shift_mm - mean).squaredNorm() / n;
    for (std::size_t l = 0; l < kTrackingLags.size(); ++l) {
      const auto lag = std::size_t(kTrackingLags[l]);
      if (session.measured.size() <= lag) continue;
      double sum = 0;
      for (std::size_t i = lag; i < session.measured.size(); ++i)
        sum += (session.measured[i].shift_mm - mean).dot(session.measured[i - lag].shift_mm - mean);
      products[l] += sum / double(session.measured.size() - lag);
    }
    figures.tags_missed += session.tags_missed;
    pictures += session.pictures;
    poses += double(session.measured.size());
  }
  figures.shift_mm = shift.value();
  figures.turn_mrad = turn.value();
  figures.filtered_shift_mm = filtered_shift.value();
  figures.filtered_turn_mrad = filtered_turn.value();
  for (std::size_t l = 0; l < kTrackingLags.size(); ++l)
    figures.autocorrelation[l] = squares > 0 ? products[l] / squares : 0;
  figures.tags_missed /= std::max(pictures, 1.0);
  figures.poses_missed = 1 - poses / std::max(pictures, 1.0);
  return figures;
}

}  // namespace palpa::bench

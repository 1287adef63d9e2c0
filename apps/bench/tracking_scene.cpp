#include "apps/bench/tracking_scene.h"

#include <cmath>
#include <numbers>
#include <opencv2/core/utility.hpp>

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

Pose TrackingScene::anyView(runtime::RandomStream& random, double distance,
                            double most_tilt) const {
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

}  // namespace palpa::bench

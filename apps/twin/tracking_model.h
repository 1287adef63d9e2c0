#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <filesystem>
#include <vector>

#include "anatomy/base/json_file.h"
#include "anatomy/base/random.h"
#include "apps/station/station_file.h"
#include "ar/boards/board.h"
#include "ar/tracking/board_pose.h"
#include "ar/tracking/pose_filter.h"

namespace palpa::twin {

/// How far poses from pictures are off, and which tags are not found, as `palpa bench tracking
/// --fit` measured it on pictures of one kind of camera and board, from the boom. Lengths in m, the
/// rest in pixels.
///
/// The error e of a pose from n corners is stated as z = L' e, where L L' = A is the corners'
/// information (the sum of J'J, J a pixel's derivative by the pose): in pixels, the same for
/// corners far and near, many and few. z is the sum of
///   bias      of the detector, by distance and place of the camera: edges that lie along rows or
///             columns of pixels are found worse
///   wander    by where the pattern lies on the sensor's pixels, which the camera's sway changes:
///             random waves along rows and along columns (PixelWave)
///   lasting   drawn once; this and `wander` times the place's `strength`
///   white     drawn for each picture
/// What misses the pose besides (`corner_sigma`) is white, and moves no pose.
struct TrackingFigures {
  static constexpr std::size_t kWaves = 12;  ///< of each of six
  struct Distance {
    double distance = 0;
    double corner_sigma = 0;
    // At each of `aside`
    std::vector<ar::Vector6> bias;
    std::vector<double> strength, least_width;  ///< the latter: of a tag of which half are found
    ar::Vector6 lasting = ar::Vector6::Zero(), white = ar::Vector6::Zero();
    std::array<ar::Vector6, kWaves> wander{};
  };
  // What was measured: a camera and a board
  int width = 0, height = 0;
  double fx = 0, decimate = 0;
  ar::TagGridSpec board;
  std::vector<double> aside;        ///< of the camera, to the board's right; share of the distance
  std::vector<Distance> distances;  ///< rising
  /// A tag is found that is wider than `least_width`, give or take a normal variate of
  /// `width_spread`, of whose variance the share `width_lasting` comes from where the tag lies on
  /// the pixels.
  double width_spread = 1, width_lasting = 0;
};

/// Throws UsageError with file and field.
TrackingFigures readTrackingFigures(const std::filesystem::path& file);
TrackingFigures trackingFiguresIn(const JsonFile& file);
/// The file that the station names ("twin/tracking_figures"), or the shipped one.
std::filesystem::path trackingFigureFile(const station::Station& station);
/// Those of that file. Throws UsageError, also where they are not for the station's camera, board
/// and distance.
TrackingFigures trackingFiguresOf(const station::Station& station);
/// The same as data, without remarks.
nlohmann::json jsonOf(const TrackingFigures& figures);

/// Whether all of a tag's corners lie within the picture: others are not found.
bool isInPicture(const std::array<Eigen::Vector2d, 4>& corners,
                 const calibration::CameraModel& camera);

/// How wide a tag is in a picture across its narrower direction, px: its area over its longest
/// edge.
double narrowest(const std::array<Eigen::Vector2d, 4>& corners);

/// A random function of where something lies on the sensor: mean 0, variance 1. Waves 0 to 5 run
/// along rows, 6 to 11 along columns, with periods of 2, 1, 2/3, 1/2, 1/3 and 1/4 px.
class PixelWave {
 public:
  PixelWave(RandomStream& random, std::size_t wave);
  double at(const Eigen::Vector2d& pixel) const;
  /// Correlation of two places, by what lies between them, px.
  static double correlation(std::size_t wave, const Eigen::Vector2d& apart);

 private:
  std::size_t wave_;
  double cosine_, sine_;  ///< amplitudes
};

/// In place of the virtual camera: the points of the station's board that would be found in its
/// pictures. A pure function of figures, true camera, board, seed, pose and number. Knows the
/// truth, as the virtual camera does; what it returns is all that the program sees.
class TrackingModel {
 public:
  TrackingModel(const TrackingFigures& figures, const calibration::CameraModel& truth,
                std::uint64_t seed);

  /// Pose of the board in the camera, number of the picture; empty: no tag is found.
  std::vector<ar::BoardPoint> found(const Pose& X_CW_true, std::uint64_t number) const;

 private:
  struct Corner {
    Vec3 p_W;
    ar::SeenPoint seen;
  };
  /// Where the camera is: with one `bias`, `strength` and `least_width`, those of its place.
  TrackingFigures::Distance figuresAt(const Pose& X_CW) const;
  std::vector<Corner> foundCorners(const Pose& X_CW, double least_width,
                                   RandomStream& random) const;
  ar::Vector6 error(const Pose& X_CW, const TrackingFigures::Distance& here,
                    RandomStream& random) const;

  TrackingFigures figures_;
  calibration::CameraModel truth_;
  std::uint64_t seed_;
  std::vector<PixelWave> wander_;                     ///< kWaves for each of six
  ar::Vector6 lasting_;                               ///< standard normal
  std::vector<std::array<PixelWave, 2>> tag_pixels_;  ///< of each tag: of a pixel, both ways
};

}  // namespace palpa::twin

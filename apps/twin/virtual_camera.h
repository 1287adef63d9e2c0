#pragma once

#include <cstdint>
#include <opencv2/core.hpp>
#include <span>
#include <vector>

#include "anatomy/geometry/pose.h"
#include "apps/twin/virtual_camera_picture.h"
#include "ar/boards/board.h"
#include "calibration/camera_model.h"

namespace palpa::twin {

/// What a real camera adds to a perfect picture.
struct VirtualCameraSettings {
  double blur_sigma_px = 0.6;   ///< lens and pixel, Gaussian
  double noise_sigma = 3;       ///< gray levels, at every brightness
  std::int64_t latency_ns = 0;  ///< from the middle of the exposure to delivery; the bench waits it
  double exposure = 1;          ///< relative brightness; white paper saturates from about 1.15 on
};

/// What there is to see besides the board on the table.
struct VirtualScene {
  enum class Ground {
    kTableWithBoard,
    kBareTable,  ///< the same table, no board on it
    kWall,       ///< no table: an even wall that stands still in the picture
  };
  Ground ground = Ground::kTableWithBoard;
  /// free sheets, known by their index; a single tag is 1 x 1
  std::vector<ar::TagGridSpec> plates;
};

/// Where one of the scene's plates is. B: the frame of its grid, as W is the board's
/// (ar/boards/board.h).
struct PlatePose {
  std::size_t plate = 0;
  Pose X_CB = Pose::Identity();
};

/// Honest pictures of flat tag boards, as the station's camera would take them: one on a table,
/// and plates that move freely. 8-bit gray, lens distortion exactly as CameraModel's, uneven light,
/// blur, noise.
///
/// Each pixel's ray is found once (CameraModel::unproject). A frame is a homography from rays to
/// the plane z_W = 0 and a look-up in one of a series of area-averaged textures, a factor sqrt(2)
/// apart, the one whose texels are nearest to a pixel's footprint at the board's centre: no edge is
/// aliased, and none is shifted, because every filter in the chain is symmetric. A plate is looked
/// up in the same way, and laid over the picture with the share of each pixel that its sheet
/// (ar::sheetSize) covers.
///
/// A pure function of (seed, frame number, poses); the noise comes from a counter-based stream.
class VirtualCamera {
 public:
  /// `board` gives a bare table its size. Throws Error or UsageError when camera, boards or
  /// settings are not possible.
  VirtualCamera(const calibration::CameraModel& truth, const ar::TagGridSpec& board,
                const VirtualCameraSettings& settings, std::uint64_t seed,
                const VirtualScene& scene = {});

  /// `X_CW_true`: pose of the board in the camera. A camera below the table sees nothing but its
  /// tone. Before a wall the pose means nothing.
  cv::Mat render(const Pose& X_CW_true, std::uint64_t frame_number) const;
  /// The same picture where only `part` of it will be looked at (empty: all): the rest is black.
  cv::Mat render(const Pose& X_CW_true, std::uint64_t frame_number, const cv::Rect& part) const;

  /// With plates before, over or under the table; those not named are out of sight. In each pixel
  /// the nearest of all planes wins, and the one named first of equally near ones; a plate that
  /// lies on the table is seen. From behind, a plate is white. Where two planes cut through each
  /// other the cut is not smoothed, unlike the edges of sheets. Throws UsageError for a plate that
  /// the scene does not have and for a pose that is not finite.
  cv::Mat render(const Pose& X_CW_true, std::span<const PlatePose> plates,
                 std::uint64_t frame_number) const;

  const calibration::CameraModel& truth() const { return truth_; }
  const VirtualCameraSettings& settings() const { return settings_; }

 private:
  struct Plate {
    Eigen::Vector2d size;  ///< metres
    picture::TextureSeries textures;
  };
  struct Layer;

  cv::Mat lookUp(const picture::GrayTexture& texture, const Mat3& ray_to_plane,
                 const cv::Rect& region) const;
  cv::Rect whole() const { return {0, 0, truth_.width, truth_.height}; }
  cv::Mat background(const Pose& X_CW, const cv::Rect& region) const;
  void blur(cv::Mat* picture) const;
  void expose(std::uint64_t frame_number, const cv::Rect& region, cv::Mat* picture) const;
  cv::Rect regionOf(const Plate& plate, const Pose& X_CB) const;
  Layer layerOf(const PlatePose& placed) const;
  void compose(const std::vector<Layer>& layers, const Vec3& table_nearness,
               cv::Mat* picture) const;

  calibration::CameraModel truth_;
  VirtualCameraSettings settings_;
  std::uint64_t seed_;
  cv::Mat ray_x_, ray_y_;                  ///< at unit depth, for every pixel
  std::vector<picture::RayBlock> blocks_;  ///< what the rays of each part of the picture span
  cv::Mat gain_;                           ///< light and exposure, 256 = 1
  cv::Mat wall_;                           ///< empty where there is a table
  picture::TextureSeries textures_;        ///< of the table
  std::vector<Plate> plates_;
  std::vector<std::int16_t> noise_;  ///< 1/16 gray levels
};

}  // namespace palpa::twin

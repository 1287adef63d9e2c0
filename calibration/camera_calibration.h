#pragma once

#include <array>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "anatomy/geometry/pose.h"
#include "calibration/camera_model.h"
#include "calibration/robust_fit.h"

namespace palpa::calibration {

/// A picture of a flat board: its corners on the board (frame W, z = 0, m) and in the picture (px),
/// in the same order. A part of the board's corners is enough.
struct BoardView {
  std::string name;  ///< for messages, usually the file
  std::vector<Vec3> p_W;
  std::vector<Eigen::Vector2d> pixels;
};

/// Throws Error (in `where`), with the view's name, for lists of unlike length, fewer than 8
/// corners, invalid figures, a board that is not flat, corners on one line, and views whose
/// boards differ (most of their corners are not the others').
void requireBoardViews(const std::vector<BoardView>& views, const std::string& where);

/// A camera, and where the board W was in each of its views.
struct CameraBundle {
  CameraModel model;
  std::vector<Pose> X_CW;
};

/// Zhang 2000 without distortion and with the centre in the middle of the picture: homographies H ~
/// K [r1 r2 t] of the views (least median of squares: half of a view's corners may be wrong), both
/// focal lengths from r1' r2 = 0 and |r1| = |r2|, then the poses. Throws Error (in `where`) for
/// corners that are no picture of their board.
CameraBundle startBundle(const std::vector<BoardView>& views, int width, int height,
                         const std::string& where);

/// Moves the lens and all poses to where the corners fit best: robust (`robust_fit.h`), blocks are
/// the corners of one view after the other, residuals projected less seen, px. Only the first
/// `lens_numbers` of the lens move. The fit's parameters are these, then turn and shift of each
/// pose (`moved`). `keep_all`: plain least squares.
Fit adjustBundle(const std::vector<BoardView>& views, int lens_numbers, bool keep_all,
                 CameraBundle* bundle, const std::string& where);

/// What became of one view.
struct ViewResult {
  std::string name;
  Pose X_CW = Pose::Identity();
  double rms_px = 0;  ///< of its good corners; of all where the view was left out
  double tilt = 0;    ///< of the board's normal from the camera's axis, rad
  int outliers = 0;   ///< corners that do not fit
  /// false: more than a third of its corners did not fit, so none of them counts
  bool used = true;
};

/// Corners that counted, by the cell of the picture in which they were seen: [row from the
/// top][column from the left].
inline constexpr std::size_t kCoverageRows = 6, kCoverageColumns = 8;
using CoverageMap = std::array<std::array<int, kCoverageColumns>, kCoverageRows>;
/// The cell's count; nullptr for a pixel outside the picture.
int* cellAt(CoverageMap& map, const Eigen::Vector2d& pixel, int width, int height);
/// Share of the cells with a corner.
double coveredShare(const CoverageMap& map);

/// What a camera's pictures of a board say of it. Numbers of the lens stand in the order fx fy cx
/// cy k1 k2 p1 p2 k3, in px and plain numbers.
struct CameraCalibration {
  CameraModel model;  ///< its rms_px is that of the good corners' distances
  Eigen::Matrix<double, kLensNumbers, kLensNumbers> covariance = decltype(covariance)::Zero();
  std::array<double, kLensNumbers> sd{},
      half95{};  ///< standard deviations, half of the 95 % intervals; 0 for numbers held at 0
  /// How many of the nine, from the first, the corners tell; the others are held at 0
  int determined = kLensNumbers;
  double rms_all_px = 0;          ///< of all corners of the used views, wrong ones too
  std::vector<ViewResult> views;  ///< one for each given view, in order
  double tilt_spread = 0;         ///< rms angle between the used views' normals and their mean, rad
  CoverageMap coverage{};
  double covered = 0;  ///< share of the cells with a corner
  /// in plain words: left-out views, an empty border of the picture
  std::vector<std::string> warnings;
  Fit fit;  ///< blocks are the corners of the used views, one view after the other

  std::vector<std::string> leftOut() const;  ///< names of views that were
};

struct CameraOptions {
  /// Every corner counts, as in programs that know no outliers: to compare with their figures
  bool keep_all = false;
};

/// Lens and poses together from all corners, by the least sum of squared distances in the picture
/// (Zhang 2000), robust (`robust_fit.h`): single wrong corners and whole views that do not fit are
/// left out and named. Where the corners do not reach far enough out to tell all of the distortion
/// (the lens found would fold the picture at its border) k3, then k2 p1 p2 too, are held at 0, with
/// a warning.
///
/// Throws Error, in plain words, for fewer than 4 views, views that `requireBoardViews` refuses,
/// views that all show the board from the same side (less than 5 degrees rms apart: focal length
/// and distance cannot be told apart), more than 30 % wrong corners, focal lengths or a centre
/// known to worse than 2 % of the focal length, and a camera that cannot be one.
CameraCalibration calibrateCamera(const std::vector<BoardView>& views, int width, int height,
                                  const CameraOptions& options = {});

}  // namespace palpa::calibration

#pragma once

#include <vector>

#include "calibration/board_view.h"
#include "calibration/camera_model.h"
#include "calibration/robust_fit.h"

namespace palpa::calibration {

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

}  // namespace palpa::calibration

#pragma once

#include <vector>

#include "apps/calibrate/result.h"
#include "calibration/board_view.h"
#include "calibration/camera_model.h"

namespace palpa::calibrate {

/// The lens from views of a board, all of them; how good it is from every fifth view, predicted by
/// what the others tell (its pose from half of its corners, the error from the other half).
/// `found`: where the model goes. `keep_all`: plain least squares, as in programs that know no
/// outliers. Throws Error for views that cannot tell a lens.
Result cameraResult(const std::vector<calibration::BoardView>& views, int width, int height,
                    const Origin& origin, calibration::CameraModel* found, bool keep_all = false);

}  // namespace palpa::calibrate

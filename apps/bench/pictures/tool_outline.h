#pragma once

#include <Eigen/Core>
#include <opencv2/core.hpp>
#include <optional>

#include "scene/scene_state.h"

namespace palpa::bench {

/// A camera, and the part of a window where its picture lies: pixels from the top left.
struct Eye {
  scene::EyeCamera camera;
  double left = 0, top = 0, width = 1, height = 1;

  /// Of the window; none before the lens.
  std::optional<Eigen::Vector2d> pixelOf(const Vec3& p_A) const;
};

/// What a tool is in a window's picture made smaller by `scale`: 255 where needle, hub, barrel and
/// drawn plunger, or a probe, are seen if nothing hides them; within the eye's part. From the
/// instruments' sizes and a pinhole alone.
cv::Mat1b toolOutline(const scene::SceneState& state, const Eye& eye, const cv::Size& window,
                      double scale);

}  // namespace palpa::bench

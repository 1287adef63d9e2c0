#pragma once

#include <Eigen/Core>
#include <opencv2/core.hpp>
#include <optional>

#include "scene/view/scene_view.h"

namespace palpa::bench {

/// Where a point is in the window, pixels from the top left; none before the lens.
std::optional<Eigen::Vector2d> pixelOf(const scene::ArGeometry& eye, const Vec3& p_A);

/// What a tool is in a window's picture made smaller by `scale`: 255 where needle, hub, barrel and
/// drawn plunger, or a probe, are seen if nothing hides them; within the eye's part. From the
/// instruments' sizes and a pinhole alone.
cv::Mat1b toolOutline(const scene::SceneState& state, const scene::ArGeometry& eye,
                      const cv::Size& window, double scale);

}  // namespace palpa::bench

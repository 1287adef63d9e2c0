#pragma once

#include <Eigen/Core>
#include <opencv2/core.hpp>
#include <optional>

#include "anatomy/patient.h"
#include "anatomy/query/triangle_tree.h"
#include "scene/view/scene_view.h"

namespace palpa::bench {

/// Where a point is in the window, pixels from the top left; none before the lens.
std::optional<Eigen::Vector2d> pixelOf(const scene::ArGeometry& eye, const Vec3& p_A);

/// What a tool is in a window's picture made smaller by `scale`: 255 where needle, hub, barrel and
/// drawn plunger, or a probe, are seen if nothing hides them; within the eye's part. From the
/// instruments' sizes and a pinhole alone.
cv::Mat1b toolOutline(const scene::SceneState& state, const scene::ArGeometry& eye,
                      const cv::Size& window, double scale);

/// Where a straight line meets a patient's skin.
class SkinRay {
 public:
  explicit SkinRay(const anatomy::Patient& patient);

  /// How far along this way (unit) the skin is first met, m; none within `length`.
  std::optional<double> along(const Vec3& from_A, const Vec3& way, double length) const;

 private:
  anatomy::TriangleTree skin_;
};

}  // namespace palpa::bench

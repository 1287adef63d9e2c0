#pragma once

#include <opencv2/core.hpp>
#include <optional>

#include "anatomy/geometry/pose.h"
#include "scene/scene_state.h"

namespace palpa::bench {

/// Somebody who looks at the AR view and knows no more than a person would: the camera and how it
/// is held, how long a needle is and how wide its syringe, and that light comes from straight
/// above. Tells from pixels alone how far off the skin the tip is, and how deep behind it. C: the
/// camera.
class Observer {
 public:
  struct Knows {
    scene::Pinhole camera;
    Vec3 down_C = Vec3::UnitY();                          ///< unit
    double needle_length = 0.07, barrel_radius = 0.0088;  ///< m
  };
  explicit Observer(const Knows& knows) : knows_(knows) {}

  /// `before`: the same view before the tool came, `now` with it; RGB. Metres; none: the tool, or
  /// its shadow, is not to be seen.
  std::optional<double> heightAboveSkin(const cv::Mat3b& before, const cv::Mat3b& now) const;
  /// By what is left of the needle outside of the ring about its entry; without a ring, of where it
  /// takes on the colour of what lies inside.
  std::optional<double> depthBehindSkin(const cv::Mat3b& before, const cv::Mat3b& now) const;

 private:
  Knows knows_;
};

}  // namespace palpa::bench

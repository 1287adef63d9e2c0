#pragma once

#include <cstdint>
#include <future>
#include <opencv2/core.hpp>
#include <optional>

#include "apps/runtime/own_thread.h"
#include "ar/cameras/picture_look.h"
#include "scene/scene_state.h"

namespace palpa::trial {

/// How the camera sees now, for an overlay that is to look alike. The first picture is looked at at
/// once; then one a second, in a thread of its own, and what it says counts from the next one on:
/// nobody waits, and what is shown does not depend on speed.
class LookWatch {
 public:
  /// Of each fresh picture, as it is shown (without distortion); `where` the board is in it.
  void see(const cv::Mat& picture, const cv::Rect& where, std::int64_t now_ns);
  const scene::CameraLook& look() const { return look_; }

 private:
  void take(const std::optional<ar::PictureLook>& measured);

  scene::CameraLook look_;
  bool known_ = false;
  std::int64_t next_ns_ = INT64_MIN;
  std::future<std::optional<ar::PictureLook>> pending_;
  runtime::OwnThread<std::optional<ar::PictureLook>> beside_;
};

}  // namespace palpa::trial

#pragma once

#include <memory>
#include <string>

#include "apps/runtime/activity.h"

namespace palpa::bench {

class Onlookers;

/// The program's picture drawn beside a measurement: the reference patient in the 1280 x 720 window
/// without a display, 30 Hz, with a new camera picture and a needle that moves in every frame. One
/// thread only, the constructor's.
class SceneLoad final : public runtime::Activity {
 public:
  SceneLoad();  ///< throws Error where nothing can be drawn
  ~SceneLoad() override;
  const char* name() const override { return "scene"; }
  std::int64_t step(std::int64_t now_ns) override;
  /// From now on they are shown the picture; null: nobody.
  void showTo(Onlookers* onlookers) { onlookers_ = onlookers; }
  int frames() const;
  std::string drawnOn() const;  ///< "surfaceless EGL", ...

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
  Onlookers* onlookers_ = nullptr;
};

}  // namespace palpa::bench

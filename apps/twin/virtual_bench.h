#pragma once

#include <array>
#include <functional>
#include <memory>
#include <optional>
#include <vector>

#include "apps/runtime/camera_activity.h"
#include "apps/station/station_file.h"
#include "apps/twin/held_tool.h"
#include "apps/twin/virtual_camera.h"

namespace palpa::twin {

/// How far the estimates were from the simulated truth; for reports only.
struct BenchAccuracy {
  std::size_t pictures = 0, registered = 0;
  double entry_median_mm = 0,
         entry_p95_mm = 0;  ///< where the overlay draws the watched point, in C
  double tool_mm = 0;       ///< where the tool's tip is thought to be at the watched point, in W
  double distance_m = 0;    ///< camera to board
};

/// One seeded world: where the camera, the board and the device really are, a device with
/// mechanics, a camera that takes pictures, a person at the device. The rest of the program sees
/// only pictures and readings. Truth is drawn around the station's figures with the spreads in its
/// file.
class VirtualBench {
 public:
  /// Of something real under the tools, which truly are at X_WT (the second one as the first where
  /// there is one): its force on each after another `dt`.
  using Touch = HeldTool::Touch;
  using RealThing = std::function<std::array<Touch, 2>(const std::array<Pose, 2>& X_WT, double dt)>;
  /// Another device of the same make on the same table.
  struct SecondTool {
    std::unique_ptr<Hand> hand;
    Pose X_WD, X_DE_start;
    runtime::ChannelDevice* device = nullptr;
    runtime::ChannelSensor* sensor = nullptr;
  };
  struct Setup {
    const station::Station& station;
    std::unique_ptr<Hand> hand;
    Pose X_DE_start;           ///< where the tool is picked up
    Vec3 watched_W, normal_W;  ///< where the overlay's accuracy is measured: a point, the surface's
                               ///< outward normal
    std::uint64_t seed = 1;
    std::function<void(const Hand::Word&)> on_word;  ///< the simulated person says something
    runtime::ChannelSensor* sensor = nullptr;  ///< where the station has a virtual force sensor
    RealThing real_thing;                      ///< none: a virtual patient alone
    std::optional<SecondTool> second = {};
  };
  VirtualBench(Setup setup, runtime::Bus& bus, runtime::ChannelDevice& device);
  ~VirtualBench();

  runtime::Activity& activity();                     ///< hand and device mechanics, 1 kHz
  runtime::CameraActivity::Exposer exposer() const;  ///< pictures
  void observe(const runtime::CameraView& view);     ///< measures the registration
  BenchAccuracy accuracy() const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace palpa::twin

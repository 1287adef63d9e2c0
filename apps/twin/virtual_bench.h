#pragma once

#include <array>
#include <functional>
#include <memory>
#include <optional>
#include <vector>

#include "apps/runtime/camera_activity.h"
#include "apps/runtime/device_adapters.h"
#include "apps/station/station_file.h"
#include "apps/twin/bench_faults.h"
#include "apps/twin/device_twin.h"
#include "apps/twin/hand.h"
#include "apps/twin/tracking_model.h"
#include "apps/twin/virtual_camera.h"

namespace palpa::twin {

/// What follows a bare finger, as it truly is: how often it says where that is, and how far off
/// that is from one time to the next. It pushes nothing.
struct FingerTracker {
  std::int64_t period_ns = 8'000'000;
  double noise = 1e-4;  ///< m, each axis [chosen: about an electromagnetic sensor's on a nail]
};

/// A simulated device, as it truly is, and who holds it.
struct HeldToolSetup {
  std::unique_ptr<Hand> hand;
  DeviceTruth truth;
  Pose X_WD, X_ET;  ///< as they truly are
  Pose X_DE_start;
  runtime::ChannelDevice* device = nullptr;
  runtime::ChannelSensor* sensor = nullptr;  ///< none: nothing measures what is touched
  SensorTruth sensor_truth = {};
  Pose X_ES = Pose::Identity();
  haptics::Wrench zero = {};  ///< what the station takes off as bias
  std::vector<SensorFault> faults;
  std::uint64_t seed = 1;
  std::optional<FingerTracker> tracker = {};  ///< in place of a device
};

/// Of something real under the tool: its force on it, N, and where that acts. In W.
struct RealTouch {
  Vec3 f_W = Vec3::Zero(), p_W = Vec3::Zero();
};

/// One simulated device on the bench with whoever holds it, its force sensor and two force cells at
/// the tool. The rest of the program sees what is published: readings and samples. The hand waits
/// for what it has not seen: while the newest picture is older than `kOldPicture_ns` (a computer
/// that cannot keep up, a window that hangs) it holds still where it is, and its own time stands.
class HeldTool {
 public:
  /// In virtual time a picture is seen within 67 ms: 30 a second, shown 33 ms later.
  static constexpr std::int64_t kOldPicture_ns = 300'000'000;

  explicit HeldTool(HeldToolSetup setup);

  /// What the person does now, by what is seen and felt.
  const Hand::Action& act(const runtime::Displayed* seen, std::int64_t now_ns, double dt);
  /// Hand, drives and mechanics over one of `parts` equal parts of a step.
  void advance(double dt, int parts);
  Pose X_WT() const { return setup_.X_WD * mechanics_.truePose() * setup_.X_ET; }
  void touch(const RealTouch& touch) { touch_ = touch; }
  /// Reading and sample at the end of a step of `dt`.
  void publish(std::int64_t now_ns, double dt);

 private:
  void measureForces(haptics::DeviceReading& reading);
  void publishTracked(std::int64_t now_ns);
  void passTime(bool waits, std::int64_t now_ns);

  HeldToolSetup setup_;
  DeviceTwin mechanics_;
  RandomStream cell_noise_;
  std::optional<SensorTwin> felt_;
  Hand::Action action_;
  RealTouch touch_;
  Vec3 f_command_D_ = Vec3::Zero(), f_hand_D_ = Vec3::Zero(),
       f_device_D_ = Vec3::Zero();  // the last two: means over the step
  std::uint64_t sequence_ = 0;
  std::int64_t last_ns_ = -1, missed_ns_ = 0;  ///< of the session, in which the hand's time stood
  std::int64_t tracked_ns_ = -1;               ///< when a tracker spoke last
  RandomStream tracker_noise_;
};

/// How far the estimates were from the simulated truth; for reports only.
struct BenchAccuracy {
  std::size_t pictures = 0, registered = 0;
  double entry_median_mm = 0,
         entry_p95_mm = 0;  ///< where the overlay draws the watched point, in C
  double tool_mm = 0;       ///< where the tool's tip is thought to be at the watched point, in W
  double distance_m = 0;    ///< camera to board
};

/// Something real under the tools, which truly are at X_WT (the second one as the first where
/// there is one): its force on each after another `dt`.
using TouchedObject =
    std::function<std::array<RealTouch, 2>(const std::array<Pose, 2>& X_WT, double dt)>;

/// Another device of the same make on the same table; or a bare finger that is only tracked, in the
/// frame of that device.
struct SecondTool {
  std::unique_ptr<Hand> hand;
  Pose X_WD, X_DE_start;
  std::optional<FingerTracker> tracker = {};
  runtime::ChannelDevice* device = nullptr;
  runtime::ChannelSensor* sensor = nullptr;
};

/// What a bench simulates.
struct VirtualBenchSetup {
  const station::Station& station;
  std::unique_ptr<Hand> hand;
  Pose X_DE_start;  ///< where the tool is picked up
  /// Where the overlay's accuracy is measured: a point, the surface's outward normal
  Vec3 watched_W, normal_W;
  std::uint64_t seed = 1;
  std::function<void(const Hand::Word&)> on_word = {};  ///< the simulated person says something
  runtime::ChannelSensor* sensor = nullptr;  ///< where the station has a virtual force sensor
  TouchedObject real_thing = {};             ///< none: a virtual patient alone
  std::optional<SecondTool> second = {};
};

/// One seeded world: where the camera, the board and the device really are, a device with
/// mechanics, a camera that takes pictures, a person at the device. The rest of the program sees
/// only pictures and readings. Truth is drawn around the station's figures with the spreads in its
/// file.
class VirtualBench {
 public:
  VirtualBench(VirtualBenchSetup setup, runtime::Bus& bus, runtime::ChannelDevice& device);
  ~VirtualBench();

  runtime::Activity& activity();               ///< hand and device mechanics, 1 kHz
  runtime::CameraActivity::Exposer exposer();  ///< pictures: only now the camera is made
  /// In place of pictures
  runtime::CameraActivity::Finder finder(const TrackingFigures& figures) const;
  void observe(const runtime::CameraView& view);  ///< measures the registration
  BenchAccuracy accuracy() const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace palpa::twin

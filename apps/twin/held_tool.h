#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "apps/runtime/channel_device.h"
#include "apps/runtime/channel_sensor.h"
#include "apps/twin/device_twin.h"
#include "apps/twin/hand.h"
#include "apps/twin/sensor_faults.h"
#include "apps/twin/sensor_twin.h"

namespace palpa::twin {

/// One simulated device on the bench with whoever holds it, its force sensor and two force cells at
/// the tool. The rest of the program sees what is published: readings and samples.
class HeldTool {
 public:
  struct Setup {
    std::unique_ptr<Hand> hand;
    DeviceTruth truth;
    Pose X_WD, X_ET;  ///< as they truly are
    Pose X_DE_start;
    runtime::ChannelDevice* device = nullptr;
    runtime::ChannelSensor* sensor = nullptr;  ///< none: nothing measures what is touched
    SensorTruth sensor_truth;
    Pose X_ES = Pose::Identity();
    haptics::Wrench zero;  ///< what the station takes off as bias
    std::vector<SensorFault> faults;
    std::uint64_t seed = 1;
  };
  /// Of something real under the tool: its force on it, N, and where that acts. In W.
  struct Touch {
    Vec3 f_W = Vec3::Zero(), p_W = Vec3::Zero();
  };
  explicit HeldTool(Setup setup);

  /// What the person does now, by what is seen and felt.
  const Hand::Action& act(const runtime::Displayed* seen, std::int64_t now_ns, double dt);
  /// Hand, drives and mechanics over one of `parts` equal parts of a step.
  void advance(double dt, int parts);
  Pose X_WT() const { return setup_.X_WD * mechanics_.truePose() * setup_.X_ET; }
  void touch(const Touch& touch) { touch_ = touch; }
  /// Reading and sample at the end of a step of `dt`.
  void publish(std::int64_t now_ns, double dt);

 private:
  void measureForces(haptics::DeviceReading& reading);

  Setup setup_;
  DeviceTwin mechanics_;
  runtime::RandomStream cell_noise_;
  std::optional<SensorTwin> felt_;
  Hand::Action action_;
  Touch touch_;
  Vec3 f_command_D_ = Vec3::Zero(), f_hand_D_ = Vec3::Zero(),
       f_device_D_ = Vec3::Zero();  // the last two: means over the step
  std::uint64_t sequence_ = 0;
};

}  // namespace palpa::twin

#include "apps/twin/held_tool.h"

namespace palpa::twin {

HeldTool::HeldTool(Setup setup)
    : setup_(std::move(setup)),
      mechanics_(setup_.truth, setup_.X_DE_start),
      cell_noise_(setup_.seed, "bench.force_cells") {
  if (setup_.sensor) felt_.emplace(setup_.sensor_truth, setup_.seed);
}

const Hand::Action& HeldTool::act(const runtime::Displayed* seen, std::int64_t now_ns, double dt) {
  Hand::Senses senses;
  senses.now_ns = now_ns;
  senses.X_DE = mechanics_.truePose();
  senses.f_grip_D = mechanics_.gripForce();
  senses.f_fingers_D = mechanics_.fingerForce();
  senses.seen = seen;
  action_ = setup_.hand->act(senses, dt);
  f_command_D_ = unpack(setup_.device->commanded(now_ns));
  f_hand_D_ = f_device_D_ = Vec3::Zero();
  return action_;
}

void HeldTool::advance(double dt, int parts) {
  mechanics_.advance(
      dt, action_.X_DH, setup_.hand->grip(), f_command_D_,
      setup_.X_WD.linear().transpose() * (touch_.f_W - setup_.truth.weight_N * Vec3::UnitZ()));
  f_hand_D_ += mechanics_.meanFingerForce() / parts;
  f_device_D_ += mechanics_.meanDeviceForce() / parts;
}

/// Two force cells, at the handle and before the tool, each with its own noise and as fine as a
/// converter is: whole binary parts of a newton also take little room in a record.
void HeldTool::measureForces(haptics::DeviceReading& reading) {
  constexpr double kNoise_N = 0.01, kCounts = 1024;  // [chosen] a good cell's; a newton
  const auto noisy = [&](const Vec3& f_D) {
    return pack(Vec3(
        ((f_D + kNoise_N * Vec3(cell_noise_.normal(), cell_noise_.normal(), cell_noise_.normal())) *
         kCounts)
            .array()
            .round() /
        kCounts));
  };
  reading.f_hand_D = noisy(f_hand_D_);
  reading.f_device_D = noisy(f_device_D_);
  reading.instrumented = 1;
}

void HeldTool::publish(std::int64_t now_ns, double dt) {
  haptics::DeviceReading reading;
  const PackedPose X_DE = mechanics_.encoderPose();
  reading.t_ns = now_ns;
  reading.sequence = ++sequence_;
  reading.p_DE = X_DE.p;
  reading.q_DE = X_DE.q;
  reading.plunger = action_.plunger;
  reading.buttons = action_.buttons;
  reading.homed = 1;
  measureForces(reading);
  setup_.device->publish(reading, now_ns);
  if (!felt_) return;
  haptics::WrenchSample sample = felt_->measure(setup_.X_WD * mechanics_.truePose() * setup_.X_ES,
                                                touch_.f_W, touch_.p_W, dt, now_ns);
  if (spoil(setup_.faults, 1e-9 * static_cast<double>(now_ns), setup_.zero, &sample))
    setup_.sensor->publish(sample, now_ns);
}

}  // namespace palpa::twin

#include "apps/bench/led_device.h"

namespace palpa::bench {

haptics::DeviceReading LedDevice::lead(std::int64_t now_ns) {
  haptics::DeviceReading reading;
  reading.t_ns = now_ns;
  reading.sequence = ++sequence_;
  reading.homed = 1;
  reading.p_DE = pack(strokePoint(stroke_, 1e-9 * static_cast<double>(now_ns)));
  device_.publish(reading, now_ns);
  return reading;
}

void arm(runtime::Bus& bus) {
  haptics::TickCommands commands;
  commands.armed = 1;
  bus.task_to_haptic.publish(commands, 0);
}

std::uint64_t drain(runtime::Bus& bus, StrokeResult* result) {
  std::uint64_t contacts = 0;
  haptics::FlightRecord record;
  while (bus.haptic_to_task.pop(&record)) {
    contacts += unpack(record.f_contact_D).norm() > 0;
    if (result) result->records.push_back(record);
  }
  while (bus.haptic_to_recorder.pop(&record)) {
  }
  runtime::Keyframe keyframe;
  while (bus.keyframes_to_recorder.pop(&keyframe)) {
  }
  LocalGeometry geometry;
  while (bus.geometry_to_recorder.pop(&geometry))
    if (result) result->snapshots.push_back(geometry);
  return contacts;
}

}  // namespace palpa::bench

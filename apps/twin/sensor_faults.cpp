#include "apps/twin/sensor_faults.h"

#include "apps/twin/fault_spans.h"

namespace palpa::twin {
namespace {

constexpr std::pair<const char*, SensorFault::Kind> kSensorFaults[] = {
    {"unplugged", SensorFault::Kind::unplugged},
    {"saturated", SensorFault::Kind::saturated},
    {"drifting", SensorFault::Kind::drifting},
    {"reversed", SensorFault::Kind::reversed},
    {"wrong_scale", SensorFault::Kind::wrong_scale}};

void scale(double factor, const haptics::Wrench& zero, haptics::WrenchSample* sample) {
  for (std::size_t i = 0; i < 3; ++i) {
    sample->f_S[i] = zero.f_S[i] + factor * (sample->f_S[i] - zero.f_S[i]);
    sample->tau_S[i] = zero.tau_S[i] + factor * (sample->tau_S[i] - zero.tau_S[i]);
  }
}

}  // namespace

std::vector<SensorFault> readSensorFaults(const station::JsonFile& file) {
  return readFaults<SensorFault>(
      file, "sensor_faults", [](const station::JsonFile& entry, double from, double to) {
        SensorFault fault{faultKind<SensorFault::Kind>(entry, kSensorFaults), from, to, 0};
        if (fault.kind == SensorFault::Kind::drifting)
          fault.amount = entry.number("rate_N_per_s", -10, 10);
        if (fault.kind == SensorFault::Kind::wrong_scale)
          fault.amount = entry.number("factor", 0, 100);
        return fault;
      });
}

bool spoil(const std::vector<SensorFault>& faults, double t, const haptics::Wrench& zero,
           haptics::WrenchSample* sample) {
  for (const SensorFault& fault : faults) {
    if (t < fault.from || t >= fault.to) continue;
    switch (fault.kind) {
      case SensorFault::Kind::unplugged:
        return false;
      case SensorFault::Kind::saturated:
        sample->flags |= haptics::kSaturated;
        break;
      case SensorFault::Kind::drifting:
        sample->f_S[2] += fault.amount * (t - fault.from);
        break;
      case SensorFault::Kind::reversed:
        scale(-1, zero, sample);
        break;
      case SensorFault::Kind::wrong_scale:
        scale(fault.amount, zero, sample);
        break;
    }
  }
  return true;
}

}  // namespace palpa::twin

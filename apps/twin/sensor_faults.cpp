#include "apps/twin/sensor_faults.h"

#include "apps/twin/fault_spans.h"

namespace palpa::twin {
namespace {

using Kind = SensorFault::Kind;
constexpr std::pair<const char*, Kind> kSensorFaults[] = {
    {"unplugged", Kind::unplugged}, {"saturated", Kind::saturated}, {"drifting", Kind::drifting}, {"reversed", Kind::reversed}, {"wrong_scale", Kind::wrong_scale}};

void scale(double factor, const haptics::Wrench& zero, haptics::WrenchSample* sample) {
  for (std::size_t i = 0; i < 3; ++i) {
    sample->f_S[i] = zero.f_S[i] + factor * (sample->f_S[i] - zero.f_S[i]);
    sample->tau_S[i] = zero.tau_S[i] + factor * (sample->tau_S[i] - zero.tau_S[i]);
  }
}

}  // namespace

std::vector<SensorFault> readSensorFaults(const station::JsonFile& file) {
  return readFaults<SensorFault>(file, "sensor_faults", [](const station::JsonFile& entry, double from, double to) {
    SensorFault fault{faultKind<Kind>(entry, kSensorFaults), from, to, 0};
    if (fault.kind == Kind::drifting) fault.amount = entry.number("rate_N_per_s", -10, 10);
    if (fault.kind == Kind::wrong_scale) fault.amount = entry.number("factor", 0, 100);
    return fault;
  });
}

bool spoil(const std::vector<SensorFault>& faults, double t, const haptics::Wrench& zero, haptics::WrenchSample* sample) {
  for (const SensorFault& fault : faults) {
    if (t < fault.from || t >= fault.to) continue;
    switch (fault.kind) {
      case Kind::unplugged: return false;
      case Kind::saturated: sample->flags |= haptics::kSaturated; break;
      case Kind::drifting: sample->f_S[2] += fault.amount * (t - fault.from); break;
      case Kind::reversed: scale(-1, zero, sample); break;
      case Kind::wrong_scale: scale(fault.amount, zero, sample); break;
    }
  }
  return true;
}

}  // namespace palpa::twin

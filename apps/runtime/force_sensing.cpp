#include "apps/runtime/force_sensing.h"

namespace palpa::runtime {

haptics::SensedForce ForceSensing::sense(const haptics::DeviceReading& reading,
                                         std::int64_t now_ns) noexcept {
  haptics::SensedForce sensed;
  sensed.state = haptics::SensorState::unusable;
  const haptics::WrenchSample sample = sensor_.read(now_ns);
  if (!reading.homed) {  // nobody knows which way is down
    state_ = {};
    last_ns_ = -kGoodFor_ns - 1;
    return sensed;
  }
  const Quat q_DE = unpack(reading.q_DE).normalized();
  const Pose X_DS = makePose(q_DE.toRotationMatrix(), unpack(reading.p_DE)) * setup_.X_ES;
  const haptics::ContactWrench contact =
      haptics::step(setup_.filter, state_, sample, pack(Pose(setup_.X_WD * X_DS)), reading.t_ns);
  if (!state_.held)
    last_ns_ =
        -kGoodFor_ns - 1;  // the sensor is not well: what it said before is no word for after
  if (!contact.valid) return now_ns - last_ns_ <= kGoodFor_ns ? last_ : sensed;
  sensed.state = haptics::SensorState::valid;
  sensed.f_D = pack(Vec3(X_DS.linear() * unpack(contact.contact.f_S)));
  sensed.p_DK = pack(Vec3(setup_.X_WD.inverse() * unpack(contact.p_WK)));
  last_ = sensed;
  last_ns_ = now_ns;
  return sensed;
}

}  // namespace palpa::runtime

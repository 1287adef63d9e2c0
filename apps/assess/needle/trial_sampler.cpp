#include "apps/assess/needle/trial_sampler.h"

namespace palpa::assess {

void TrialSampler::begin(std::uint32_t trial) {
  trial_ = trial;
  clock_ = {};
  pending_events_ = 0;
}

bool TrialSampler::add(const haptics::FlightRecord& record, TrialSample* sample) {
  if (record.commands.trial != trial_) return false;
  if (!record.commands.armed) {
    clock_.pause();
    pending_events_ |= record.events;
    return false;
  }
  clock_.pass(record.t_ns);
  const Quat q_DE = unpack(record.reading.q_DE).normalized();
  const Pose X_AT = X_AD_ * makePose(q_DE.toRotationMatrix(), unpack(record.reading.p_DE)) * X_ET_;
  sample->t_s = clock_.seconds();
  sample->tip_A = X_AT.translation();
  sample->axis_A = X_AT.rotation() * Vec3::UnitZ();
  sample->bevel_A = X_AT.rotation() * Vec3::UnitY();
  sample->phase = record.phase;
  sample->tissue = record.tissue;
  sample->wall = record.wall;
  sample->bone = record.bone;
  sample->wall_leaving = record.wall_leaving != 0;
  sample->depth = record.depth;
  sample->bone_force = record.bone_force;
  sample->f_contact = unpack(record.f_contact_D).norm();
  sample->f_command = unpack(record.f_command_D).norm();
  sample->plunger = record.reading.plunger;
  sample->waiting = record.commands.asked != 0;
  sample->events = record.events | pending_events_;
  pending_events_ = 0;
  sample->subtasks = record.subtasks;
  return true;
}

}  // namespace palpa::assess

#include "apps/assess/dose_counter.h"

#include <limits>

namespace palpa::assess {

DoseCounter::DoseCounter(const haptics::AugmentationPlan& plan,
                         const std::vector<std::string>& subtasks)
    : parts_(subtasks.size()) {
  for (const std::string& name : subtasks) doses_.push_back({name, 0, 0, 0, 0});
  bool any = false;
  for (std::size_t i = 0; i < part_of_.size(); ++i) {
    part_of_[i] = plan.each[i].subtask;
    any = any || (i < plan.count && part_of_[i] == haptics::kAnySubtask);
  }
  if (any) doses_.push_back({kAnyPart, 0, 0, 0, 0});
  left_s_.assign(doses_.size(), std::numeric_limits<double>::infinity());
}

void DoseCounter::add(const haptics::FlightRecord& record, double dt) {
  const double added_N = unpack(record.f_augmentation_D).norm();
  for (std::size_t s = 0; s < doses_.size(); ++s) {
    const bool named = s < parts_, on = !named || (record.subtasks >> s & 1u);
    const std::size_t part = named ? s : haptics::kAnySubtask;
    bool felt = false;
    for (std::size_t i = 0; i < part_of_.size(); ++i)
      felt = felt || ((record.augmenting >> i & 1u) && part_of_[i] == part);
    SubtaskDose& dose = doses_[s];
    if (on) {
      dose.on_s += dt;
      dose.times += left_s_[s] > 0;
      dose.occasions += left_s_[s] >= kLeft_s;
    }
    left_s_[s] = on ? 0 : left_s_[s] + dt;
    if (felt) {
      dose.augmented_s += dt;
      dose.impulse_Ns += added_N * dt;
    }
  }
}

void TrialDoses::begin(std::uint32_t trial) {
  counter_ = DoseCounter(plan_, subtasks_);
  trial_ = trial;
  clock_ = {};
}

void TrialDoses::add(const haptics::FlightRecord& record) {
  if (record.commands.trial != trial_) return;
  if (!record.commands.armed) return clock_.pause();
  if (const double dt = clock_.pass(record.t_ns); dt > 0) counter_.add(record, dt);
}

}  // namespace palpa::assess

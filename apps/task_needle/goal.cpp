#include "apps/task_needle/goal.h"

#include <algorithm>
#include <cmath>

#include "haptics/flight_record.h"

namespace palpa::task_needle {

void GoalTrial::add(const assess::TrialSample& sample) {
  const std::uint32_t on = sample.subtasks;
  since_s_.resize(parts_.size());
  const bool in_goal = on >> goal_.part & 1u;
  held_s_ = in_goal && in_goal_ ? held_s_ + sample.t_s - t_s_ : 0;
  in_goal_ = in_goal;
  t_s_ = sample.t_s;
  deepest_ = std::max(deepest_, sample.depth);
  for (std::size_t i = 0; i < parts_.size(); ++i) {
    const bool is = on >> i & 1u, was = on_ >> i & 1u;
    if (is && !was) since_s_[i] = t_s_;
    if (was && !is)
      spans_.push_back({parts_[i], i == goal_.part ? "good" : "guide", since_s_[i], t_s_});
  }
  on_ = on;
  if (sample.events & haptics::kSkinPunctured) {
    ++punctures_;
    moments_.push_back({t_s_, "puncture", "Through the surface of the " + words_.of(Organ::skin)});
  }
  if (sample.events & haptics::kWallPunctured && sample.wall != Organ::none)
    moments_.push_back({t_s_, "bone", "Through the " + words_.of(sample.wall)});
}

std::string GoalTrial::step() const {
  for (std::size_t i = parts_.size(); i-- > 0;)
    if (on_ >> i & 1u) return parts_[i];
  return {};
}

void GoalTrial::tell(assess::TrialAssessment* a) const {
  a->by_path = false;
  a->values.success = reached();
  a->values.time_ms = std::round(1e3 * t_s_);
  a->skin_punctures = punctures_;
  a->spans = spans_;
  for (std::size_t i = 0; i < since_s_.size(); ++i)
    if (on_ >> i & 1u)
      a->spans.push_back({parts_[i], i == goal_.part ? "good" : "guide", since_s_[i], t_s_});
  a->moments = moments_;
  if (a->values.success) a->moments.push_back({t_s_, "success", "Done: " + goal_.means});
  const std::string after = std::to_string(std::lround(t_s_)) + " s",
                    deepest = std::to_string(std::lround(1e3 * deepest_)) + " mm";
  a->summary = (a->values.success ? "Done after " + after + ": " + goal_.means
                                  : "Not done after " + after + "; the goal: " + goal_.means) +
               ". It went " + deepest + " deep at most.";
}

}  // namespace palpa::task_needle

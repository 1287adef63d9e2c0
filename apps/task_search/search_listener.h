#pragma once

#include <array>
#include <vector>

#include "apps/assess/dose_counter.h"
#include "apps/assess/search/search_trial.h"
#include "apps/task_search/search_file.h"

namespace palpa::task_search {

/// Makes of the recorded ticks what an episode is judged by; the same for a session and for its
/// replay. The time runs from when the handle is let go. Dwelling: in contact, within a pit's
/// radius of its middle.
class SearchListener {
 public:
  /// `plan`: the session's, as the loop runs with it.
  SearchListener(const SearchSettings& task, const haptics::AugmentationPlan& plan);
  void begin(std::uint32_t trial);
  void add(const haptics::FlightRecord& record, const Vec3& p_DT);

  bool released() const { return released_; }  ///< the handle has been let go
  double seconds() const { return seconds_; }
  int chosen() const {
    return chosen_;
  }  ///< element where the probe has stayed long enough; -1: none yet
  std::uint8_t subtasks() const { return subtasks_; }  ///< bits, of the last tick
  /// What was heard, into a trial's facts.
  assess::SearchTrial heard(assess::SearchTrial facts) const;

 private:
  const SearchSettings* task_;
  haptics::AugmentationPlan plan_;
  std::uint32_t trial_ = 0;
  std::int64_t last_ns_ = -1;
  bool released_ = false;
  Vec3 p_last_ = Vec3::Zero();
  double seconds_ = 0, path_ = 0, peak_N_ = 0, force_Ns_ = 0, contact_s_ = 0, dwell_s_ = 0;
  int dwells_ = -1, chosen_ = -1;
  std::uint8_t subtasks_ = 0;
  std::array<double, 3> visited_{};
  assess::DoseCounter doses_;
};

}  // namespace palpa::task_search

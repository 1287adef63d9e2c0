#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include <nlohmann/json_fwd.hpp>

#include "apps/assess/progress/history.h"

/// Others who did the same task, to read one's own result by.
namespace palpa::progress {

/// How far a figure reaches in a group, in the metric's unit.
struct Reach {
  std::string metric;
  double low = 0, middle = 0, high = 0;
};

struct Group {
  std::string name;        ///< "experts", "others who train here"
  std::string what;        ///< what lies from `low` to `high`: "8 of 10 of their trials"
  bool simulated = false;  ///< any of its people, or their station, was
  std::size_t people = 0, trials = 0;
  std::vector<Reach> figures;                         ///< those that a page shows of the engine
  const Reach* reach(std::string_view metric) const;  ///< null: none of this metric
};

/// Of all trials that count the 10th to the 90th percentile, and the median. `people`: who did
/// them. None without a trial.
std::optional<Group> expertsOf(const std::vector<PracticeTrial>& trials);

/// Of fewer others a reach would be what two or three of them reached, who may know each other.
inline constexpr std::size_t kFewestOthers = 8;

/// Of each trainee the mean over the last five trials that have the figure; of these means the
/// middle half, and the median. `left_out`: who asks. None for fewer than `kFewestOthers`.
std::optional<Group> othersIn(const Series& series, const std::string& left_out);

/// As files and evidence keep a group. `groupIn` throws nlohmann::json::exception for what is none.
nlohmann::json jsonOf(const Group& group);
Group groupIn(const nlohmann::json& json);

}  // namespace palpa::progress

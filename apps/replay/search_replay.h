#pragma once

#include <memory>
#include <vector>

#include "apps/replay/trial_replay.h"
#include "apps/task_search/search_listener.h"

namespace palpa::replay {

struct SearchMoment {
  double t_s = 0;  ///< since the trial's start, the holding included; pauses do not count
  runtime::ToolState tool;
  bool held = false;
  double searched_s = 0;  ///< since the handle was let go
};

/// A recorded episode of a search, ready to be shown at any moment.
struct SearchTrial : ShownTrial {
  double side = 0.0144;               ///< m, of the floor in the hand
  double magnification = 10;          ///< of what is shown
  std::vector<SearchMoment> moments;  ///< not empty
  double length_s() const { return moments.back().t_s; }
};

/// Takes a session's ticks in their order and keeps of one trial a moment every 4 ms.
class SearchReader {
 public:
  SearchReader(const task_search::SearchSettings& task, const haptics::TickConfig& config,
               int trial);
  void add(const haptics::FlightRecord& record);
  const std::vector<SearchMoment>& moments() const { return moments_; }

 private:
  const haptics::TickConfig& config_;
  task_search::SearchListener listener_;
  std::uint32_t trial_;
  std::int64_t last_ns_ = -1;
  double seconds_ = 0;
  std::vector<SearchMoment> moments_;
};

/// The trial and the view outlive what is answered.
std::unique_ptr<TrialReplay> searchReplay(const SearchTrial& trial, scene::SceneView& view);

}  // namespace palpa::replay

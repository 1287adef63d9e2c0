#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "apps/assess/search/search_trial.h"
#include "apps/station/station_file.h"
#include "apps/station/task_sections.h"
#include "haptics/contact/probe_contact.h"

namespace palpa::task_search {

/// Episodes of a study that belong together.
struct SearchBlock {
  std::string name;
  int episodes = 0;
  bool training = false;  ///< in the mode of the trainee's group; else with full stiffness
};

/// A search as its file says it (assets/tasks/search.json). Lengths of the stimulus in U.
struct SearchSettings {
  std::string id, title, brief;
  haptics::SearchSpec spec;
  haptics::FloorRendering rendering;  ///< of the task; the device's limits come of the station
  double degraded_share = 0.2;        ///< of the full stiffness
  double dwell_s = 0.5;               ///< in a pit
  double hold_s = 1;                  ///< held before an episode
  double time_limit_s = 60;
  int map_px = 1024;            ///< of the height map whose rises are told
  double shown_per_U = 0.6e-3;  ///< m on the screen's table for one U
  double rise_share = 0.35;     ///< of a scale's largest response: above, the surface rises
  station::NamedPlan augmentations;
  std::vector<SearchBlock> blocks;
  station::Taxonomy taxonomy;
  std::string source;  ///< the file's text, for the evidence
};

/// Throws UsageError naming file and field.
SearchSettings readSearch(const std::filesystem::path& file);
SearchSettings readSearch(const JsonFile& file);

/// As the station can render it: `real` as stiff as its coupling bears, up to the task's;
/// `degraded` its share of that; the damping with the stiffness. Throws UsageError where the
/// station says no floor.
haptics::FloorRendering renderingOn(const SearchSettings& task, const station::Station& station);

}  // namespace palpa::task_search

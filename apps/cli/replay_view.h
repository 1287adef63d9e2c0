#pragma once

#include <CLI/CLI.hpp>
#include <string>

namespace palpa::cli {

/// How a recorded trial is to be seen.
struct ReplayViewOptions {
  bool view = false;
  std::string video;     ///< film to write
  std::string pictures;  ///< folder for single pictures; both empty: a window
  std::string size = "1280x720";
  int trial = 0;                            ///< 0: the first that was finished
  double speed = 1, from_s = 0, to_s = -1;  ///< of the trial; -1: to its end
  double frames_per_second = 25;
  bool wanted() const { return view || !video.empty() || !pictures.empty(); }
};

void addReplayViewOptions(CLI::App& command, ReplayViewOptions& options);

/// Plays a trial of any task's session in a window, or writes it as a film or as single pictures.
/// Throws UsageError for a trial that is not there, Error where there is no display.
void viewReplay(const std::string& file, const ReplayViewOptions& options);

}  // namespace palpa::cli

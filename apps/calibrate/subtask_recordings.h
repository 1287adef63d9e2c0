#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "apps/calibrate/subtask_features.h"
#include "apps/station/calibration_file.h"
#include "apps/station/task_sections.h"

/// Recorded sessions of one task as sequences of steps.
namespace palpa::calibrate {

inline constexpr int kShortestSequence = 50;  ///< steps: what is shorter than 0.5 s is left out

struct SubtaskRecordings {
  std::string task, station;              ///< ids, of the first recording
  std::vector<station::NamedPart> parts;  ///< bit i of a label: part i
  std::vector<SubtaskSequence> sequences;
  int left_out = 0;        ///< sequences that are too short
  int augmented = 0;       ///< trials in which cues might be added to the force
  bool simulated = false;  ///< any of them
  std::vector<station::CalibrationFile::Data::File> files;

  /// "scan + identify"; "no part".
  std::string wordsOf(int label) const;
};

/// `files`: session.palpa, or folders that hold one. `task`: a task's file to take the parts' names
/// from (it must tell them by the same conditions); empty: the first recording's own task. Throws
/// Error: no session file, no parts in its task, parts that differ from the first recording's;
/// UsageError for a bad `task`.
SubtaskRecordings readSubtaskRecordings(const std::vector<std::filesystem::path>& files,
                                        const std::filesystem::path& task = {});

}  // namespace palpa::calibrate

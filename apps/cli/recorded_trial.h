#pragma once

#include <filesystem>

#include "apps/cli/recorded_session.h"
#include "apps/replay/needle_replay.h"

namespace palpa::cli {

/// One trial of a recorded needle session, ready to be shown, with its events and near misses as marks.
struct RecordedNeedleTrial {
  /// `number` 0: the first that was finished. Throws UsageError for a trial that is not there, or another task's session; Error for a damaged file.
  RecordedNeedleTrial(const std::filesystem::path& file, int number);
  RecordedSession session;
  replay::NeedleTrial trial;
  replay::RecordedPictures pictures;   ///< of the camera, where they lie beside the file
};

}  // namespace palpa::cli

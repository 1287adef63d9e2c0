#pragma once

#include <filesystem>

#include "apps/session/session_options.h"
#include "apps/training/engine.h"

namespace palpa::session {

/// Where a session left its results, and whether somebody left it before its last trial.
struct SessionLeft {
  std::filesystem::path folder;
  bool quit = false;
};

/// A whole session, from the options as they were given to the last result. Throws UsageError or
/// Error.
SessionLeft holdNeedleSession(SessionOptions options);
SessionLeft holdPalpation(SessionOptions options);
SessionLeft holdSqueeze(SessionOptions options);
SessionLeft holdSearch(SessionOptions options);
SessionLeft holdFriction(SessionOptions options);
SessionLeft holdPulse(SessionOptions options);

/// The one for a task file's engine.
SessionLeft holdSession(training::Engine engine, SessionOptions options);

}  // namespace palpa::session

#pragma once

#include <filesystem>

#include "apps/cli/session_options.h"

namespace palpa::cli {

/// Where a session left its results, and whether somebody left it before its last trial.
struct SessionLeft {
  std::filesystem::path folder;
  bool quit = false;
};

/// A whole session with its results, as the command of that name runs it. Throws UsageError or
/// Error.
SessionLeft runParacentesisCommand(SessionOptions options);
SessionLeft runPalpationCommand(SessionOptions options);
SessionLeft runSqueezeCommand(SessionOptions options);
SessionLeft runSearchCommand(SessionOptions options);

/// The one for a task file's engine: "palpation", "surface", "squeeze", or a needle's.
SessionLeft runSessionCommand(const std::string& engine, SessionOptions options);

}  // namespace palpa::cli

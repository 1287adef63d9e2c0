#pragma once

#include <CLI/CLI.hpp>

#include "apps/cli/session_options.h"

namespace palpa::cli {

/// Adds the options that every session command has.
void addSessionArguments(CLI::App& command, SessionOptions& options);

/// After parsing: what "auto" means here, and contradictions (UsageError).
void settle(SessionOptions& options);

}  // namespace palpa::cli

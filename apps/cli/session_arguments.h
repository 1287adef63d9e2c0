#pragma once

#include <CLI/CLI.hpp>

#include "apps/cli/session_options.h"
#include "apps/station/station_file.h"

namespace palpa::cli {

/// Adds the options that say where and how a session is held: station, operator, display, folder.
void addPlaceArguments(CLI::App& command, SessionOptions& options);
/// These, and the others that every session command has.
void addRunArguments(CLI::App& command, SessionOptions& options);
/// These, and those of a needle's session.
/// --augment, where a task's file has augmentations that are off by default.
void addAugmentArgument(CLI::App& command, SessionOptions& options);
void addSessionArguments(CLI::App& command, SessionOptions& options);

/// After parsing: what "auto" means here, and contradictions (UsageError).
void settle(SessionOptions& options);

/// With the station read: who can hold its device. Throws UsageError.
void settleOperator(SessionOptions& options, const station::Station& station);

}  // namespace palpa::cli

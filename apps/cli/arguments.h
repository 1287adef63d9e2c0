#pragma once

#include <filesystem>
#include <string>

#include <CLI/CLI.hpp>

#include "apps/session/session_options.h"
#include "scene/window/desktop.h"

namespace palpa::cli {

/// Adds the options that say where and how a session is held: station, operator, display, folder.
void addPlaceArguments(CLI::App& command, session::SessionOptions& options);
/// --window and --monitor: where a window is to be.
void addWindowArguments(CLI::App& command, scene::WindowPlace& place);
/// --gpu: by what is drawn, in this process.
void addGpuArgument(CLI::App& command);
/// These, and the others that every session command has.
void addRunArguments(CLI::App& command, session::SessionOptions& options);
/// --augment, where a task's file has augmentations that are off by default.
void addAugmentArgument(CLI::App& command, session::SessionOptions& options);
/// How many fingers press, and what the second one is on.
void addFingerArguments(CLI::App& command, session::SessionOptions& options);
/// What lies there, where something soft is touched.
void addObjectArguments(CLI::App& command, session::SessionOptions& options);
/// Those of addRunArguments, and those of a needle's session.
void addSessionArguments(CLI::App& command, session::SessionOptions& options);

/// Where the records are when nothing else is said: $PALPA_RECORDS, else records.sqlite in
/// $XDG_DATA_HOME/palpa or ~/.local/share/palpa.
std::string usualRecords();
/// Where a console keeps what it keeps when nothing else is said.
std::filesystem::path usualConsoleHome();
/// As usualRecords, its folder made.
std::string usualRecordsMade();

/// For what only reads: throws UsageError where a records file is not there or empty, so that a
/// name mistyped is not taken for records of nobody.
void requireRecords(const std::string& url);

/// --records, with that default; the folder of a file is made when the command runs.
void addRecordsArgument(CLI::App& command, std::string& url);

}  // namespace palpa::cli

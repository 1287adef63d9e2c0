#pragma once

#include <CLI/CLI.hpp>
#include <string>

namespace palpa::cli {

/// Where the records are when nothing else is said: $PALPA_RECORDS, else records.sqlite in
/// $XDG_DATA_HOME/palpa or ~/.local/share/palpa.
std::string usualRecords();
/// The same, its folder made.
std::string usualRecordsMade();

/// For what only reads: throws UsageError where a records file is not there or empty, so that a
/// name mistyped is not taken for records of nobody.
void requireRecords(const std::string& url);

/// --records, with that default; the folder of a file is made when the command runs.
void addRecordsArgument(CLI::App& command, std::string& url);

}  // namespace palpa::cli

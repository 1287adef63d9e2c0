#pragma once

#include <CLI/CLI.hpp>

namespace palpa::cli {

/// subtasks: a task's parts proposed from recorded sessions.
void addSubtaskCalibration(CLI::App& calibrate);

}  // namespace palpa::cli

#pragma once

#include <CLI/CLI.hpp>

namespace palpa::cli {

/// camera, tool, workspace, registration, latency, force-sensor, material, friction, inclusion,
/// all.
void addStationCalibrations(CLI::App& calibrate);

}  // namespace palpa::cli

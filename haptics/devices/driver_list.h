#pragma once

#include <vector>

#include "haptics/devices/driver.h"

namespace palpa::haptics {

/// Of every folder with a `driver.cpp`; the build makes the source.
std::vector<const DriverDescription*> listedDrivers();

}  // namespace palpa::haptics

#pragma once

#include <string>

#include "apps/runtime/bus.h"

namespace palpa::runtime {

/// What is wrong with the camera or with what it sees, in words for whoever stands beside it;
/// empty: nothing. `view` null: no picture yet.
std::string cameraTrouble(const CameraView* view, std::int64_t now_ns);

}  // namespace palpa::runtime

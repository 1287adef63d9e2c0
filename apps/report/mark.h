#pragma once

#include <string>

#include "apps/report/tone.h"

namespace palpa::report {

/// Outline of a mark about (x, y), for an SVG path. Shapes differ besides colour: circle (neutral
/// or good), square (guide), diamond (bad); of about equal area.
std::string markPath(Tone tone, double x, double y, double radius);

}  // namespace palpa::report

#pragma once

#include <string>

#include "ar/board.h"

namespace palpa::ar {

/// Kalibr's description of a target, "key: value  # comment" lines: target_type 'aprilgrid',
/// tagCols, tagRows, tagSize (metres), tagSpacing (gap over tag size). Kalibr prints borders two
/// cells wide and ids from 0. Throws Error with `where` and the key that is missing, wrong or
/// unknown; other target types are refused.
TagGridSpec parseKalibrTarget(const std::string& text, const std::string& where);

}  // namespace palpa::ar

#pragma once

#include "apps/console/guard.h"
#include "apps/console/http.h"

namespace palpa::console {

inline constexpr std::size_t kLongestBody = 64u << 10;

/// Whether a request is framed as the pages frame theirs: a POST with a body of stated, small
/// length, a GET without one, nothing packed, nothing in parts. All else is refused before a body
/// is read: a length that can be read in two ways lets one request hide in another, a packed body
/// grows without bound when it is unpacked, a list of parts makes a small question into a large
/// answer.
Verdict judgeFraming(const httplib::Request& request);

}  // namespace palpa::console

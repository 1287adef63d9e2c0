#pragma once

#include <string>

#include "apps/trial/trial_status.h"

namespace palpa::live {

/// {"command": "start|pause|abort|void|stop|rearm|leave|note", "reason": "...", "at_s": 12.4} as a
/// request to the task. Throws UsageError for what is none: unknown command, void without a reason,
/// an empty note, a text over 500 characters or with control characters, an `at_s` that is no
/// second of a session. `at_s`: the moment of a note, session time.
trial::UserRequest parseSteering(const std::string& json);

}  // namespace palpa::live

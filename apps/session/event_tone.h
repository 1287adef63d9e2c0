#pragma once

#include <string>

#include "apps/runtime/flight_sink.h"

namespace palpa::session {

/// What an event means for the learner: "good", "guide", "bad", "neutral"; "note" of somebody's
/// note. What was touched or pierced is told by its words, the rest by its kind.
std::string toneOfEvent(const runtime::Event& event);

}  // namespace palpa::session

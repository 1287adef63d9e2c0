#pragma once

#include <string>

#include "apps/record/session_file.h"
#include "apps/report/page/session_page.h"
#include "apps/runtime/flight_sink.h"

namespace palpa::evidence {

/// When a session was held (this computer's time zone; nothing in virtual time) and what somebody
/// noted while it ran: of its page the rest is left empty. Throws Error.
report::SessionPage whatWasNoted(const record::SessionReader& session);

/// What an event means for the learner: "good", "guide", "bad", "neutral"; "note" of somebody's
/// note. What was touched or pierced is told by its words, the rest by its kind.
std::string toneOfEvent(const runtime::Event& event);

}  // namespace palpa::evidence

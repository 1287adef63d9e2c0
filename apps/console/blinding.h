#pragma once

#include <string>

namespace palpa::console {

/// What of a session's log an educator may hear who must not know what was drawn: how it stands,
/// which trial, for how long; stops, and what the station has to say; notes. Nothing of
/// what is felt or done, no aid, no answer, no score, no result but that a trial does not count:
/// any of them can tell a condition (Schulz and Grimes, Blinding in randomised trials, Lancet 359,
/// 2002). What may not be heard is an entry that tells nothing, so that the log keeps its numbers;
/// what is no entry is that, too.
std::string blinded(const std::string& entry);

}  // namespace palpa::console

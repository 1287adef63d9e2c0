#pragma once

#include <filesystem>

#include "apps/cli/session_commands.h"
#include "apps/cli/session_options.h"
#include "apps/record/store/study_store.h"
#include "apps/study/progress.h"
#include "apps/study/protocol.h"

namespace palpa::cli {

/// The options of a session that holds the next trials of a study: what the block's condition shows
/// and lets feel, its task, its chances, which are the same for every trainee; nothing that is
/// otherwise offered to beginners (demonstration, a first try of its own).
SessionOptions studySession(const SessionOptions& place, const study::Protocol& protocol,
                            const record::Enrolment& enrolment, const study::Next& next);

/// A folder that is not there yet: <out>/<trainee>/<step>-<block>[-<trial>].
std::filesystem::path studyFolder(const std::string& out, const study::Protocol& protocol,
                                  const std::string& trainee, const study::Next& next);

}  // namespace palpa::cli

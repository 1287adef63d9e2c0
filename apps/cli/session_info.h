#pragma once

#include <filesystem>
#include <nlohmann/json.hpp>

#include "apps/cli/needle_world.h"
#include "apps/record/session_file.h"

namespace palpa::cli {

/// "person", "recorded", "novice", "learner", "expert".
const char* nameOf(OperatorKind who);

/// What a session says of itself, with the study that it is part of, if any.
std::string sessionText(nlohmann::json session, const SessionOptions& options);

/// Whether anything in the session is simulated: the operator, or what is seen and felt.
bool isSimulated(const SessionOptions& options, const NeedleWorld& world);

/// What the loop runs with: materials, safety, coupling, rate; what the device and whoever holds it
/// can do.
haptics::TickConfig tickConfig(const SessionOptions& options, const NeedleWorld& world);

/// What the evidence says of the session. `folder`: for a passing file.
record::SessionInfo sessionInfo(const SessionOptions& options, const NeedleWorld& world,
                                const std::filesystem::path& folder);

}  // namespace palpa::cli

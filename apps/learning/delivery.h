#pragma once

#include "apps/learning/launches.h"
#include "apps/learning/lti_scores.h"

namespace palpa::learning {

/// Sends what is due of a launch, in its order, and keeps after each what is left: statements have
/// ids that stay, a score is the same however often it comes, so what is sent twice counts once.
/// Ends at the first that does not arrive. May wait for the platform, 15 s a request. Throws Error
/// where it cannot be kept.
Delivered deliver(Launch& launch, Launches& launches, const Settings& settings,
                  const SigningKey& key, std::chrono::sys_seconds now);

}  // namespace palpa::learning

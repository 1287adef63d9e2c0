#pragma once

#include <chrono>
#include <nlohmann/json.hpp>
#include <string>

#include "apps/learning/settings.h"
#include "apps/learning/signed_token.h"

/// Scores to a platform: Assignment and Grade Services 2.0, with a token for which the console
/// signs (Security Framework 1.0, section 4.1).
namespace palpa::learning {

struct ScoreFacts {
  std::string person;      ///< what the platform calls them
  double scaled = 0;       ///< share of trials at the task's standard
  bool completed = false;  ///< all trials that were asked for were held
  bool simulated = false;
  std::string time_utc;  ///< to the millisecond
};
nlohmann::json scoreFrom(const ScoreFacts& facts);

enum class Delivery { done, later, refused };
struct Delivered {
  Delivery how = Delivery::done;
  std::string words;  ///< why not, with what the platform answered
};

/// What an HTTP status means for what was sent: whether to try again.
Delivered deliveredBy(int status, const std::string& trouble);

/// One score to `line_item`; at most two requests.
Delivered sendScore(const nlohmann::json& score, const std::string& line_item,
                    const Platform& platform, const SigningKey& key, std::chrono::sys_seconds now,
                    const link::WebTimes& times = kPlatformTimes);

}  // namespace palpa::learning

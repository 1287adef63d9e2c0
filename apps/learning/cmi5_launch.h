#pragma once

#include <nlohmann/json.hpp>
#include <optional>
#include <string>

#include "apps/learning/settings.h"
#include "apps/learning/web_text.h"

/// A launch by cmi5 (Quartz, 1st edition): what its address says, and what the learning management
/// system then tells.
namespace palpa::learning {

/// The address of a launch (section 8.1).
struct Cmi5Request {  // NOLINT(bugprone-exception-escape): JSON, of which it is made, throws none
  const Platform* platform = nullptr;
  std::string endpoint, fetch, activity, registration;
  /// {"objectType", "account"}: what else it may say of a person is left out, and kept nowhere.
  nlohmann::json actor;
  std::string person() const;  ///< the account, as one text
};

/// Throws UsageError for what is missing or none, and for addresses of no configured platform.
Cmi5Request readCmi5Request(const Fields& fields, const Settings& settings);

enum class LaunchMode { normal, browse, review };

/// LMS.LaunchData (section 10) and what of the learner's preferences (section 11) counts here.
struct LaunchData {        // NOLINT(bugprone-exception-escape): as above
  nlohmann::json context;  ///< the template
  LaunchMode mode = LaunchMode::normal;
  std::optional<double> mastery;
  std::string return_url;  ///< empty: none, or of another origin than the platform's
  bool audio = true;
};

/// Throws UsageError for a document that lacks what it must have.
LaunchData readLaunchData(const nlohmann::json& document, const Platform& platform);

/// What a platform gave for a launch; the token is a secret.
struct Cmi5Session {  // NOLINT(bugprone-exception-escape): as above
  std::string token;
  LaunchData data;
};

/// Asks the platform: the token by one POST to `fetch`, then launch data and preferences. Throws
/// UsageError where it refuses or answers otherwise than cmi5 asks; at most 15 s each.
Cmi5Session askPlatform(const Cmi5Request& request);

}  // namespace palpa::learning

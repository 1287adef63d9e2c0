#pragma once

#include <cstdint>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

/// The statements of a launch by cmi5 (section 9), from plain facts: the same facts give the same
/// statements with the same ids, so that what is sent again is stored once.
namespace palpa::learning {

/// The names that cmi5 gives to extensions, categories and verbs (sections 9.3 and 9.6).
inline constexpr char kSessionId[] = "https://w3id.org/xapi/cmi5/context/extensions/sessionid",
                      kMasteryScore[] =
                          "https://w3id.org/xapi/cmi5/context/extensions/masteryscore",
                      kCmi5Category[] = "https://w3id.org/xapi/cmi5/context/categories/cmi5",
                      kMoveOnCategory[] = "https://w3id.org/xapi/cmi5/context/categories/moveon",
                      kVerbRoot[] = "http://adlnet.gov/expapi/verbs/";

/// What all statements of one launch have in common.
struct Cmi5Facts {
  std::string launch;  ///< a UUID of ours: the namespace of the statements' ids
  nlohmann::json actor, context;
  std::string activity, registration;
  bool counts = true;                  ///< launch mode Normal; else satisfaction is not told
  std::optional<double> mastery = {};  ///< as the platform's launch data have it
  std::string began_utc = "";          ///< to the millisecond
};
nlohmann::json toJson(const Cmi5Facts& facts);
Cmi5Facts cmi5FactsIn(const nlohmann::json& json);  ///< throws nlohmann's exceptions

/// What came of the session.
struct LaunchResult {
  bool completed = false;             ///< all trials that were asked for were held
  std::optional<double> scaled = {};  ///< share of trials at the task's standard; none were scored
  bool simulated = false;
  std::int64_t length_ms = 0;  ///< of the launch
};

/// Told earlier of this registration and activity, in other sessions.
struct ToldBefore {
  bool completed = false, passed = false;
};

/// At or above it a trainee passes: the platform's, or else all trials.
double masteryOf(const Cmi5Facts& facts);

nlohmann::json initialized(const Cmi5Facts& facts);
/// In their order: completed, passed or failed, and always terminated as the last.
std::vector<nlohmann::json> statementsAtEnd(const Cmi5Facts& facts, const LaunchResult& result,
                                            const ToldBefore& before);

}  // namespace palpa::learning

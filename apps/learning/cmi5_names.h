#pragma once

/// The names that cmi5 gives to extensions, categories and verbs (sections 9.3 and 9.6).
namespace palpa::learning {

inline constexpr char kSessionId[] = "https://w3id.org/xapi/cmi5/context/extensions/sessionid",
                      kMasteryScore[] =
                          "https://w3id.org/xapi/cmi5/context/extensions/masteryscore",
                      kCmi5Category[] = "https://w3id.org/xapi/cmi5/context/categories/cmi5",
                      kMoveOnCategory[] = "https://w3id.org/xapi/cmi5/context/categories/moveon",
                      kVerbRoot[] = "http://adlnet.gov/expapi/verbs/";

}  // namespace palpa::learning

#pragma once

#include <nlohmann/json.hpp>
#include <string>

namespace palpa::link_test {

/// Why a text is no statement by the rules of xAPI 1.0.3, part 2; empty: it is one. Strict: what
/// the standard does not name is refused.
std::string whyNoStatement(const nlohmann::json& statement);

bool isIri(
    const std::string& text);  ///< RFC 3987: a scheme, no spaces, nothing that needs encoding
bool isTimestamp(const std::string& text);  ///< ISO 8601 (RFC 3339) with a zone, not -00:00
bool isDuration(const std::string& text);   ///< ISO 8601: P3Y6M4DT12H30M5.25S or P4W

}  // namespace palpa::link_test

#pragma once

#include <functional>
#include <nlohmann/json.hpp>
#include <string>
#include <string_view>

/// Reading JSON, compiled once: the parser's templates take seconds in every source that calls
/// nlohmann's `parse` itself.
namespace palpa {

/// Throws nlohmann::json::exception.
nlohmann::json parseJson(std::string_view text);

/// Calls `too_deep`, which must throw, where the text is nested deeper than `deepest`.
nlohmann::json parseJson(std::string_view text, int deepest, const std::function<void()>& too_deep);

/// Why `text` could not be parsed, or what was parsed from it not be used, in words for people: the
/// line, the column and what is wrong there. No other place tells people of such an exception.
std::string whyNoJson(std::string_view text, const nlohmann::json::exception& refused);

/// What is no JSON gives a value that is_discarded().
nlohmann::json parsedOrDiscarded(std::string_view text);

}  // namespace palpa

#pragma once

#include <filesystem>
#include <nlohmann/json.hpp>

/// What came of a recorded session, for the pages of the console.
namespace palpa::console {

/// Each trial of the evidence: {"number", "role", "outcome", "reason", "counts", "length_s"} and,
/// where they are known, "total", "summary" and "goal". Of a blind study only what tells nothing of
/// a result. Empty where there is no evidence; throws Error where it is damaged.
///
/// A goal, {"reached", "word", "called"}: whether the trial came to what its task is about, in a
/// word ("right", "wrong"), and what those that did are called ("right").
nlohmann::json trialsIn(const std::filesystem::path& evidence, bool blind);

/// Of the trials that count, for a list: {"counting", "succeeded", "done"}, how many there are,
/// how many reached their goal or, where no goal is known, were only done; "word", what those that
/// succeeded are called; "total", the mean of the penalties.
nlohmann::json outcomeOf(const nlohmann::json& trials);

}  // namespace palpa::console

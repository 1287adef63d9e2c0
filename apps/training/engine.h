#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "anatomy/base/json_file.h"

namespace palpa::training {

/// What is trained, and by which rules: the field `engine` of a task's file.
enum class Engine : std::uint8_t { needle, palpation, squeeze, search, friction, pulse };

/// "needle", "palpation", "squeeze", "search", "friction", "pulse": in files, tables and on pages.
const std::string& nameOf(Engine engine);

/// The subcommand that holds such a session: "subclavian" for a needle, else the engine's name.
const std::string& commandOf(Engine engine);

/// A task as pages name it: "subclavian access", "bone pin". `id`: as files and records have it, in
/// which the first keeps the name that it always had, "paracentesis".
std::string taskWords(const std::string& id);
/// The id of a task that somebody names by its command or by its id.
std::string taskIdOf(const std::string& named);

/// None for an unknown name. Files from before 2026-12 call a search "surface".
std::optional<Engine> engineNamed(std::string_view name);

/// Of a task, a learner, ...: its field `engine`. Throws UsageError for an unknown one.
Engine engineIn(const JsonFile& file);

/// Throws UsageError where the file is another engine's.
void needEngine(const JsonFile& file, Engine engine);

}  // namespace palpa::training

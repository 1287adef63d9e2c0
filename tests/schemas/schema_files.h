#pragma once

#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

/// The published schemas, and which shipped file is of which kind.
namespace palpa::schemas {

std::filesystem::path assetsFolder();
nlohmann::json jsonOf(const std::filesystem::path& file);
bool matches(const std::string& text, const std::string& pattern);  ///< the whole of it

/// assets/schemas/<kind>.schema.json as it is written.
nlohmann::json publishedSchema(const std::string& kind);
/// The same, each reference replaced by what it refers to.
nlohmann::json schemaOf(const std::string& kind);
/// Of every schema but "common", which is no kind of file.
std::vector<std::string> publishedKinds();

/// The kinds that a shipped file is of, by its path under assets/: none for a file that nobody
/// edits or reads as one of them, two for a task.
std::vector<std::string> kindsOf(const std::string& asset);
/// Paths under assets/ of all shipped JSON files but the schemas.
std::vector<std::string> shippedFiles();

}  // namespace palpa::schemas

#pragma once

#include <filesystem>
#include <string_view>

namespace palpa {

/// The file is there whole or not at all: written beside under another name, then renamed.
/// Throws Error.
void writeWhole(const std::filesystem::path& file, std::string_view content);

}  // namespace palpa

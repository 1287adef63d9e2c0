#pragma once

#include <filesystem>
#include <string>
#include <string_view>

namespace palpa {

/// SHA-256 (FIPS 180-4) as 64 hexadecimal digits.
std::string sha256(std::string_view bytes);

/// Of a file's bytes, as `sha256sum` prints it. Throws UsageError when the file cannot be read.
std::string sha256OfFile(const std::filesystem::path& file);

}  // namespace palpa

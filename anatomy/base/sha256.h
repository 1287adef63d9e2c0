#pragma once

#include <filesystem>
#include <string>
#include <string_view>

namespace palpa {

/// SHA-256 (FIPS 180-4) as 64 hexadecimal digits.
std::string sha256(std::string_view bytes);

/// PBKDF2 with HMAC-SHA-256 (RFC 8018, 5.2), 32 bytes as 64 hexadecimal digits: slow on purpose, so
/// that what is short cannot be found by trying all.
std::string slowSha256(std::string_view text, std::string_view salt, int rounds);

/// Of a file's bytes, as `sha256sum` prints it. Throws UsageError when the file cannot be read.
std::string sha256OfFile(const std::filesystem::path& file);

}  // namespace palpa

#pragma once

#include <filesystem>
#include <string>
#include <system_error>

namespace palpa {

/// Why a file could not be made, written or renamed, in words, and what to do about it.
struct FileTrouble {
  std::string why;  ///< a clause: "the disk is full"
  std::string remedy;
};

/// `error`: errno, or the value of an error_code of the system.
FileTrouble fileTrouble(int error);

/// Throws Error: `what` and why, of this file or folder. `instead`: the way out that the caller
/// knows ("Choose another folder with --out"); it is added to what helps in any case.
[[noreturn]] void failFile(const std::string& what, const std::filesystem::path& file, int error,
                           const std::string& instead = "");
[[noreturn]] void failFile(const std::string& what, const std::filesystem::path& file,
                           const std::error_code& error, const std::string& instead = "");

}  // namespace palpa

#pragma once

#include <stdexcept>
#include <string>

namespace palpa {

/// An error somebody can act on: what happened, where (file, field), what to do about it.
/// Thrown during set-up, file input and output; never inside the haptic tick.
class Error : public std::runtime_error {
 public:
  Error(const std::string& what, const std::string& where, const std::string& remedy)
      : std::runtime_error(where + ": " + what + ". " + remedy) {}
};

/// A mistake on the command line or in a configuration file (exit code 2 instead of 1).
class UsageError : public Error {
 public:
  using Error::Error;
};

/// What went wrong, without what stands below its first line.
inline std::string firstLine(const std::exception& e) {
  const std::string what = e.what();
  return what.substr(0, what.find('\n'));
}

/// What `read` gives. Its UsageErrors become Errors: what is wrong in a file that the program
/// wrote, or that comes with it, is no mistake in how it was called.
template <typename Read>
auto readOwnFile(Read read) -> decltype(read()) {
  try {
    return read();
  } catch (const UsageError& e) {
    throw Error(static_cast<const Error&>(e));
  }
}

}  // namespace palpa

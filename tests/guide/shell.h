#pragma once

#include <string>

namespace palpa::guide {

/// What a shell's command says on standard output; throws std::runtime_error, with what it said,
/// where it does not exit with 0.
std::string outputOf(const std::string& command);

/// Runs it, shows what it says, and tells its exit code.
int run(const std::string& command);

}  // namespace palpa::guide

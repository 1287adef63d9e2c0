#pragma once

#include <string>

#include "apps/cli/command_tree.h"

namespace palpa::cli {

/// The program's manual page, palpa(1), in roff: every command with its options and examples.
/// `welcome`: what the program says when it is started alone.
std::string manualPage(const CommandText& program, const std::string& version,
                       const std::string& welcome);

/// A completion of bash: commands, options, words that may be chosen, files and folders where an
/// option takes them.
std::string bashCompletion(const CommandText& program);

}  // namespace palpa::cli

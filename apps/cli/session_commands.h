#pragma once

#include "apps/cli/session_options.h"

namespace palpa::cli {

/// A whole session with its results, as the command of that name runs it. Throws UsageError or Error.
void runParacentesisCommand(SessionOptions options);
void runPalpationCommand(SessionOptions options);
void runSqueezeCommand(SessionOptions options);
void runSearchCommand(SessionOptions options);

}  // namespace palpa::cli

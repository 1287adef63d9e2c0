#pragma once

namespace palpa::cli {

/// `palpa console` with nothing said: what `palpa` alone does where there is a display.
void runConsole();

}  // namespace palpa::cli

#pragma once

#include <functional>
#include <string>
#include <vector>

#include "apps/console/place.h"
#include "apps/live/live_sink.h"

namespace palpa::console {

struct ConsoleSettings {
  ConsolePlace place;
  std::string station;  ///< file, in use from now on for what it is for; empty: as before
  std::string address = "127.0.0.1";
  int port = 0;                    ///< 0: any that is free
  std::string token;               ///< needed for any other address than this computer's own
  live::ToneOf tone;               ///< of a replay's events
  std::vector<std::string> names;  ///< by which pages may also call it, without port
};

/// This computer alone can reach it.
bool isLoopback(const std::string& address);

/// Serves until SIGINT or SIGTERM; sessions go on then. `ready`: called with the address of the
/// page when it is there. Throws Error where another console uses the same place, or the port is
/// taken; UsageError for an address open to others without a token.
void serveConsole(const ConsoleSettings& settings,
                  const std::function<void(const std::string& url)>& ready);

}  // namespace palpa::console

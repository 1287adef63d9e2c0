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
  /// Encrypted; for an address that others can reach in any case
  bool tls = false;
  std::string certificate, key;  ///< files of the centre's own; empty: made in the home
  /// A room's folder: this console watches it; or a station's pairing file: this one is of it.
  std::filesystem::path room;
};

/// A console that can be used.
struct OpenedConsole {
  std::string url;
  std::string fingerprint;          ///< of its certificate; empty: it is not encrypted
  std::filesystem::path authority;  ///< who vouches for it, as a file; empty: the centre's own
  std::string authority_fingerprint;
  bool authority_is_new = false;  ///< who believed the one before does not know it
};

/// This computer alone can reach it.
bool isLoopback(const std::string& address);

/// Serves until SIGINT or SIGTERM; sessions go on then. `ready`: called when the page is there.
/// Throws Error where another console uses the same place, or the port is taken; UsageError for an
/// address open to others without a token, and for a certificate that is none.
void serveConsole(const ConsoleSettings& settings,
                  const std::function<void(const OpenedConsole&)>& ready);

}  // namespace palpa::console

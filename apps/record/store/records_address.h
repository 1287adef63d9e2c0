#pragma once

#include <string>

namespace palpa::record {

/// "postgresql://..." or "postgres://...": a server.
bool isServer(const std::string& address);

/// Records are the path of a file or the address of a server. Throws UsageError for any other
/// scheme, for a server's settings as words ("host=... password=..."), which are no file's name,
/// and for an address that holds a password. A message never repeats what may be secret.
void requireAddress(const std::string& address);

/// What libpq takes from the environment where an address leaves it out: PGHOST, PGHOSTADDR (it
/// counts instead of any host), PGSERVICE.
struct ServerDefaults {
  std::string host = {}, number = {}, service = {};
};
ServerDefaults serverDefaults();

/// The address with the encryption that it needs: beyond this computer TLS, and a certificate that
/// is the server's (sslmode=verify-full, or verify-ca where the address says so). Throws UsageError
/// for one that asks for less there. On this computer (no host, a socket, localhost, 127.x, ::1)
/// it stays as it is: TLS where the server has it, libpq's default.
std::string withEncryption(const std::string& address, const ServerDefaults& defaults);

}  // namespace palpa::record

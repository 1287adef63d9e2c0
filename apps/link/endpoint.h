#pragma once

#include <filesystem>
#include <string>

namespace palpa::link {

/// Where a learning record store listens.
struct Endpoint {
  std::string origin;  ///< "https://lrs.centre.example:8443"
  std::string host;    ///< without brackets and port
  std::string path;    ///< "/xapi"; empty: at the root. The statements are below it
  std::string text() const { return origin + path; }
};

/// Throws UsageError: no such address; a password in it (it would end in process lists and shell
/// histories); http, unless to this computer or `insecure`.
Endpoint endpointOf(const std::string& url, bool insecure);

struct Login {
  std::string user, password;  ///< empty user: none is needed
};

/// The password of `user` at `host`: $PALPA_XAPI_PASSWORD, else $NETRC, else ~/.netrc ("machine
/// HOST login USER password PASSWORD"). No user given: the one that the file names for this host,
/// else none. Throws UsageError for a user without a password and for a file that others may read.
Login loginFor(const std::string& host, const std::string& user);

/// From a file of that kind; empty where host (and user, if given) is not in it.
Login loginIn(const std::filesystem::path& file, const std::string& host, const std::string& user);

}  // namespace palpa::link

#pragma once

#include <filesystem>
#include <string>

#include "apps/link/web_client.h"

namespace palpa::link {

/// Throws UsageError: no such address; a password in it (it would end in process lists and shell
/// histories); http, unless to this computer or `insecure`.
Endpoint endpointOf(const std::string& url, bool insecure);

struct Login {
  std::string user = "", password = "";  ///< empty user: none is needed
  std::string token = "";  ///< of "Authorization: Basic", as a cmi5 launch gives it; or empty
};

/// The password of `user` at `host`: $PALPA_XAPI_PASSWORD, else $NETRC, else ~/.netrc ("machine
/// HOST login USER password PASSWORD"). No user given: the one that the file names for this host,
/// else none. Throws UsageError for a user without a password and for a file that others may read.
Login loginFor(const std::string& host, const std::string& user);

/// From a file of that kind; empty where host (and user, if given) is not in it.
Login loginIn(const std::filesystem::path& file, const std::string& host, const std::string& user);

/// What came back.
struct LrsAnswer {
  int status = 0;  ///< 0: nothing that could be understood
  /// It named a version of the Experience API, as every answer of a learning record store must
  bool is_lrs = false;
  std::string body;     ///< as it came: not to be shown without `plainText`
  std::string trouble;  ///< of status 0, in words
};

using LrsTimes = WebTimes;

/// A learning record store over HTTP, xAPI 1.0.3: as WebClient, and throws nothing.
class LrsClient {
 public:
  static constexpr std::size_t kLongestAnswer = WebClient::kLongestAnswer;
  LrsClient(const Endpoint& endpoint, const Login& login, const LrsTimes& times = {});
  LrsAnswer put(const std::string& id, const std::string& statement);
  LrsAnswer get(const std::string& id, bool voided = false);
  /// What else it keeps, below the endpoint: "/activities/state?...".
  LrsAnswer read(const std::string& resource);

 private:
  LrsAnswer answerTo(WebRequest request);
  const Endpoint endpoint_;
  const std::string token_;
  WebClient client_;
};

}  // namespace palpa::link

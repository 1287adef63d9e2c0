#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
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

/// What came back.
struct LrsAnswer {
  int status = 0;  ///< 0: nothing that could be understood
  /// It named a version of the Experience API, as every answer of a learning record store must
  bool is_lrs = false;
  std::string body;     ///< as it came: not to be shown without `plainText`
  std::string trouble;  ///< of status 0, in words
};

struct LrsTimes {
  std::int64_t connect_s = 10;
  std::int64_t answer_s = 30;  ///< without a byte of it
  std::int64_t whole_s = 60;   ///< the connecting, the request and the whole answer
};

/// The statements of a learning record store over HTTP, xAPI 1.0.3. Certificates are checked
/// against those that the system trusts (or $SSL_CERT_FILE). Redirections are not followed: they
/// would take the password elsewhere. An answer of more than kLongestAnswer, or that has not ended
/// in time however it drips, is given up. Throws nothing.
class LrsClient {
 public:
  static constexpr std::size_t kLongestAnswer = 1u << 20;
  LrsClient(const Endpoint& endpoint, const Login& login, const LrsTimes& times = {});
  ~LrsClient();
  LrsAnswer put(const std::string& id, const std::string& statement);
  LrsAnswer get(const std::string& id, bool voided = false);

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace palpa::link

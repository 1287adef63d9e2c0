#pragma once

#include <cstdint>
#include <memory>
#include <string>

#include "apps/link/endpoint.h"

namespace palpa::link {

/// What came back.
struct LrsAnswer {
  int status = 0;       ///< 0: nothing that could be understood
  bool is_lrs = false;  ///< it named a version of the Experience API, as every answer of a learning
                        ///< record store must
  std::string body;
  std::string trouble;  ///< of status 0, in words
};

struct LrsTimes {
  std::int64_t connect_s = 10, answer_s = 30;
};

/// The statements of a learning record store over HTTP, xAPI 1.0.3. Certificates are checked
/// against those that the system trusts (or $SSL_CERT_FILE). Redirections are not followed: they
/// would take the password elsewhere. Throws nothing.
class LrsClient {
 public:
  LrsClient(const Endpoint& endpoint, const Login& login, const LrsTimes& times = {});
  ~LrsClient();
  LrsAnswer put(const std::string& id, const std::string& statement);
  LrsAnswer get(const std::string& id, bool voided = false);

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace palpa::link

#pragma once

#include <atomic>
#include <cstdint>
#include <memory>
#include <string>
#include <utility>
#include <vector>

namespace palpa::link {

/// Where a server of the web listens.
struct Endpoint {
  std::string origin;  ///< "https://lrs.centre.example:8443"
  std::string host;    ///< without brackets and port
  std::string path;    ///< "/xapi"; empty: at the root
  std::string text() const { return origin + path; }
};

struct WebTimes {
  std::int64_t connect_s = 10;
  std::int64_t answer_s = 30;  ///< without a byte of it
  std::int64_t whole_s = 60;   ///< the connecting, the request and the whole answer
  const std::atomic<bool>* given_up = nullptr;  ///< once true, what is asked ends; outlives it
};

struct WebRequest {
  std::string method = "GET";
  std::string path;  ///< from the origin on, with its query
  std::string body = "", content_type = "";
  std::vector<std::pair<std::string, std::string>> headers = {};
};

/// What came back.
struct WebAnswer {
  int status = 0;            ///< 0: nothing that could be understood
  std::string xapi_version;  ///< of the Experience API, where the answer names one
  std::string body;          ///< as it came: not to be shown without `plainText`
  std::string trouble;       ///< of status 0, in words
};

/// Requests to one server. Certificates are checked against those that the system trusts (or
/// $SSL_CERT_FILE). Redirections are not followed: they would take secrets elsewhere. An answer of
/// more than kLongestAnswer, or that has not ended in time however it drips, is given up. One
/// thread.
class WebClient {
 public:
  static constexpr std::size_t kLongestAnswer = 1u << 20;
  explicit WebClient(const Endpoint& endpoint, const WebTimes& times = {});
  ~WebClient();
  void login(const std::string& user, const std::string& password);
  /// Throws nothing: what goes wrong is in the answer.
  WebAnswer answerTo(const WebRequest& request);

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace palpa::link

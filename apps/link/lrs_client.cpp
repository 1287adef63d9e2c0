#include "apps/link/lrs_client.h"

#include <httplib.h>

namespace palpa::link {
namespace {

constexpr char kVersionHeader[] = "X-Experience-API-Version", kVersion[] = "1.0.3";

std::string inWords(httplib::Error error) {
  switch (error) {
    case httplib::Error::Connection:
      return "nobody answers there";
    case httplib::Error::ConnectionTimeout:
      return "no connection within the time allowed";
    case httplib::Error::Read:
      return "the answer did not come, broke off or was none";
    case httplib::Error::Write:
      return "the connection broke off";
    case httplib::Error::SSLConnection:
      return "no protected connection could be agreed on";
    case httplib::Error::SSLLoadingCerts:
      return "the trusted certificates cannot be read";
    case httplib::Error::SSLServerVerification:
      return "its certificate is not trusted, or is another computer's";
    default:
      return httplib::to_string(error);
  }
}

}  // namespace

struct LrsClient::Impl {
  Impl(const Endpoint& e, const Login& login, const LrsTimes& times)
      : endpoint(e), client(e.origin) {
    client.set_connection_timeout(times.connect_s);
    client.set_read_timeout(times.answer_s);
    client.set_write_timeout(times.answer_s);
    client.set_keep_alive(true);
    client.set_tcp_nodelay(true);  // head and body are written apart, and would wait for each other
    client.set_follow_location(false);
    client.enable_server_certificate_verification(true);
    if (!login.user.empty()) client.set_basic_auth(login.user, login.password);
  }

  std::string resource(const char* parameter, const std::string& id) const {
    return endpoint.path + "/statements?" + parameter + "=" + id;
  }

  static LrsAnswer answerOf(const httplib::Result& result) {
    LrsAnswer answer;
    if (!result) {
      answer.trouble = inWords(result.error());
      return answer;
    }
    answer.status = result->status;
    answer.is_lrs = result->get_header_value(kVersionHeader).rfind("1.", 0) == 0;
    answer.body = result->body;
    return answer;
  }

  const Endpoint endpoint;
  httplib::Client client;
  const httplib::Headers headers{{kVersionHeader, kVersion}, {"Accept", "application/json"}};
};

LrsClient::LrsClient(const Endpoint& endpoint, const Login& login, const LrsTimes& times)
    : impl_(std::make_unique<Impl>(endpoint, login, times)) {}
LrsClient::~LrsClient() = default;

LrsAnswer LrsClient::put(const std::string& id, const std::string& statement) {
  return Impl::answerOf(impl_->client.Put(impl_->resource("statementId", id), impl_->headers,
                                          statement, "application/json"));
}
LrsAnswer LrsClient::get(const std::string& id, bool voided) {
  return Impl::answerOf(impl_->client.Get(
      impl_->resource(voided ? "voidedStatementId" : "statementId", id), impl_->headers));
}

}  // namespace palpa::link

#include "tests/link/loopback_lrs.h"

#include <httplib.h>

#include "apps/link/statement.h"
#include "apps/runtime/clock.h"
#include "tests/link/xapi_rules.h"

namespace palpa::link_test {
namespace {

using httplib::Request;
using httplib::Response;
using nlohmann::json;

constexpr char kVersion[] = "X-Experience-API-Version";
constexpr std::int64_t kTooSlow = 1500 * runtime::kMillisecond;

/// The answer's head comes, its body never: the client sees a broken connection.
void breakOff(Response& response) {
  response.set_content_provider(1000, "application/json",
                                [](std::size_t, std::size_t, httplib::DataSink&) { return false; });
}

}  // namespace

struct LoopbackLrs::Impl {
  httplib::Server server;
  mutable std::mutex mutex;
  std::map<std::string, Stored> statements;
  std::vector<std::string> complaints;

  void complain(Response& response, int status, const std::string& rule) {
    response.status = status;
    response.set_content(rule, "text/plain");
    complaints.push_back(rule);
  }

  /// Empty: the request may be answered.
  bool refused(const LoopbackLrs& lrs, const Request& request, Response& response) {
    response.set_header(kVersion, "1.0.3");
    if (request.get_header_value(kVersion).rfind("1.0", 0) != 0)
      return complain(response, 400, "no version of the Experience API"), true;
    if (lrs.user.empty()) return false;
    const auto [name, value] = httplib::make_basic_authentication_header(lrs.user, lrs.password);
    if (request.get_header_value(name) == value) return false;
    response.status = 401;
    return true;
  }

  void store(const LoopbackLrs& lrs, const std::string& id, const json& statement,
             Response& response) {
    const auto known = statements.find(id);
    if (known != statements.end()) {  // never changed, whatever comes
      const bool same = link::saysTheSame(statement, known->second.statement);
      response.status = same && !lrs.conflicts_on_same ? 204 : 409;
      if (!same) complaints.push_back("another statement under the id " + id);
      return;
    }
    if (statement["verb"]["id"] == "http://adlnet.gov/expapi/verbs/voided") {
      const auto target = statements.find(statement["object"]["id"].get<std::string>());
      if (target == statements.end()) return complain(response, 400, "voids what is not there");
      target->second.voided = true;
    }
    Stored& kept = statements[id];
    kept.statement = statement;
    kept.statement["stored"] = "2026-03-01T12:00:00.000Z";
    kept.statement["version"] = "1.0.0";
    kept.statement["authority"] = {{"objectType", "Agent"}, {"mbox", "mailto:lrs@example.org"}};
    ++kept.times;
    response.status = 204;
  }

  void put(const LoopbackLrs& lrs, const Request& request, Response& response) {
    if (refused(lrs, request, response)) return;
    const std::string id = request.get_param_value("statementId");
    if (request.params.size() != 1 || id.empty())
      return complain(response, 400, "statementId is missing, or there is more");
    if (request.get_header_value("Content-Type").rfind("application/json", 0) != 0)
      return complain(response, 400, "no application/json");
    const json statement = json::parse(request.body, nullptr, false);
    if (statement.is_discarded()) return complain(response, 400, "no JSON");
    if (const std::string why = whyNoStatement(statement); !why.empty())
      return complain(response, 400, why);
    if (statement.contains("id") && statement["id"] != id)
      return complain(response, 400, "id is not statementId");
    store(lrs, id, statement, response);
  }

  void get(const LoopbackLrs& lrs, const Request& request, Response& response) {
    if (refused(lrs, request, response)) return;
    const bool voided = request.has_param("voidedStatementId");
    if (voided == request.has_param("statementId"))
      return complain(response, 400, "one of statementId and voidedStatementId");
    const auto found =
        statements.find(request.get_param_value(voided ? "voidedStatementId" : "statementId"));
    response.status = found == statements.end() || found->second.voided != voided ? 404 : 200;
    if (response.status == 200)
      response.set_content(found->second.statement.dump(), "application/json");
  }
};

LoopbackLrs::LoopbackLrs() = default;
LoopbackLrs::~LoopbackLrs() { stop(); }

void LoopbackLrs::start() {
  auto next = std::make_unique<Impl>();
  if (impl_) next->statements = impl_->statements, next->complaints = impl_->complaints;
  impl_ = std::move(next);
  Impl& impl = *impl_;
  impl.server.set_keep_alive_timeout(1);
  impl.server.set_tcp_nodelay(true);
  impl.server.Put("/xapi/statements", [this, &impl](const Request& request, Response& response) {
    const Mishap what = mishap(puts_++);
    if (what == Mishap::drop_before) return breakOff(response);
    if (what == Mishap::login_page)
      return response.set_content("<html>Please log in</html>", "text/html");
    if (what == Mishap::error_500 || what == Mishap::too_many) {
      response.set_header(kVersion, "1.0.3");
      response.status = what == Mishap::too_many ? 429 : 500;
      return;
    }
    if (what == Mishap::slow) runtime::SteadyClock().sleepUntil(kTooSlow);
    const std::lock_guard lock(impl.mutex);
    impl.put(*this, request, response);
    if (what == Mishap::drop_after) breakOff(response);
    if (what == Mishap::unlike_an_lrs) response.headers.erase(kVersion);
  });
  impl.server.Get("/xapi/statements", [this, &impl](const Request& request, Response& response) {
    const std::lock_guard lock(impl.mutex);
    impl.get(*this, request, response);
  });
  if (port_ == 0)
    port_ = impl.server.bind_to_any_port("127.0.0.1");
  else
    for (int tries = 200; tries > 0 && !impl.server.bind_to_port("127.0.0.1", port_); --tries)
      runtime::SteadyClock().sleepUntil(10 * runtime::kMillisecond);
  thread_ = std::thread([&impl] { impl.server.listen_after_bind(); });
  while (!impl.server.is_running()) runtime::SteadyClock().sleepUntil(runtime::kMillisecond);
}

void LoopbackLrs::stop() {
  if (!thread_.joinable()) return;
  impl_->server.stop();
  thread_.join();
}

std::string LoopbackLrs::url() const {
  return "http://127.0.0.1:" + std::to_string(port_) + "/xapi";
}

std::map<std::string, LoopbackLrs::Stored> LoopbackLrs::stored() const {
  const std::lock_guard lock(impl_->mutex);
  return impl_->statements;
}

std::vector<std::string> LoopbackLrs::complaints() const {
  const std::lock_guard lock(impl_->mutex);
  return impl_->complaints;
}

void LoopbackLrs::keep(const json& statement) {
  const std::lock_guard lock(impl_->mutex);
  Stored& kept = impl_->statements[statement.at("id")];
  kept.statement = statement;
  ++kept.times;
}

}  // namespace palpa::link_test

#include <gtest/gtest.h>

#include <atomic>
#include <chrono>
#include <future>
#include <memory>
#include <thread>
#include <vector>

#include "anatomy/base/utc.h"
#include "apps/console/web/web_server.h"
#include "apps/os/tls/kept_identity.h"
#include "apps/runtime/clock.h"
#include "tests/console/visitor.h"
#include "tests/support/scratch_folder.h"

/// The web server behind its encryption, asked as a browser asks it.
namespace palpa::console {
namespace {

using namespace std::chrono_literals;

struct Encrypted {
  Encrypted() {
    port = server.bind_to_any_port("127.0.0.1");
    here = "127.0.0.1:" + std::to_string(port);
    guard.answerTo({here}, "https");
    server.Get("/long", [this](const httplib::Request&, httplib::Response& r) {
      r.set_content(answer, "text/plain");
    });
    server.Get("/held", [this](const httplib::Request&, httplib::Response&) {
      ++held;
      all_go.wait();
    });
    server.Get("/enter", [this](const httplib::Request&, httplib::Response& r) {
      r.set_header("Set-Cookie", guard.cookieText("palpa", "1"));
    });
    server.Post("/said", [](const httplib::Request& q, httplib::Response& r) {
      r.set_content(q.body, "text/plain");
    });
    server.Post("/api/sessions/a1/stop", [this](const httplib::Request&, httplib::Response& r) {
      ++stops;
      answerWith202(r);
    });
    serving = std::thread([this] { server.serve(); });
  }
  ~Encrypted() {
    server.end();
    serving.join();
  }
  static void answerWith202(httplib::Response& r) {
    palpa::console::answer(r, nlohmann::json::object(), 202);
  }
  std::unique_ptr<httplib::SSLClient> browser(const std::string& believes) const {
    auto client = std::make_unique<httplib::SSLClient>("127.0.0.1", port);
    client->set_ca_cert_path(believes);
    client->enable_server_certificate_verification(true);
    client->set_read_timeout(60s);
    return client;
  }
  std::unique_ptr<httplib::SSLClient> browser() const { return browser(kept.authority); }
  httplib::Headers ofAPage(const std::string& origin) const {
    return {{"Origin", origin + here},
            {"X-Palpa-Page", guard.pageKey()},
            {"X-Palpa-Write", randomKey()}};
  }

  const test::ScratchFolder folder{"encrypted"};
  const os::KeptIdentity kept =
      os::keptIdentity(folder / "tls", {.name = "Palpa console", .reached_by = {"127.0.0.1"}},
                       utcSecondsOf(runtime::utcNow()));
  const std::string answer = std::string(300'000, 'a');
  const os::TlsServer tls{kept.identity};
  Guard guard{""};
  Refusals refusals{folder / "refused.log"};
  WebServer server{guard, refusals, &tls};
  std::string here;
  int port = 0;
  std::atomic<int> stops{0}, held{0};
  std::promise<void> let_go;
  std::shared_future<void> all_go = let_go.get_future().share();
  std::thread serving;
};

TEST(Encrypted, AnswersOneRequestAfterTheOther) {
  const Encrypted console;
  const auto browser = console.browser();
  browser->set_keep_alive(true);
  for (int i = 0; i < 5; ++i) {
    const auto answer = browser->Get("/long");
    ASSERT_TRUE(answer) << httplib::to_string(answer.error());
    EXPECT_EQ(answer->status, 200);
    EXPECT_EQ(answer->body, console.answer);
    const std::string body(50'000, static_cast<char>('a' + i));
    const auto said = browser->Post("/said", console.ofAPage("https://"), body, "application/json");
    ASSERT_TRUE(said) << httplib::to_string(said.error());
    EXPECT_EQ(said->body, body);
  }
}

TEST(Encrypted, APageOfThePlainAddressIsAnothersAndCookiesAreKept) {
  const Encrypted console;
  const auto browser = console.browser();
  const auto foreign = browser->Post("/said", console.ofAPage("http://"), "{}", "application/json");
  ASSERT_TRUE(foreign);
  EXPECT_EQ(foreign->status, 403);
  const auto entered = browser->Get("/enter");
  ASSERT_TRUE(entered);
  EXPECT_NE(entered->get_header_value("Set-Cookie").find("; Secure"), std::string::npos);
}

/// Although all that its own address may ask at once is being answered, for as long as the test
/// likes.
TEST(Encrypted, TheEmergencyStopHasItsOwnWayHereToo) {
  Encrypted console;
  std::vector<std::thread> asking;
  for (std::size_t i = 0; i < RequestThreads::kMostOfOne; ++i)
    asking.emplace_back([&] { console.browser()->Get("/held"); });
  while (console.held < static_cast<int>(RequestThreads::kMostOfOne)) runtime::rest(5ms);
  const auto turned_away = console.browser()->Get("/long");
  EXPECT_TRUE(!turned_away || turned_away->status == 503);
  const auto stopped = console.browser()->Post("/api/sessions/a1/stop", console.ofAPage("https://"),
                                               "{}", "application/json");
  EXPECT_TRUE(stopped && stopped->status == 202);
  EXPECT_EQ(console.stops, 1);
  console.let_go.set_value();
  for (std::thread& one : asking) one.join();
}

TEST(Encrypted, WhoBelievesAnotherAuthorityAsksNothing) {
  const Encrypted console;
  const os::KeptIdentity other = os::keptIdentity(
      console.folder / "other", {.name = "Palpa console", .reached_by = {"127.0.0.1"}},
      utcSecondsOf(runtime::utcNow()));
  EXPECT_FALSE(console.browser(other.authority)->Get("/long"));
}

TEST(Encrypted, WhoSpeaksPlainHttpIsToldSo) {
  const Encrypted console;
  httplib::Client plain("127.0.0.1", console.port);
  const auto answer = plain.Get("/long");
  ASSERT_TRUE(answer);
  EXPECT_EQ(answer->status, 400);
  EXPECT_EQ(answer->body, "This address is encrypted: begin it with https://\n");
}

/// As many as there are places, of other addresses; half of them greet by halves.
TEST(Encrypted, SilentCallersTakeNobodysPlace) {
  const Encrypted console;
  std::vector<std::unique_ptr<Visitor>> silent;
  for (const char* from : {"127.0.0.2", "127.0.0.3", "127.0.0.4", "127.0.0.5"})
    for (std::size_t i = 0; i < Lobby::kMostOfOne; ++i) {
      silent.push_back(std::make_unique<Visitor>(console.port, from));
      if (i % 2 == 0) silent.back()->say("\x16\x03\x01\x02");
    }
  const auto answer = console.browser()->Get("/long");
  ASSERT_TRUE(answer) << httplib::to_string(answer.error());
  EXPECT_EQ(answer->status, 200);
}

}  // namespace
}  // namespace palpa::console

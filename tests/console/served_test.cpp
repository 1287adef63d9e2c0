#include "served.h"

namespace palpa::console {
namespace {

TEST(Served, ASessionIsBegunLookedAtSteeredAndOver) {
  Desk desk("served");
  Served& console = *desk.console;
  const std::string id = desk.begin();
  EXPECT_EQ(console.post("/api/sessions", {{"task", "paracentesis"}, {"operator", "expert"}}), 409);
  const auto first = console.events(id, "", 30);
  ASSERT_GE(first.size(), 30u);
  for (std::size_t i = 0; i < first.size(); ++i) EXPECT_EQ(first[i].first, i + 1);
  EXPECT_EQ(first[0].second["kind"], "hello");
  EXPECT_EQ(console.post("/api/sessions/" + id + "/command", {{"command", "pause"}}), 202);
  EXPECT_EQ(console.post("/api/sessions/" + id + "/command", {{"command", "<script>"}}), 422);
  EXPECT_EQ(console.post("/api/sessions/" + id + "/command", {{"command", "leave"}}), 202);
  const auto rest = console.events(id, std::to_string(first.back().first), 1'000'000);
  ASSERT_FALSE(rest.empty());
  EXPECT_EQ(rest.front().first, first.back().first + 1);
  EXPECT_EQ(rest.back().second["kind"], "end");
  EXPECT_EQ(rest.back().second["state"], "finished");
  EXPECT_EQ(console.post("/api/sessions/" + id + "/command", {{"command", "pause"}}), 409);
  EXPECT_EQ(console.get("/api/sessions")[0]["state"], "finished");
}

/// By its own path and as a command: before anything that waits, and confirmed by the session.
TEST(Served, TheEmergencyStopIsConfirmed) {
  Desk desk("stopped");
  Served& console = *desk.console;
  const std::string id = desk.begin(), path = "/api/sessions/" + id;
  ASSERT_TRUE(desk.isState(id, "running"));
  for (int i = 0; i < 80; ++i) console.post(path + "/command", {{"command", "pause"}});
  EXPECT_EQ(console.post(path + "/command", {{"command", "pause"}}), 429);
  json told;
  EXPECT_EQ(console.post(path + "/stop", json::object(), &told), 202) << told.dump();
  EXPECT_EQ(told.value("confirmed", false), true) << told.dump();
  const json heard{{"kind", "event"},
                   {"heard", static_cast<int>(trial::UserCommand::emergency_stop)}};
  std::string last;
  EXPECT_TRUE(inTime([&] {
    const auto some = console.events(id, last, 20);
    if (!some.empty()) last = std::to_string(some.back().first);
    return std::any_of(some.begin(), some.end(),
                       [&](const auto& entry) { return entry.second == heard; });
  }));
  EXPECT_EQ(console.post("/api/sessions/none/stop", json::object()), 409);
  ASSERT_TRUE(inTime([&] {
    return console.post(path + "/command", {{"command", "leave"}}) == 202;
  }));
  EXPECT_TRUE(desk.isState(id, "finished"));
  EXPECT_EQ(console.post(path + "/stop", json::object()), 409);
}

/// As on a full disk: what goes wrong once it serves is thrown to whoever can say it.
TEST(Served, AnErrorOnTheWayEndsItWithWords) {
  const test::ScratchFolder folder("full");
  const test::ShortFolder sockets;
  ConsoleSettings settings;
  settings.place.home = folder / "home";
  settings.place.records = (folder / "records.sqlite").string();
  settings.place.sockets = sockets.path();
  EXPECT_THROW(serveConsole(settings,
                            [](const OpenedConsole&) {
                              throw Error("has no room left", "the disk", "Make room");
                            }),
               Error);
  std::filesystem::create_directories(folder / "home" / "address");  // cannot be written
  EXPECT_THROW(serveConsole(settings, [](const OpenedConsole&) { ADD_FAILURE() << "it served"; }),
               Error);
}

/// A Falcon before a webcam.
std::filesystem::path realStation(const std::filesystem::path& folder) {
  json station = json::parse(
      std::ifstream(std::filesystem::path(PALPA_SOURCE_DIR) / "assets/stations/falcon.json"));
  station["camera"]["driver"] = "webcam";
  station["camera"]["device"] = "0";
  station["camera"]["exposure_ms"] = 10;
  std::ofstream(folder / "real.json") << station.dump();
  return folder / "real.json";
}

/// Who performs, or where: either makes it simulated, and it is called so.
TEST(Served, ItIsSimulatedByWhoPerformsAndByWhere) {
  const test::ScratchFolder folder("simulated");
  const test::ShortFolder sockets;
  ConsolePlace place;
  place.home = folder / "home";
  std::filesystem::create_directories(place.home);
  const auto simulated = [&](const std::filesystem::path& station, const std::string& performer) {
    chooseStation(place, station.string());
    Served console(place.home, sockets.path());
    json told;
    EXPECT_EQ(
        console.post("/api/sessions", {{"task", "paracentesis"}, {"operator", performer}}, &told),
        201)
        << told.dump();
    const std::string path = "/api/sessions/" + told.value("id", "");
    EXPECT_TRUE(inTime([&] { return console.get(path)["state"] == "running"; }));
    EXPECT_EQ(console.post(path + "/command", {{"command", "leave"}}), 202);
    EXPECT_TRUE(inTime([&] { return console.get(path)["state"] == "finished"; }));
    return console.get(path)["simulated"] == true;
  };
  const std::filesystem::path bench = std::filesystem::path(PALPA_SOURCE_DIR) /
                                      "assets/stations/virtual_bench.json",
                              real = realStation(folder.path());
  EXPECT_TRUE(simulated(bench, "person"));
  EXPECT_TRUE(simulated(bench, "expert"));
  EXPECT_TRUE(simulated(real, "expert"));
  EXPECT_FALSE(simulated(real, "person"));
}

/// The console ends and comes back: the session has gone on, and whoever was away reads on where he
/// was.
TEST(Served, ASessionOutlivesItsConsole) {
  Desk desk("outlives");
  const std::string id = desk.begin();
  const auto before = desk.console->events(id, "", 20);
  ASSERT_GE(before.size(), 20u);
  desk.restart();
  const auto after = desk.console->events(id, "20", before.size() + 30);
  ASSERT_GE(after.size(), 30u);
  EXPECT_EQ(after.front().first, 21u);
  for (std::size_t i = 20; i < before.size(); ++i) EXPECT_EQ(after[i - 20], before[i]);
  for (std::size_t i = 1; i < after.size(); ++i)
    EXPECT_EQ(after[i].second["number"], after[i - 1].second["number"].get<int>() + 1);
  const auto anew = desk.console->events(id, "999999", 5);
  ASSERT_FALSE(anew.empty());
  EXPECT_EQ(anew.front().first, 1u) << "a number beyond the log: told from its beginning";
  EXPECT_EQ(desk.console->post("/api/sessions/" + id + "/command", {{"command", "leave"}}), 202);
  EXPECT_TRUE(desk.isState(id, "finished"));
}

TEST(Served, AKilledSessionIsSaidInWords) {
  Desk desk("killed");
  const std::string id = desk.begin();
  ASSERT_GE(desk.console->events(id, "", 3).size(), 3u);
  const json facts =
      json::parse(std::ifstream(desk.folder / "home" / "sessions" / id / "console.json"));
  ::kill(facts["pid"].get<int>(), SIGKILL);
  const auto all = desk.console->events(id, "", 1'000'000);
  ASSERT_FALSE(all.empty());
  EXPECT_EQ(all.back().second["kind"], "end");
  EXPECT_NE(all.back().second["state"], "finished");
  EXPECT_NE(all.back().second["message"], "") << "nobody is told what happened";
  EXPECT_NE(desk.console->get("/api/sessions/" + id)["message"], "");
  const std::string next = desk.begin();  // the next can begin
  ASSERT_GE(desk.console->events(next, "", 3).size(), 3u);
  EXPECT_EQ(desk.console->post("/api/sessions/" + next + "/command", {{"command", "leave"}}), 202);
  EXPECT_TRUE(desk.isState(next, "finished"));
}

TEST(Served, AgreementToResearchIsGivenAndWithdrawnOnAPage) {
  Desk desk("research");
  ASSERT_EQ(desk.console->post("/api/trainees", {{"id", "T5"}, {"consent", true}}), 201);
  const auto agreed = [&] { return desk.console->get("/api/trainees")[0]["research_utc"] != ""; };
  EXPECT_FALSE(agreed());
  const std::string path = "/api/trainees/T5/research";
  EXPECT_EQ(desk.console->post(path, {{"agrees", true}}), 200);
  EXPECT_TRUE(agreed());
  EXPECT_EQ(desk.console->post(path, {{"agrees", "yes"}}), 422);
  EXPECT_TRUE(agreed()) << "as it was";
  EXPECT_EQ(desk.console->post(path, {{"agrees", false}}), 200);
  EXPECT_FALSE(agreed());
  EXPECT_EQ(desk.console->post("/api/trainees/T6/research", {{"agrees", true}}), 404);
}

TEST(Served, TwoConsolesAtOnePlaceAreOneTooMany) {
  Desk desk("two");
  Served second(desk.folder / "home", desk.sockets.path());
  EXPECT_NE(second.url().find("runs already"), std::string::npos) << second.url();
  EXPECT_NE(second.url().find(desk.console->url()), std::string::npos);
  EXPECT_TRUE(desk.console->get("/api/me").contains("version"));
}

/// A console that was killed holds its lock and its port until the system has taken it apart.
TEST(Served, AConsoleWaitsForAKilledOneToLetGo) {
  const test::ScratchFolder folder("killed_console");
  const test::ShortFolder sockets;
  std::filesystem::create_directories(folder / "home");
  const std::filesystem::path lock = folder / "home" / "lock";
  auto killed = os::FileLock::exclusive(lock, os::FileLock::Missing::is_made);
  ASSERT_TRUE(killed);
  std::thread taken_apart([&] {
    runtime::rest(500ms);
    killed.reset();
  });
  Served next(folder / "home", sockets.path());
  taken_apart.join();
  EXPECT_EQ(next.url().rfind("http", 0), 0u) << next.url();
}

TEST(Served, ManyAskForEverythingAtOnce) {
  Desk desk("many");
  const std::string id = desk.begin();
  ASSERT_TRUE(desk.isState(id, "running"));
  desk.console->post("/api/trainees", {{"id", "T1"}});
  std::atomic<int> unanswered{0};
  std::vector<std::thread> threads;
  const std::string paths[] = {"/",
                               "/api/me",
                               "/api/health",
                               "/api/tasks",
                               "/api/trainees",
                               "/api/sessions",
                               "/api/sessions/" + id,
                               "/api/sessions/" + id + "/picture",
                               "/api/calibration",
                               "/api/studies",
                               "/api/trainees/T1/report",
                               "/api/cohort"};
  for (int t = 0; t < 8; ++t)
    threads.emplace_back([&, t] {
      for (std::size_t i = 0; i < std::size(paths); ++i)
        unanswered += !desk.console->client().Get(
            paths[(i + static_cast<std::size_t>(t)) % std::size(paths)]);
      unanswered += desk.console->events(id, "", 50).size() < 50;
    });
  threads.emplace_back([&] {
    for (int i = 0; i < 10; ++i)
      desk.console->post("/api/sessions/" + id + "/command", {{"command", "pause"}});
    desk.console->post("/api/health", json::object());
  });
  for (std::thread& thread : threads) thread.join();
  EXPECT_EQ(unanswered, 0);
  EXPECT_EQ(desk.console->post("/api/sessions/" + id + "/command", {{"command", "leave"}}), 202);
  EXPECT_TRUE(desk.isState(id, "finished"));
}

TEST(Served, OpenToOthersOnlyWithAToken) {
  for (const std::string address :
       {"0.0.0.0", "::", "192.168.1.20", "", "127.evil.example", "127.0.0.1.evil.example",
        "127.0.0", "localhost.evil.example", "0"}) {
    ConsoleSettings settings;
    settings.address = address;
    EXPECT_FALSE(isLoopback(address)) << address;
    EXPECT_THROW(serveConsole(settings, [](const OpenedConsole&) { ADD_FAILURE() << "it served"; }),
                 UsageError)
        << address;
  }
  for (const char* address : {"127.0.0.1", "127.1.2.3", "localhost", "::1"})
    EXPECT_TRUE(isLoopback(address)) << address;
}

TEST(ConsolePort, IsSharedWithNobody) {
  const test::ScratchFolder here("port");
  Guard guard("");
  Refusals refusals(here.path() / "refused.log");
  WebServer first(guard, refusals), second(guard, refusals);
  const int port = first.bind_to_any_port("127.0.0.1");
  ASSERT_GT(port, 0);
  EXPECT_FALSE(second.bind_to_port("127.0.0.1", port));  // else two consoles would answer in turn
}

}  // namespace
}  // namespace palpa::console

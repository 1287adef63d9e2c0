// The same simulated session with and without an attack: the same forces.
#include <gtest/gtest.h>
#include <sys/wait.h>

#include <atomic>
#include <cstring>
#include <fstream>
#include <sstream>
#include <thread>

#include "apps/record/session_file.h"
#include "bench.h"
#include "tests/support/counts.h"

namespace palpa::console_attack {
namespace {

using namespace std::chrono_literals;
constexpr char kId[] = "20260301-123000-1a2b3c4d";

/// Virtual time: every tick follows from the seed alone, however the computer is loaded.
std::vector<std::string> sessionIn(const fs::path& out, const std::string& live) {
  std::vector<std::string> all{
      "subclavian", "--operator", "expert", "--fast",   "--no-views",
      "--quiet",    "--seed",     "7",      "--trials", std::to_string(test::counted(1, 10)),
      "--out",      out.string()};
  if (!live.empty()) all.insert(all.end(), {"--live", live});
  return all;
}

/// Ticks since boot, as the kernel has them: a console finds its session again by it.
std::string beganOf(pid_t pid) {
  const std::string text = contentOf("/proc/" + std::to_string(pid) + "/stat");
  std::istringstream fields(text.substr(text.rfind(')') + 1));
  std::string word;
  for (int field = 3; field <= 22; ++field) fields >> word;
  return word;
}

std::vector<haptics::FlightRecord> ticksOf(const fs::path& folder) {
  std::vector<haptics::FlightRecord> all;
  record::SessionReader(folder / "session.palpa").ticks([&](const haptics::FlightRecord& record) {
    all.push_back(record);
  });
  return all;
}

TEST(Forces, AreTheSameTickByTickUnderAttack) {
  const ShortFolder folder;
  const fs::path calm = folder / "calm", home = folder / "home", attacked = home / "sessions" / kId;
  fs::create_directories(attacked);
  fs::create_directories(folder / "run" / "palpa");
  fs::permissions(folder / "run" / "palpa", fs::perms::owner_all);
  ASSERT_EQ(waitFor(startProgram(sessionIn(calm, ""), folder.path(), folder / "calm.out")), 0)
      << contentOf(folder / "calm.out");

  const pid_t pid = startProgram(
      sessionIn(attacked, (folder / "run" / "palpa" / (std::string(kId) + ".sock")).string()),
      folder.path(), folder / "attacked.out");
  std::ofstream(attacked / "console.json")
      << "{\"task\":\"paracentesis\",\"trainee\":\"\",\"pid\":" << pid
      << ",\"began\":" << beganOf(pid) << "}\n";
  Console console(folder.path());
  ASSERT_EQ(console.get("/api/sessions").json()[0]["id"], kId);
  std::atomic<bool> over{false};
  std::atomic<int> events{0}, asked{0}, refused{0};
  std::vector<std::thread> attackers;
  const std::string path = std::string("/api/sessions/") + kId;
  for (int i = 0; i < 3; ++i)
    attackers.emplace_back([&] {  // looks on, comes back
      while (!over)
        events += static_cast<int>(
            console.events(kId, "", [&](const auto& all) { return over || all.size() > 50; })
                .size());
    });
  const std::string key = console.pageKey();
  attackers.emplace_back([&] {  // steers with nonsense, floods with what is refused
    while (!over) {
      for (const std::string body :
           {"{\"command\":\"grade\"}", "{\"command\":\"void\"}",
            "{\"command\":\"note\",\"reason\":\"\"}", "{", "{\"command\":\"stop\",\"reason\":5}"})
        refused +=
            console.raw(requestOf("POST", path + "/command", console.writeHeaders(body), body))
                    .status /
                100 ==
            4;
      Headers foreign = console.writeHeaders("{\"command\":\"stop\"}");
      foreign[0].second = "evil.example";
      refused +=
          console.raw(requestOf("POST", path + "/command", foreign, "{\"command\":\"stop\"}"))
              .status == 421;
    }
  });
  attackers.emplace_back([&] {  // a crowd that opens and drops
    while (!over) {
      std::vector<Wire> crowd;
      for (int i = 0; i < 40; ++i) {
        crowd.emplace_back(console.port());
        crowd.back().send(
            requestOf("GET", i % 2 ? path + "/live" : path + "/view", console.readHeaders()));
      }
      asked += 40;
    }
  });
  const int code = waitFor(pid);
  over = true;
  for (std::thread& attacker : attackers) attacker.join();
  EXPECT_EQ(code, 0) << contentOf(folder / "attacked.out");
  EXPECT_GT(events, 0);
  EXPECT_GT(refused, 0);
  RecordProperty("entries told", events);
  RecordProperty("requests refused", refused);
  RecordProperty("streams dropped", asked);

  const auto before = ticksOf(calm), under = ticksOf(attacked);
  ASSERT_GT(before.size(), 5'000u);
  ASSERT_EQ(before.size(), under.size());
  std::size_t differ = 0;
  for (std::size_t i = 0; i < before.size(); ++i) {
    const auto &a = before[i], &b = under[i];
    differ += a.t_ns != b.t_ns ||
              std::memcmp(&a.f_command_D, &b.f_command_D, sizeof a.f_command_D) != 0 ||
              std::memcmp(&a.f_contact_D, &b.f_contact_D, sizeof a.f_contact_D) != 0 ||
              a.depth != b.depth || a.safety != b.safety || a.events != b.events ||
              a.snapshot != b.snapshot;
  }
  EXPECT_EQ(differ, 0u) << "of " << before.size() << " ticks";
  const auto told = record::SessionReader(calm / "session.palpa").events(),
             told_under = record::SessionReader(attacked / "session.palpa").events();
  ASSERT_EQ(told.size(), told_under.size());
  for (std::size_t i = 0; i < told.size(); ++i)
    EXPECT_TRUE(told[i].kind == told_under[i].kind && told[i].t_ns == told_under[i].t_ns &&
                told[i].text == told_under[i].text)
        << told_under[i].text;
}

}  // namespace
}  // namespace palpa::console_attack

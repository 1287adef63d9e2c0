#include <array>

#include "anatomy/base/random.h"
#include "apps/record/session_file.h"
#include "served.h"

/// Recorded sessions of a blind study, kept twice: once under each condition's label. Whoever leads
/// the study gets the same bytes.
namespace palpa::console {
namespace {

namespace fs = std::filesystem;

constexpr int kSessions = 20;

std::string idOf(int session) {
  return "20261201-1000" + std::to_string(10 + session) + "-00000000";
}

/// What tells the condition, in whatever a session leaves.
std::string labelOf(int session, bool swapped) {
  return (session % 2 == 0) != swapped ? "augmented" : "degraded";
}

void leaveEvidence(const fs::path& file, int session, const std::string& label) {
  RandomStream random(static_cast<std::uint64_t>(session), "blind");
  record::SessionInfo info;
  info.uuid = "u" + std::to_string(session);
  info.started_utc = "2026-12-01T10:00:00Z";
  info.command = "search";
  info.session_json = R"({"mode":")" + label + R"(","operator":"person"})";
  info.task_json = R"({"id":"search","engine":"search","mode":")" + label + "\"}";
  info.station_json = "{}";
  record::SessionWriter writer(file, info);
  std::int64_t t_ns = 1'000'000'000;
  const double strength = label == "augmented" ? 2 : 1;
  for (int trial = 1; trial <= 3; ++trial) {
    writer.beginTrial({trial, t_ns, 7, "scored", true, 0});
    for (const char* kind : {"case", "phase", "touched", "answer", "note", "safety"})
      writer.event(
          {t_ns + 1'000'000, trial, kind,
           std::string(kind) == "note" ? "the chair was moved" : "{\"mode\":\"" + label + "\"}",
           strength});
    for (int i = 0; i < 300; ++i, t_ns += 1'000'000) {
      haptics::FlightRecord tick{};
      tick.tick = t_ns / 1'000'000;
      tick.t_ns = t_ns;
      tick.commands.trial = static_cast<std::uint32_t>(trial);
      tick.f_command_D = {strength * random.uniform(), 0, 0};
      writer.tick(tick);
    }
    writer.endTrial({trial, t_ns, label == "augmented" ? "done" : "time", "",
                     R"({"FOUND":)" + std::to_string(label == "augmented") + R"(,"TOTAL":)" +
                         std::to_string(strength) + "}"});
    t_ns += 3'000'000'000;
  }
  writer.close();
}

void leaveSession(const fs::path& home, int session, bool swapped, bool blind) {
  const std::string label = labelOf(session, swapped);
  const fs::path folder = home / "sessions" / idOf(session);
  fs::create_directories(folder);
  std::ofstream(folder / "console.json")
      << json{{"task", "search"},  {"trainee", "T017"},  {"started_utc", "2026-12-01T10:00:00Z"},
              {"assessed", false}, {"simulated", false}, {"study", true},
              {"blind", blind},    {"trials", 3},        {"pid", 0}};
  leaveEvidence(folder / "session.palpa", session, label);
  for (const char* name : {"report.html", "trials.csv", "view-01-01-start.png", "exam-1-R1.html",
                           "certificate-1-R1.pdf", "log.txt"})
    std::ofstream(folder / name) << "it was " << label;
}

/// Whatever there is to ask of these sessions, and what is answered: status and bytes.
std::map<std::string, std::string> askedOf(Served& console) {
  std::vector<std::string> paths{"/api/sessions", "/api/trainees"};
  for (int session = 0; session < kSessions; ++session) {
    const std::string one = "/api/sessions/" + idOf(session);
    for (const char* what :
         {"", "/file/report.html", "/file/trials.csv", "/file/view-01-01-start.png",
          "/file/exam-1-R1.html", "/file/certificate-1-R1.pdf", "/file/log.txt", "/live", "/view",
          "/ratings/1/R1", "/ratings/1/R1/trial", "/ratings/1/R1/certificate", "/picture",
          "/trials/1/replay", "/trials/1/frame/0", "/trials/1/track", "/trials/1/room",
          "/room/0/2"})
      paths.push_back(one + what);
  }
  std::map<std::string, std::string> answers;
  for (const std::string& path : paths) {
    const auto answer = console.client().Get(path);
    answers[path] = answer ? std::to_string(answer->status) + ' ' + answer->body : "none";
  }
  return answers;
}

/// What is answered under one label and under the other.
std::array<std::map<std::string, std::string>, 2> servedTwice(bool blind) {
  std::array<std::map<std::string, std::string>, 2> answers;
  const test::ScratchFolder place("blind");
  const test::ShortFolder sockets;
  for (const bool swapped : {false, true}) {
    const fs::path home = place / "home";
    fs::remove_all(home);
    for (int session = 0; session < kSessions; ++session)
      leaveSession(home, session, swapped, blind);
    Served console(home, sockets.path());
    answers[swapped] = askedOf(console);
  }
  return answers;
}

TEST(BlindSessions, AreTheSameBytesUnderEitherLabel) {
  auto answers = servedTwice(true);
  ASSERT_EQ(answers[0].size(), answers[1].size());
  int told = 0;
  for (const auto& [path, answer] : answers[0]) {
    EXPECT_EQ(answer, answers[1][path]) << path;
    for (const char* label : {"augmented", "degraded"})
      EXPECT_EQ(answer.find(label), std::string::npos) << path << ": " << answer;
    told += answer.starts_with("200");
  }
  EXPECT_GT(told, 2 * kSessions) << "lists, sessions and marks are answered";
  EXPECT_NE(answers[0].at("/api/sessions/" + idOf(3)).find("recorded"), std::string::npos);
}

/// The same sessions of a study that is not blind: the test can tell them apart.
TEST(BlindSessions, OthersDifferByTheirLabel) {
  auto answers = servedTwice(false);
  const std::string one = "/api/sessions/" + idOf(3);
  for (const char* what : {"", "/file/report.html", "/file/trials.csv"})
    EXPECT_NE(answers[0].at(one + what), answers[1].at(one + what)) << what;
}

}  // namespace
}  // namespace palpa::console

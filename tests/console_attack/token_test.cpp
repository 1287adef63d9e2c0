// A console that others may reach asks for a token.
#include <gtest/gtest.h>
#include <sys/stat.h>

#include <fstream>

#include "bench.h"

namespace palpa::console_attack {
namespace {

constexpr char kToken[] = "correct-horse-battery-staple-42";

std::string tokenFile(const fs::path& folder, const std::string& content, mode_t mode) {
  const fs::path file = folder / "token";
  fs::remove(file);
  std::ofstream(file) << content;
  ::chmod(file.c_str(), mode);
  return file.string();
}

int exitCodeOf(const fs::path& folder, std::vector<std::string> more, std::string* words) {
  more.insert(more.begin(), {"console", "--no-open", "--home", (folder / "home").string(),
                             "--records", (folder / "records.sqlite").string()});
  fs::remove(folder / "words");
  const int code = waitFor(startProgram(more, folder, folder / "words"));
  *words = contentOf(folder / "words");
  return code;
}

TEST(Token, WithoutOneItServesThisComputerAlone) {
  const ShortFolder folder;
  std::string words;
  for (const char* address : {"0.0.0.0", "::", "192.0.2.1", "127.evil.example"}) {
    EXPECT_EQ(exitCodeOf(folder.path(), {"--listen", address}, &words), 2) << address;
    EXPECT_NE(words.find("needs a token"), std::string::npos) << words;
    EXPECT_NE(words.find("--token-file"), std::string::npos) << words;
  }
}

TEST(Token, AFileThatGivesItAwayIsRefused) {
  const ShortFolder folder;
  std::string words;
  EXPECT_EQ(
      exitCodeOf(folder.path(),
                 {"--listen", "0.0.0.0", "--token-file", tokenFile(folder.path(), kToken, 0644)},
                 &words),
      2);
  EXPECT_NE(words.find("may be read by others"), std::string::npos) << words;
  EXPECT_EQ(words.find(kToken), std::string::npos);
  EXPECT_EQ(
      exitCodeOf(folder.path(),
                 {"--listen", "0.0.0.0", "--token-file", tokenFile(folder.path(), "short", 0600)},
                 &words),
      2);
  EXPECT_EQ(exitCodeOf(folder.path(),
                       {"--listen", "0.0.0.0", "--token-file", tokenFile(folder.path(), "", 0600)},
                       &words),
            2);
  EXPECT_EQ(exitCodeOf(folder.path(),
                       {"--listen", "0.0.0.0", "--token-file", (folder / "none").string()}, &words),
            2);
}

struct Guarded {
  Guarded()
      : console(folder.path(),
                {"--token-file", tokenFile(folder.path(), std::string(kToken) + "\n", 0600)}) {}
  Answer enter(const std::string& token, const std::string& from) {
    const std::string body = nlohmann::json{{"token", token}}.dump();
    return console.raw(requestOf("POST", "/api/enter", console.writeHeaders(body), body), from);
  }
  const ShortFolder folder;
  Console console;
};

TEST(Token, WhoHasItComesInAndNobodyElse) {
  Guarded guarded;
  Console& console = guarded.console;
  EXPECT_EQ(console.get("/").status, 200);
  EXPECT_FALSE(console.get("/api/me").json()["entered"].get<bool>());
  EXPECT_FALSE(console.get("/api/me").json().contains("stations"))
      << "a stranger is told where things are";
  const std::string paths[] = {"/api/health",   "/api/tasks",           "/api/trainees",
                               "/api/sessions", "/api/sessions/x/live", "/api/sessions/x/view",
                               "/api/cohort",   "/api/calibration",     "/api/studies",
                               "/api/jobs/x",   "/api/pages/x",         "/none"};
  for (const std::string& path : paths) EXPECT_EQ(console.get(path).status, 401) << path;
  EXPECT_EQ(console.post("/api/trainees", {{"id", "T1"}}).status, 401);
  for (const char* cookie : {"palpa=", "palpa=correct-horse-battery-staple-42",
                             "palpa=00000000000000000000000000000000"}) {
    console.cookie = cookie;
    EXPECT_EQ(console.get("/api/trainees").status, 401) << cookie;
  }
  console.cookie.clear();
  const Answer right = guarded.enter(kToken, "");
  EXPECT_EQ(right.status / 100, 2) << right.body;
  const std::string set = right.header("Set-Cookie");
  EXPECT_NE(set.find("HttpOnly"), std::string::npos) << set;
  EXPECT_NE(set.find("SameSite=Strict"), std::string::npos);
  EXPECT_EQ(set.find(kToken), std::string::npos);
  console.cookie = set.substr(0, set.find(';'));
  for (const char* path :
       {"/api/health", "/api/tasks", "/api/trainees", "/api/sessions", "/api/calibration"})
    EXPECT_EQ(console.get(path).status, 200) << path;
  EXPECT_EQ(console.post("/api/trainees", {{"id", "T1"}}).status, 201);
  const Answer again = console.get("/api/me");
  EXPECT_EQ(again.body.find(console.cookie.substr(6)), std::string::npos)
      << "a page's script could read it";
}

TEST(Token, GuessesAreCountedWhereTheyComeFromAndItIsWrittenNowhere) {
  Guarded guarded;
  for (const char* wrong : {"", "guess-number-one-of-five", "guess-number-two-of-five",
                            "correct-horse-battery-staple-4", "correct-horse-battery-staple-422"})
    EXPECT_EQ(guarded.enter(wrong, "127.0.0.1").status, 403) << wrong;
  const Answer throttled = guarded.enter(kToken, "127.0.0.1");
  EXPECT_EQ(throttled.status, 403);
  EXPECT_EQ(throttled.header("Set-Cookie"), "");
  const Answer elsewhere = guarded.enter(kToken, "127.0.0.2");
  EXPECT_EQ(elsewhere.status / 100, 2) << elsewhere.body;
  EXPECT_NE(elsewhere.header("Set-Cookie"), "");
  guarded.console.get(std::string("/api/trainees?token=") + kToken);
  EXPECT_NE(guarded.console.refused().find("127.0.0.1 POST /api/enter 403 a wrong token"),
            std::string::npos)
      << guarded.console.refused();
  EXPECT_NE(guarded.console.refused().find("401 give the console's token first"),
            std::string::npos);
  const std::string cookie = elsewhere.header("Set-Cookie").substr(6, 32);
  for (const char* path : {"/", "/api/me", "/api/trainees"})
    EXPECT_EQ(guarded.console.get(path).body.find(kToken), std::string::npos) << path;
  EXPECT_EQ(guarded.console.interrupt(), 0);
  int files = 0;
  for (const auto& entry : fs::recursive_directory_iterator(guarded.folder.path())) {
    if (!entry.is_regular_file() || entry.path().filename() == "token") continue;
    const std::string content = contentOf(entry.path());
    EXPECT_EQ(content.find(kToken), std::string::npos) << entry.path();
    EXPECT_EQ(content.find("guess-number"), std::string::npos) << entry.path();
    EXPECT_EQ(content.find(cookie), std::string::npos) << entry.path();
    ++files;
  }
  EXPECT_GE(files, 3);
}

}  // namespace
}  // namespace palpa::console_attack

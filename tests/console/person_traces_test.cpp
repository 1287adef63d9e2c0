#include "apps/console/person_traces.h"

#include <gtest/gtest.h>

#include <fstream>

#include "tests/support/files.h"
#include "tests/support/scratch_folder.h"

namespace palpa::console {
namespace {

namespace fs = std::filesystem;

void put(const fs::path& file, const std::string& text) {
  fs::create_directories(file.parent_path());
  std::ofstream(file) << text;
}

TEST(PersonTraces, SessionsAreToldApartByTheirRequest) {
  const test::ScratchFolder home("traces-sessions");
  put(home / "sessions/a/console.json", R"({"trainee": "T1"})");
  put(home / "sessions/b/console.json", R"({"trainee": "T10"})");
  put(home / "sessions/c/console.json", "{damaged T1");
  put(home / "sessions/d/log.txt", "T1");
  ASSERT_EQ(sessionsOf(home.path(), "T1"), std::vector<fs::path>{home / "sessions/a"});
  EXPECT_TRUE(sessionsOf(home / "nowhere", "T1").empty());

  put(home / "sessions/a/log.txt", "In the records of T1");
  put(home / "sessions/a/replay-1/pictures.json", "{}");
  put(home / "sessions/a/room.mjpeg", "a face");
  put(home / "sessions/a/room.mjpeg.csv", "when");
  PersonTraces traces;
  removeSessionTraces(home / "sessions/a", &traces);
  EXPECT_FALSE(fs::exists(home / "sessions/a"));
  EXPECT_TRUE(traces.troubles.empty());

  put(home / "sessions/a/console.json", R"({"trainee": "T1"})");
  put(home / "sessions/a/somebodys.txt", "mine");
  removeSessionTraces(home / "sessions/a", &traces);
  EXPECT_EQ(test::slurp(home / "sessions/a/somebodys.txt"), "mine");
  EXPECT_FALSE(fs::exists(home / "sessions/a/console.json"));
}

TEST(PersonTraces, JobsAndLinesWithTheNameGo) {
  const test::ScratchFolder home("traces-home");
  put(home / "jobs/one/report/trainee.html", "<h1>T1</h1>");
  put(home / "jobs/two/log.txt", "T10, T2");
  put(home / "refused.log", "GET /api/trainees/T1/report\nGET /api/trainees/T10/report\n");
  put(home / "refused.log.1", "GET /api/trainees/T1/report\n");
  put(home / "settings.json", R"({"station": "/T1.json"})");
  PersonTraces traces;
  removeHomeTraces(home.path(), "T1", &traces);
  EXPECT_EQ(traces.jobs, 1u);
  EXPECT_EQ(traces.lines, 2u);
  EXPECT_FALSE(fs::exists(home / "jobs/one"));
  EXPECT_TRUE(fs::exists(home / "jobs/two/log.txt"));
  EXPECT_EQ(test::slurp(home / "refused.log"), "GET /api/trainees/T10/report\n");
  EXPECT_EQ(test::slurp(home / "refused.log.1"), "");
  EXPECT_TRUE(fs::exists(home / "settings.json"));
}

}  // namespace
}  // namespace palpa::console

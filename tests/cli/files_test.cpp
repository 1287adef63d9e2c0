#include <gtest/gtest.h>
#include <sys/stat.h>

#include <fstream>

#include "program.h"
#include "tests/support/setting.h"

/// What the program leaves on the disk, and who may read it.
namespace palpa::cli_test {
namespace {

namespace fs = std::filesystem;

constexpr fs::perms kOwnersFile = fs::perms::owner_read | fs::perms::owner_write;

TEST(Files, EvidenceAndItsFolderAreTheUsersAlone_AGivenFolderStays) {
  const Folder here;
  const mode_t mask = ::umask(022);
  fs::create_directory(here / "given");
  const fs::perms before = fs::status(here / "given").permissions();
  const Outcome made = palpa(session({"--seed", kShortTrial, "--out", "A"}), here.path());
  const Outcome given =
      palpa(session({"--seed", kShortTrial, "--out", "given", "--record-video"}), here.path());
  ::umask(mask);
  ASSERT_EQ(made.exit_code, 0) << made.err;
  ASSERT_EQ(given.exit_code, 0) << given.err;
  EXPECT_EQ(fs::status(here / "A").permissions(), fs::perms::owner_all);
  EXPECT_EQ(fs::status(here / "given").permissions(), before);
  for (const char* file :
       {"A/session.palpa", "given/session.palpa", "given/camera.mjpeg", "given/camera.mjpeg.csv"})
    EXPECT_EQ(fs::status(here / file).permissions(), kOwnersFile) << file;
}

TEST(Files, WithoutAHomeItIsSaidAndNothingIsWritten) {
  const Folder here;
  const test::Setting home("HOME", nullptr), data("XDG_DATA_HOME", nullptr);
  for (const std::vector<std::string>& words :
       {std::vector<std::string>{"records", "trainee", "list"}, {"console", "--no-open"}}) {
    const Outcome answer = palpa(words, here.path());
    EXPECT_EQ(answer.exit_code, 2) << words.front();
    EXPECT_TRUE(says(answer.err, "neither HOME nor XDG_DATA_HOME")) << answer.err;
    EXPECT_EQ(answer.errLines(), 1) << answer.err;
  }
  EXPECT_TRUE(here.files().empty());
}

TEST(Files, RecordsBySettingsAsWordsAreRefusedAndNoFileOfThatNameIsMade) {
  const Folder here;
  const std::string address = "host=server user=me password=geheim";
  for (std::vector<std::string> words :
       {std::vector<std::string>{"records", "trainee", "list"},
        {"records", "trainee", "add", "--id", "A"},
        session({"--trainee", "A", "--out", "A"}),
        {"study", "run", "--protocol",
         (fs::path(PALPA_SOURCE_DIR) / "assets/protocols/paracentesis_pilot.json").string(),
         "--trainee", "A"}}) {
    words.insert(words.end(), {"--records", address});
    const Outcome answer = palpa(words, here.path());
    EXPECT_EQ(answer.exit_code, 2) << words.front() << ": " << answer.err;
    EXPECT_FALSE(says(answer.out + answer.err, "geheim")) << answer.err;
  }
  EXPECT_TRUE(here.files().empty()) << here.files().front();
}

TEST(Files, LiveLeavesAFileAsItIs_AndTheSessionThatCannotStartLeavesNothing) {
  const Folder here;
  const std::string notes = here.file("notes.txt", "a year's work");
  const Outcome answer = palpa(session({"--live", "notes.txt", "--out", "A"}), here.path());
  EXPECT_EQ(answer.exit_code, 1);
  EXPECT_TRUE(says(answer.err, "no socket of yours")) << answer.err;
  EXPECT_EQ(contentOf(notes), "a year's work");
  EXPECT_EQ(here.files(), std::vector<std::string>{"notes.txt"});
  EXPECT_FALSE(fs::exists(here / "A"));
}

}  // namespace
}  // namespace palpa::cli_test

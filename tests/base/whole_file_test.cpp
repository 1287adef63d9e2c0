#include "anatomy/base/whole_file.h"

#include <fcntl.h>
#include <gtest/gtest.h>
#include <signal.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <chrono>
#include <cstring>
#include <set>

#include "anatomy/base/error.h"
#include "tests/support/files.h"

namespace palpa {
namespace {

namespace fs = std::filesystem;

std::set<std::string> namesIn(const fs::path& folder) {
  std::set<std::string> names;
  for (const auto& entry : fs::directory_iterator(folder))
    names.insert(entry.path().filename().string());
  return names;
}

TEST(WholeFile, IsThereWholeOrNotAtAll) {
  const auto folder = test::freshFolder("base", "whole");
  writeWhole(folder / "a.txt", "first");
  {
    WholeFile left(folder / "a.txt");
    left.write("second, but");
  }
  EXPECT_EQ(test::slurp(folder / "a.txt"), "first");
  writeWhole(folder / "a.txt", "second");
  EXPECT_EQ(test::slurp(folder / "a.txt"), "second");
  EXPECT_EQ(std::distance(std::filesystem::directory_iterator(folder), {}), 1) << "nothing beside";
  EXPECT_THROW(writeWhole(folder / "no/such/a.txt", ""), Error);
}

/// A page that is given the name of a session or of a centre's records.
TEST(WholeFile, NeverTakesThePlaceOfADatabase) {
  const auto folder = test::freshFolder("base", "database");
  std::string evidence("SQLite format 3\0", 16);
  evidence.append("and all that a trainee did");
  std::ofstream(folder / "session.palpa", std::ios::binary) << evidence;
  EXPECT_THROW(writeWhole(folder / "session.palpa", "<!doctype html>"), Error);
  EXPECT_EQ(test::slurp(folder / "session.palpa"), evidence);
  std::ofstream(folder / "short.txt") << "SQLite";
  EXPECT_NO_THROW(writeWhole(folder / "short.txt", "text"));
}

/// A process that is killed meanwhile leaves nothing.
TEST(WholeFile, HasNoNameBeforeItIsWhole) {
  const auto folder = test::freshFolder("base", "nameless");
  const int tried = ::open(folder.c_str(), O_TMPFILE | O_WRONLY | O_CLOEXEC, 0600);
  if (tried < 0) GTEST_SKIP() << "this drive has no files without a name";
  ::close(tried);
  WholeFile file(folder / "a.txt");
  file.write(std::string(1 << 20, 'a'));
  EXPECT_TRUE(fs::is_empty(folder));
  file.finish();
  EXPECT_EQ(fs::file_size(folder / "a.txt"), 1u << 20);
  EXPECT_EQ(std::distance(fs::directory_iterator(folder), {}), 1);
}

/// Whoever may write into the folder lays links where the next files will be written.
TEST(WholeFile, IsNeverWrittenThroughALink) {
  const auto folder = test::freshFolder("base", "links");
  std::ofstream(folder / "victim") << "not yours";
  fs::create_symlink("victim", folder / "a.txt");
  const std::string begins = ".a.txt.part-" + std::to_string(::getpid()) + "-";
  for (int i = 1; i <= 60; ++i) fs::create_symlink("victim", folder / (begins + std::to_string(i)));
  writeWhole(folder / "a.txt", "mine");
  EXPECT_EQ(test::slurp(folder / "victim"), "not yours");
  EXPECT_EQ(test::slurp(folder / "a.txt"), "mine");
  EXPECT_FALSE(fs::is_symlink(folder / "a.txt")) << "the link itself gives way";
}

TEST(WholeFile, TakesNoFoldersAndNoDevicesPlace) {
  const auto folder = test::freshFolder("base", "places");
  fs::create_directory(folder / "sub");
  fs::create_directory_symlink("sub", folder / "link");
  for (const fs::path& place : {folder / "sub", folder / "link", folder / "sub" / ""})
    EXPECT_THROW(writeWhole(place, "x"), Error) << place;
  EXPECT_THROW(writeWhole("/dev/full", "x"), Error);
  EXPECT_TRUE(fs::is_character_file("/dev/full"));
  EXPECT_TRUE(fs::is_symlink(folder / "link"));
  EXPECT_EQ(namesIn(folder), (std::set<std::string>{"link", "sub"}));
}

/// In a process of its own, whose files may not grow.
TEST(WholeFile, OneThatCannotBeWrittenToItsEndLeavesTheOldOne) {
  const auto folder = test::freshFolder("base", "limit");
  writeWhole(folder / "a.txt", "old");
  const auto writeMore = [&] {
    ::signal(SIGXFSZ, SIG_IGN);
    const rlimit limit{4096, 4096};
    ::setrlimit(RLIMIT_FSIZE, &limit);
    try {
      writeWhole(folder / "a.txt", std::string(200'000, 'x'));
    } catch (const Error& e) {
      std::fprintf(stderr, "%s", e.what());
      ::_exit(3);
    }
    ::_exit(0);
  };
  EXPECT_EXIT(writeMore(), ::testing::ExitedWithCode(3), "larger than a file may be here");
  EXPECT_EQ(test::slurp(folder / "a.txt"), "old");
  EXPECT_EQ(namesIn(folder), std::set<std::string>{"a.txt"});
}

TEST(WholeFile, WhatKilledProcessesLeftLongAgoIsRemoved) {
  const auto folder = test::freshFolder("base", "forgotten");
  const pid_t gone = ::fork();
  if (gone == 0) ::_exit(0);
  ::waitpid(gone, nullptr, 0);
  const std::string begins = ".a.txt.part-";
  const std::string old = begins + std::to_string(gone) + "-1", young = old + "1",
                    living = begins + std::to_string(::getpid()) + "-999999";
  for (const std::string& name : {old, young, living}) std::ofstream(folder / name) << "half";
  const auto long_ago = fs::file_time_type::clock::now() - std::chrono::hours(48);
  for (const std::string& name : {old, living}) fs::last_write_time(folder / name, long_ago);
  writeWhole(folder / "a.txt", "whole");
  EXPECT_EQ(namesIn(folder), (std::set<std::string>{"a.txt", young, living}));
}

TEST(WholeFile, ALongNameIsWrittenAsWell) {
  const auto folder = test::freshFolder("base", "long");
  const std::string name(250, 'n');
  writeWhole(folder / name, "x", Lasts::no);
  EXPECT_EQ(namesIn(folder), std::set<std::string>{name});
  EXPECT_THROW(writeWhole(folder / std::string(300, 'n'), "x"), Error);
}

TEST(WrittenTogether, NewFilesOfACommandThatFailsAreGone) {
  const auto folder = test::freshFolder("base", "together");
  writeWhole(folder / "old", "1");
  {
    WrittenTogether written;
    fs::create_directory(folder / "made");
    WrittenTogether::note(folder / "made");
    writeWhole(folder / "made/new", "2");
    writeWhole(folder / "old", "2");
  }
  EXPECT_EQ(namesIn(folder), std::set<std::string>{"old"});
  {
    WrittenTogether written;
    writeWhole(folder / "new", "3");
    written.keep();
    writeWhole(folder / "later", "4");
  }
  EXPECT_EQ(namesIn(folder), (std::set<std::string>{"later", "new", "old"}));
}

TEST(FileTrouble, HasWordsOfOurOwnForEachReason) {
  std::set<std::string> words;
  for (const int error : {ENOSPC, EDQUOT, EFBIG, EIO, EACCES, EROFS, EMFILE, ENFILE, ENOMEM,
                          ENAMETOOLONG, ELOOP, ENOENT, ENOTDIR, EISDIR}) {
    const FileTrouble trouble = fileTrouble(error);
    EXPECT_NE(trouble.why, std::strerror(error));
    EXPECT_EQ(trouble.why.find("error"), std::string::npos) << trouble.why;
    EXPECT_FALSE(trouble.remedy.empty());
    EXPECT_TRUE(words.insert(trouble.why).second) << trouble.why;
  }
  EXPECT_NE(fileTrouble(EMLINK).why.find(std::to_string(EMLINK)), std::string::npos);
}

TEST(FileTrouble, ForReadingToo) {
  for (const std::errc error : {std::errc::no_such_file_or_directory, std::errc::permission_denied,
                                std::errc::is_a_directory, std::errc::io_error}) {
    const std::error_code code = std::make_error_code(error);
    EXPECT_NE(whyUnread(code), code.message());
    EXPECT_EQ(whyUnread(code).find("may not write"), std::string::npos) << whyUnread(code);
  }
  std::error_code missing;
  const auto none = fs::file_size(test::freshFolder("base", "unread") / "none", missing);
  EXPECT_EQ(none, static_cast<std::uintmax_t>(-1));
  EXPECT_EQ(whyUnread(missing), "there is no such file");
}

TEST(ReadWhole, GivesEveryByteAndNothingWhereThereIsNoFile) {
  const auto folder = test::freshFolder("base", "read");
  std::string bytes;
  for (int i = 0; i < 200'000; ++i) bytes += static_cast<char>(i % 251);
  writeWhole(folder / "a.bin", bytes);
  writeWhole(folder / "empty", "");
  EXPECT_EQ(readWhole(folder / "a.bin"), bytes);
  EXPECT_EQ(readWhole(folder / "empty"), "");
  EXPECT_EQ(readWhole(folder / "missing"), std::nullopt);
  EXPECT_EQ(readWhole(folder), std::nullopt);
}

TEST(EntriesOf, AFoldersEntriesInOrder_NothingBelowThem) {
  const fs::path folder = test::freshFolder("base", "entries");
  for (const char* name : {"b", "a", ".c"}) std::ofstream(folder / name) << name;
  fs::create_directories(folder / "d/e");
  EXPECT_EQ(entriesOf(folder),
            (std::vector<fs::path>{folder / ".c", folder / "a", folder / "b", folder / "d"}));
  EXPECT_TRUE(entriesOf(folder / "a").empty()) << "no folder";
  EXPECT_TRUE(entriesOf(folder / "none").empty());
}

TEST(WholeFile, ANewFileIsReadByNoMoreThanTheOldOne) {
  using std::filesystem::perms;
  const auto folder = test::freshFolder("base", "whole_file_readers");
  const auto readers = [&](const char* name) {
    return std::filesystem::status(folder / name).permissions() & perms::mask;
  };
  writeWhole(folder / "own", "x", Lasts::no, Readers::owner);
  EXPECT_EQ(readers("own"), perms::owner_read | perms::owner_write);
  writeWhole(folder / "own", "y", Lasts::no);
  EXPECT_EQ(readers("own"), perms::owner_read | perms::owner_write) << "as it was";
}

}  // namespace
}  // namespace palpa

#include <gtest/gtest.h>
#include <sys/stat.h>

#include <cstdlib>
#include <fstream>

#include "anatomy/base/error.h"
#include "apps/os/file_access.h"
#include "apps/os/worker_processes.h"
#include "tests/support/scratch_folder.h"
#include "tests/support/setting.h"

namespace palpa::os {
namespace {

namespace fs = std::filesystem;

void write(const fs::path& file, const std::string& text) { std::ofstream(file) << text; }

std::string textOf(const fs::path& file) {
  std::string text;
  std::getline(std::ifstream(file), text);
  return text;
}

using test::Setting;

TEST(Files, ANewOneNeverTakesAnothersPlace) {
  const test::ScratchFolder folder("os-new");
  EXPECT_FALSE(createNew(folder / "a"));
  write(folder / "a", "evidence");
  EXPECT_EQ(createNew(folder / "a"), std::errc::file_exists);
  EXPECT_EQ(textOf(folder / "a"), "evidence");
  EXPECT_EQ(createNew(folder / "not/there"), std::errc::no_such_file_or_directory);
}

TEST(Files, APrivateOneIsTheUsersAloneAndKeepsWhatItHolds) {
  const test::ScratchFolder folder("os-private");
  EXPECT_EQ(privacyOf(folder / "a"), Privacy::missing);
  EXPECT_FALSE(createPrivate(folder / "a"));
  EXPECT_EQ(privacyOf(folder / "a"), Privacy::own);
  write(folder / "a", "records");
  EXPECT_FALSE(createPrivate(folder / "a"));
  EXPECT_EQ(textOf(folder / "a"), "records");
  EXPECT_TRUE(createPrivate(folder / "not/there"));
  for (const fs::perms one : {fs::perms::group_read, fs::perms::others_read,
                              fs::perms::others_write, fs::perms::group_exec}) {
    fs::permissions(folder / "a", fs::perms::owner_read | one);
    EXPECT_EQ(privacyOf(folder / "a"), Privacy::shared);
  }
}

TEST(Files, NoneIsMadeThroughALink) {
  const test::ScratchFolder folder("os-link");
  fs::create_symlink("elsewhere", folder / "a");
  EXPECT_EQ(createNew(folder / "a"), std::errc::file_exists);
  EXPECT_TRUE(createPrivate(folder / "a"));
  EXPECT_FALSE(fs::exists(folder / "elsewhere"));
  write(folder / "elsewhere", "somebody's");
  EXPECT_EQ(createPrivate(folder / "a"), std::errc::too_many_symbolic_link_levels);
  EXPECT_EQ(appendPrivate(folder / "a", "more"), std::errc::too_many_symbolic_link_levels);
  EXPECT_EQ(textOf(folder / "elsewhere"), "somebody's");
}

TEST(Files, OnlyAFileOfTheUsersOwnIsUsedAgain) {
  const test::ScratchFolder folder("os-own");
  ASSERT_EQ(::mkfifo((folder / "pipe").c_str(), 0600), 0);
  fs::create_directory(folder / "folder");
  for (const char* name : {"pipe", "folder"}) {
    EXPECT_TRUE(createPrivate(folder / name)) << name;
    EXPECT_TRUE(appendPrivate(folder / name, "more")) << name;
  }
  write(folder / "anothers", "theirs");
  if (::chown((folder / "anothers").c_str(), 12345, static_cast<gid_t>(-1)) != 0)
    GTEST_SKIP() << "only the administrator can give a file away";
  fs::permissions(folder / "anothers", fs::perms::all);
  EXPECT_FALSE(createPrivate(folder / "anothers")) << "several accounts may share their records";
  EXPECT_EQ(appendPrivate(folder / "anothers", "more"), std::errc::operation_not_permitted);
  EXPECT_EQ(textOf(folder / "anothers"), "theirs");
}

TEST(Files, WhatIsAppendedComesBehind) {
  const test::ScratchFolder folder("os-append");
  EXPECT_FALSE(appendPrivate(folder / "a", "one "));
  EXPECT_FALSE(appendPrivate(folder / "a", "two"));
  EXPECT_EQ(textOf(folder / "a"), "one two");
  EXPECT_EQ(privacyOf(folder / "a"), Privacy::own);
  EXPECT_EQ(appendPrivate(folder / "not/there", "x"), std::errc::no_such_file_or_directory);
}

TEST(Files, FoldersThatAreMadeAreTheUsersAlone_GivenOnesStay) {
  const test::ScratchFolder folder("os-folders");
  const mode_t mask = ::umask(022);
  fs::create_directory(folder / "given");
  const fs::perms before = fs::status(folder / "given").permissions();
  EXPECT_FALSE(makeFolders(folder / "given/a/./b/"));
  EXPECT_FALSE(createNew(folder / "given/a/b/c"));
  ::umask(mask);
  EXPECT_EQ(fs::status(folder / "given").permissions(), before);
  EXPECT_NE(before, fs::perms::owner_all) << "or nothing is shown";
  for (const char* made : {"given/a", "given/a/b"})
    EXPECT_EQ(fs::status(folder / made).permissions(), fs::perms::owner_all) << made;
  EXPECT_EQ(privacyOf(folder / "given/a/b/c"), Privacy::own);
  EXPECT_FALSE(makeFolders(folder / "given/a/b")) << "again";
  EXPECT_EQ(makeFolders(folder / "given/a/b/c/d"), std::errc::not_a_directory);
}

TEST(Files, WhatIsNotThereMayNotBeWritten) {
  const test::ScratchFolder folder("os-write");
  EXPECT_TRUE(mayWrite(folder.path()));
  EXPECT_FALSE(mayWrite(folder / "not"));
}

TEST(Files, ATemporaryFolderGoesWithAllThatIsInIt) {
  fs::path inside;
  {
    const TemporaryFolder folder("palpa-os-");
    ASSERT_TRUE(folder.made());
    inside = folder.path() / "deep/er";
    fs::create_directories(inside);
    write(folder.path() / "file", "{}");
    EXPECT_EQ(privacyOf(folder.path()), Privacy::own);
    EXPECT_NE(TemporaryFolder("palpa-os-").path(), folder.path());
  }
  EXPECT_FALSE(fs::exists(inside.parent_path().parent_path()));
}

TEST(Files, AUsersFoldersFollowTheSettingsThenTheHome) {
  const Setting data("XDG_DATA_HOME", "/d"), state("XDG_STATE_HOME", "not/whole"),
      home("HOME", "/home/x");
  EXPECT_EQ(dataFolder(""), "/d");
  EXPECT_EQ(stateFolder(""), "/home/x/.local/state") << "a relative one does not count";
  const Setting none("HOME", nullptr), unset("XDG_DATA_HOME", nullptr);
  EXPECT_THROW(dataFolder("Set HOME"), UsageError) << "nothing in odd places";
  EXPECT_THROW(stateFolder("Set HOME"), UsageError);
}

TEST(FileLock, OneHolderAtATime) {
  const test::ScratchFolder folder("os-lock");
  const fs::path file = folder / "lock";
  EXPECT_FALSE(FileLock::exclusive(file, FileLock::Missing::fails));
  EXPECT_FALSE(isLocked(file));
  {
    const auto first = FileLock::exclusive(file, FileLock::Missing::is_made);
    ASSERT_TRUE(first);
    EXPECT_EQ(privacyOf(file), Privacy::own);
    EXPECT_TRUE(isLocked(file));
    EXPECT_FALSE(FileLock::exclusive(file, FileLock::Missing::is_made));
    EXPECT_FALSE(FileLock::exclusive(file, FileLock::Missing::fails));
  }
  EXPECT_FALSE(isLocked(file));
  EXPECT_TRUE(FileLock::exclusive(file, FileLock::Missing::fails));
}

/// Whoever holds it removes the file: another one may have opened it just before.
TEST(FileLock, HasOneHolderAlthoughItsFileComesAndGoes) {
  constexpr std::size_t kWorkers = 4;
  constexpr int kTries = 3000;
  const test::ScratchFolder folder("os-lock-removed");
  const fs::path file = folder / "lock", inside = folder / "inside";
  WorkerPool pool(kWorkers);
  for (std::size_t i = 0; i < kWorkers; ++i)
    pool.start(i, [&](const Report& report) {
      for (int held = 0; held < kTries;) {
        const auto lock = FileLock::exclusive(file, FileLock::Missing::is_made);
        if (!lock) continue;
        ++held;
        if (createNew(inside)) report("not alone");
        fs::remove(inside);
        fs::remove(file);
      }
    });
  while (!pool.isIdle())
    for (const WorkerNews& news : pool.await(1'000'000'000)) {
      EXPECT_EQ(news.lines.size(), 0u) << "times another was inside";
      EXPECT_EQ(news.failure, "");
    }
}

}  // namespace
}  // namespace palpa::os

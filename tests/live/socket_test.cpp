#include <fcntl.h>
#include <gtest/gtest.h>
#include <sys/stat.h>
#include <sys/un.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <vector>

#include "anatomy/base/error.h"
#include "peer.h"
#include "tests/support/short_folder.h"

namespace palpa::live {
namespace {

namespace fs = std::filesystem;

using test::ShortFolder;

unsigned modeOf(const fs::path& path) {
  struct stat facts {};
  return ::lstat(path.c_str(), &facts) == 0 ? facts.st_mode & 07777 : 0;
}

struct RuntimeFolder {
  explicit RuntimeFolder(const std::string& path) { ::setenv("XDG_RUNTIME_DIR", path.c_str(), 1); }
  ~RuntimeFolder() { ::unsetenv("XDG_RUNTIME_DIR"); }
};

TEST(LocalSocket, FolderAndSocketAreTheUsersAlone) {
  const ShortFolder here;
  const RuntimeFolder runtime(here.path());
  const mode_t mask = ::umask(0);
  const std::string folder = os::socketFolder();
  EXPECT_EQ(folder, (here / "palpa").string());
  EXPECT_EQ(modeOf(folder), 0700u);
  const int listener = os::listenAt(folder + "/a.sock");
  EXPECT_EQ(modeOf(folder + "/a.sock"), 0600u);
  EXPECT_EQ(::umask(mask), 0u) << "it was left changed";
  ::close(listener);
  EXPECT_EQ(os::socketFolder(), folder);
}

TEST(LocalSocket, AFolderThatOthersMayEnterIsRefused) {
  const ShortFolder here;
  const RuntimeFolder runtime(here.path());
  fs::create_directory(here / "palpa");
  for (const unsigned mode : {0750u, 0701u, 0777u, 0720u}) {
    ASSERT_EQ(::chmod((here / "palpa").c_str(), mode), 0);
    EXPECT_THROW(os::socketFolder(), Error) << std::oct << mode;
  }
  ASSERT_EQ(::chmod((here / "palpa").c_str(), 0700), 0);
  EXPECT_NO_THROW(os::socketFolder());
}

TEST(LocalSocket, AFolderThatIsALinkOrAFileIsRefused) {
  const ShortFolder here;
  const RuntimeFolder runtime(here.path());
  fs::create_directory(here / "elsewhere");
  ASSERT_EQ(::chmod((here / "elsewhere").c_str(), 0700), 0);
  fs::create_symlink(here / "elsewhere", here / "palpa");
  EXPECT_THROW(os::socketFolder(), Error);
  fs::remove(here / "palpa");
  std::ofstream(here / "palpa") << "x";
  EXPECT_THROW(os::socketFolder(), Error);
}

TEST(LocalSocket, WhatADeadSessionLeftIsTakenOver_ALivingOnesIsNot) {
  const ShortFolder here;
  const std::string path = here / "s.sock";
  const int dead = os::listenAt(path);
  ::close(dead);
  EXPECT_TRUE(fs::exists(path)) << "as a killed session leaves it";
  EXPECT_FALSE(Peer(path).connected());
  const int living = os::listenAt(path);
  EXPECT_TRUE(Peer(path).connected());
  EXPECT_THROW(os::listenAt(path), Error);
  EXPECT_TRUE(Peer(path).connected()) << "the living one's socket was taken away";
  ::close(living);
}

TEST(LocalSocket, WhatIsNoDeadSocketOfOursStays) {
  const ShortFolder here;
  const std::string file = here / "notes", link = here / "link", socket = here / "s.sock";
  std::ofstream(file) << "a year's work";
  ::close(os::listenAt(socket));
  fs::create_symlink(socket, link);
  for (const std::string& path : {file, link}) {
    EXPECT_THROW(os::listenAt(path), Error) << path;
    os::removeSocket(path);
    EXPECT_TRUE(fs::exists(fs::symlink_status(path))) << path;
  }
  EXPECT_EQ(fs::file_size(file), 13u);
  os::removeSocket(socket);
  EXPECT_FALSE(fs::exists(socket));
}

/// Nobody answers, and more callers than the queue holds have come: its owner lives all the same.
TEST(LocalSocket, ABusyOneIsNotTakenAway) {
  const ShortFolder here;
  const std::string path = here / "s.sock";
  const int living = os::listenAt(path);
  std::vector<int> callers;
  while (callers.size() < 100)
    if (const int caller = os::connectTo(path); caller >= 0)
      callers.push_back(caller);
    else
      break;
  EXPECT_LT(callers.size(), 100u) << "its queue is not full";
  EXPECT_THROW(os::listenAt(path), Error);
  EXPECT_TRUE(fs::exists(path));
  for (const int caller : callers) ::close(caller);
  ::close(living);
}

TEST(LocalSocket, APathThatNoSocketCanHaveIsAnErrorToListenAndNobodyToCall) {
  const ShortFolder here;
  const std::string longest =
      here.path().string() + "/" +
      std::string(sizeof(sockaddr_un{}.sun_path) - here.path().string().size() - 2, 'x');
  ::close(os::listenAt(longest));
  EXPECT_THROW(os::listenAt(longest + "x"), Error);
  EXPECT_EQ(os::connectTo(longest + "x"), -1);
  EXPECT_EQ(os::connectTo(std::string(10'000, 'x')), -1);
  EXPECT_THROW(os::listenAt(here / "not/there.sock"), Error);
  EXPECT_EQ(os::connectTo(here / "not/there.sock"), -1);
}

TEST(LocalSocket, NothingOfItStaysOpenInAChild) {
  const ShortFolder here;
  const int listener = os::listenAt(here / "s.sock");
  const int caller = os::connectTo(here / "s.sock");
  for (const int socket : {listener, caller}) EXPECT_TRUE(::fcntl(socket, F_GETFD) & FD_CLOEXEC);
  ::close(listener);
  ::close(caller);
}

}  // namespace
}  // namespace palpa::live

#include "apps/os/child_process.h"

#include <fcntl.h>
#include <gtest/gtest.h>
#include <signal.h>
#include <sys/resource.h>
#include <sys/socket.h>
#include <unistd.h>

#include <fstream>
#include <thread>

#include "anatomy/base/error.h"
#include "apps/console/jobs.h"
#include "apps/os/real_time.h"
#include "apps/runtime/clock.h"
#include "tests/support/damage.h"
#include "tests/support/scratch_folder.h"

namespace palpa::console {
namespace {

bool ends(const os::ProcessId& process) {
  const auto until = runtime::ServingClock::now() + std::chrono::seconds(60);
  while (os::runs(process) && runtime::ServingClock::now() < until)
    runtime::rest(std::chrono::milliseconds(5));
  return !os::runs(process);
}

TEST(Child, NothingOfOursStaysOpenAndItIsItsOwnMaster) {
  const test::ScratchFolder folder("child");
  const int file = ::open("/dev/null", O_RDONLY),
            high = ::fcntl(file, F_DUPFD, 200);  // without O_CLOEXEC: as a library forgets it
  int line[2];
  ASSERT_EQ(::socketpair(AF_UNIX, SOCK_STREAM, 0, line), 0);
  sigset_t term, old;
  sigemptyset(&term);
  sigaddset(&term, SIGTERM);
  ::pthread_sigmask(SIG_BLOCK, &term, &old);
  const os::ProcessId child = os::start({"facts"}, folder / "log.txt", false);
  ::pthread_sigmask(SIG_SETMASK, &old, nullptr);
  ASSERT_TRUE(ends(child));
  const auto lines = lastLines(folder / "log.txt", 10);
  ASSERT_EQ(lines.size(), 6u);
  EXPECT_EQ(lines[0], "open 0 1 2");
  EXPECT_EQ(lines[1], "own_group 1");
  EXPECT_EQ(lines[2], "own_session 1");
  EXPECT_EQ(lines[3], "input /dev/null");
  EXPECT_EQ(lines[4], "blocked 0");
  for (const int one : {file, high, line[0], line[1]}) ::close(one);
}

/// What gives way itself would start a session that gives way: the starter does not.
TEST(Child, OfAStarterHasThePriorityOfWhoMadeIt) {
  const test::ScratchFolder folder("priority");
  os::ProcessStarter starter;
  const int ours = ::getpriority(PRIO_PROCESS, 0);
  os::ProcessId child, niced;
  std::thread([&] {
    os::giveWay();
    niced = os::start({"facts"}, folder / "niced.txt", false);
    child = starter.start({"facts"}, folder / "log.txt");
    EXPECT_THROW(starter.start({"facts"}, "/proc/there/is/none/log.txt"), Error);
  }).join();
  ASSERT_TRUE(ends(child) && ends(niced));
  const auto priority = [&](const char* log) { return lastLines(folder / log, 1).at(0); };
  EXPECT_EQ(priority("log.txt"), "priority " + std::to_string(ours));
  EXPECT_NE(priority("niced.txt"), priority("log.txt"));
}

TEST(Child, ItsLogIsTheUsersAlone) {
  const test::ScratchFolder folder("log");
  const mode_t mask = ::umask(0);
  const os::ProcessId child = os::start({"facts"}, folder / "log.txt", false);
  ::umask(mask);
  ASSERT_TRUE(ends(child));
  EXPECT_EQ(std::filesystem::status(folder / "log.txt").permissions(),
            std::filesystem::perms::owner_read | std::filesystem::perms::owner_write);
}

TEST(Child, IsAskedToEndAndGone) {
  const test::ScratchFolder folder("end");
  const os::ProcessId child = os::start({"wait"}, folder / "log.txt", true);
  EXPECT_TRUE(os::runs(child));
  const auto until = runtime::ServingClock::now() + std::chrono::seconds(30);
  while (lastLines(folder / "log.txt", 1).empty() && runtime::ServingClock::now() < until)
    runtime::rest(std::chrono::milliseconds(5));  // it waits for Ctrl-C now
  os::askToEnd(child);
  EXPECT_TRUE(ends(child));
  os::askToEnd(child);  // nobody is there: nobody is hit
}

/// A later process with the same number is not taken for it, and not asked to end.
TEST(Child, AnotherProcessWithTheSameNumberIsNotIt) {
  const os::ProcessId self{::getpid(), 1};
  EXPECT_FALSE(os::runs(self));
  os::askToEnd(self);
  for (const os::ProcessId none : {os::ProcessId{0, 0}, os::ProcessId{-1, 5},
                                   os::ProcessId{1 << 30, 5}, os::ProcessId{::getpid(), 0}}) {
    EXPECT_FALSE(os::runs(none));
    os::askToEnd(none);
  }
}

TEST(Child, ALogInAFolderThatIsNotThereIsAnError) {
  EXPECT_THROW(os::start({"facts"}, "/proc/there/is/none/log.txt", false), Error);
}

TEST(Child, LastLinesOfAnyLog) {
  const test::ScratchFolder folder("lines");
  EXPECT_TRUE(lastLines(folder / "none", 5).empty());
  std::ofstream(folder / "a") << "one\n\ntwo\rthree\n10 %\r20 %\r\nfour";
  EXPECT_EQ(lastLines(folder / "a", 5), (std::vector<std::string>{"one", "three", "four"}));
  EXPECT_EQ(lastLines(folder / "a", 1), (std::vector<std::string>{"four"}));
  std::ofstream(folder / "b") << std::string(1 << 20, 'x');
  EXPECT_LE(lastLines(folder / "b", 5).at(0).size(), 16u << 10);
  std::ofstream(folder / "c") << "palpa: first: a. b\nmore\npalpa: last: c. d\nfar more\n";
  EXPECT_EQ(complaintIn(folder / "c"), "last: c. d");
  EXPECT_EQ(complaintIn(folder / "a"), "");
}

}  // namespace
}  // namespace palpa::console

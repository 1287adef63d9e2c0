#include <fcntl.h>
#include <gtest/gtest.h>
#include <malloc.h>
#include <pthread.h>
#include <signal.h>
#include <sys/resource.h>
#include <sys/syscall.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <cerrno>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <functional>
#include <map>
#include <memory>
#include <sstream>
#include <string>
#include <thread>
#include <vector>

#include "anatomy/base/error.h"
#include "anatomy/base/whole_file.h"
#include "apps/os/child_process.h"
#include "apps/os/real_time.h"
#include "apps/os/signals.h"
#include "apps/os/socket.h"
#include "apps/os/system_time.h"
#include "apps/os/worker_processes.h"
#include "tests/support/counts.h"
#include "tests/support/scratch_folder.h"

namespace palpa::os {
namespace {

constexpr std::int64_t kLook_ns = 1'000'000'000;

/// All that is told until every worker has ended.
std::vector<WorkerNews> newsOf(WorkerPool& pool) {
  std::vector<WorkerNews> all;
  while (!pool.isIdle())
    for (const WorkerNews& news : pool.await(kLook_ns)) all.push_back(news);
  return all;
}

TEST(Workers, TellTheirLinesInOrderAndOnlyWhatTheySaid) {
  constexpr std::size_t kWorkers = 4, kLines = 1000;
  WorkerPool pool(kWorkers);
  for (std::size_t i = 0; i < kWorkers; ++i)
    pool.start(i, [i](const Report& report) {
      for (std::size_t line = 0; line < kLines; ++line)
        report(std::to_string(i) + ":" + std::to_string(line));
    });
  EXPECT_TRUE(pool.isFull());
  std::map<std::size_t, std::size_t> told;
  std::size_t ended = 0;
  for (const WorkerNews& news : newsOf(pool)) {
    for (const std::string& line : news.lines)
      EXPECT_EQ(line, std::to_string(news.item) + ":" + std::to_string(told[news.item]++));
    EXPECT_EQ(news.failure, "");
    ended += news.ended;
  }
  EXPECT_EQ(ended, kWorkers);
  for (const auto& [item, lines] : told) EXPECT_EQ(lines, kLines) << item;
  EXPECT_TRUE(pool.await(0).empty()) << "none is left";
}

TEST(Workers, ThatFailOrCrashAreToldApart) {
  const std::pair<std::function<void(const Report&)>, const char*> kinds[]{
      {[](const Report&) {}, ""},
      {[](const Report&) { throw Error("is broken", "it", "Mend it"); }, "it: is broken. Mend it"},
      {[](const Report&) { ::raise(SIGKILL); }, "its process was ended by signal KILL"},
      {[](const Report& report) {
         report("begun");
         ::signal(SIGSEGV, SIG_DFL);  // whatever runs the tests makes of it
         ::raise(SIGSEGV);
       },
       "its process was ended by signal SEGV"},
      {[](const Report&) { ::_exit(3); }, "its process ended by itself"}};
  WorkerPool pool(std::size(kinds));
  for (std::size_t i = 0; i < std::size(kinds); ++i) pool.start(i, kinds[i].first);
  std::size_t ended = 0;
  for (const WorkerNews& news : newsOf(pool))
    if (news.ended) {
      EXPECT_EQ(news.failure, kinds[news.item].second);
      ++ended;
    }
  EXPECT_EQ(ended, std::size(kinds));
}

TEST(Workers, EndWhenTheyAreAskedToAndWithTheirPool) {
  const auto sleep = [](const Report&) {
    ::signal(SIGTERM, SIG_DFL);
    for (;;) ::pause();
  };
  WorkerPool asked(1);
  asked.start(7, sleep);
  EXPECT_TRUE(asked.await(0).empty());
  asked.askToEnd();
  const std::vector<WorkerNews> news = newsOf(asked);
  ASSERT_EQ(news.size(), 1u);
  EXPECT_EQ(news[0].item, 7u);
  EXPECT_EQ(news[0].failure, "its process was ended by signal TERM");
  WorkerPool dropped(2);  // its end does not wait for theirs
  for (const std::size_t item : {0u, 1u}) dropped.start(item, sleep);
}

TEST(Workers, PrintIntoAFile) {
  const test::ScratchFolder here("printing");
  WorkerPool pool(1);
  pool.start(0, [&](const Report&) {
    sendOutputTo(here / "printed.txt");
    std::puts("to the one");
    std::fputs("and to the other\n", stderr);
  });
  EXPECT_EQ(newsOf(pool).at(0).failure, "");
  const std::string printed = readWhole(here / "printed.txt").value_or("");
  EXPECT_NE(printed.find("to the one\n"), std::string::npos) << printed;
  EXPECT_NE(printed.find("and to the other\n"), std::string::npos) << printed;
}

TEST(Workers, HaveAtLeastOneProcessor) {
  EXPECT_GE(processorsForUs(), 1);
  EXPECT_LE(processorsForUs(), ::sysconf(_SC_NPROCESSORS_CONF));
}

/// Which process this is.
void tellWho(const Report& report) {
  report(std::to_string(thisProcess().began) + " " + std::to_string(thisProcess().pid));
}

/// A process that tells who it is, and then waits.
ProcessId waitingOne(WorkerPool& pool, const std::function<void(const Report&)>& waits) {
  pool.start(0, waits);
  std::vector<WorkerNews> news;
  while (news.empty()) news = pool.await(kLook_ns);
  ProcessId who;
  std::istringstream(news[0].lines.at(0)) >> who.began >> who.pid;
  return who;
}

TEST(Processes, AStoppedOneIsSeenToBeAndIsEnded) {
  WorkerPool pool(1);
  const ProcessId process = waitingOne(pool, [](const Report& report) {
    tellWho(report);
    for (;;) ::pause();
  });
  EXPECT_TRUE(runs(process));
  EXPECT_FALSE(isStopped(process));
  ::kill(process.pid, SIGSTOP);
  while (!isStopped(process)) sleepUntilMonotonic(monotonic_ns() + 1'000'000);
  EXPECT_FALSE(isStopped({process.pid, process.began + 1})) << "another one of that number";
  endAtOnce({process.pid, process.began + 1});
  EXPECT_TRUE(isStopped(process));
  endAtOnce(process);
  while (runs(process)) sleepUntilMonotonic(monotonic_ns() + 1'000'000);
  EXPECT_FALSE(isStopped(process));
}

/// What a killed program is for a while: its first thread has ended, another has not, and its files
/// are open.
TEST(Processes, OneRunsAsLongAsAThreadOfIt) {
  WorkerPool pool(1);
  const ProcessId process = waitingOne(pool, [](const Report& report) {
    std::thread([&report, first = processNumber()] {
      const std::string stat = "/proc/" + std::to_string(first) + "/stat";
      while (readWhole(stat).value_or("").find(") Z ") == std::string::npos)
        sleepUntilMonotonic(monotonic_ns() + 1'000'000);
      tellWho(report);
      for (;;) ::pause();
    }).detach();
    ::syscall(SYS_exit, 0);
  });
  EXPECT_TRUE(runs(process));
  endAtOnce(process);
  while (runs(process)) sleepUntilMonotonic(monotonic_ns() + 1'000'000);
}

TEST(Processes, TheLineToACompanionEndsWithIt) {
  const Companion lister = startWithLine({"--gtest_list_tests"});  // of this test, to nowhere
  ASSERT_GE(lister.line, 0);
  char byte = 0;
  while (receiveSome(lister.line, &byte, 1)) ready(lister.line, Wait::to_read, 100);
  while (runs(lister.process)) sleepUntilMonotonic(monotonic_ns() + 1'000'000);
  closeSocket(lister.line);
}

TEST(Processes, WhatOneTookIsKnownAtItsEnd) {
  const test::ScratchFolder folder("spent");
  const Spent spent = runToEnd({"--gtest_list_tests"}, folder.path() / "log");
  EXPECT_EQ(spent.exit_code, 0);
  EXPECT_GT(spent.peak_MB, 0.5);
  EXPECT_LT(spent.peak_MB, 10'000);
  EXPECT_GE(spent.processor_s, 0);
}

TEST(Processes, KnowTheirProgram) {
  EXPECT_EQ(thisProcess().pid, processNumber());
  EXPECT_TRUE(runs(thisProcess()));
  EXPECT_EQ(programName(), "test_os");
}

TEST(Interrupt, ASignalToThisProcessIsNoted) {
  const InterruptNote note;
  EXPECT_FALSE(note.noted());
  signalThisProcess();
  while (!note.noted()) sleepUntilMonotonic(monotonic_ns() + 1'000'000);
}

TEST(Interrupt, IsNotedAndTheOldHandlerComesBack) {
  static std::atomic<int> old{0};
  const auto before = ::signal(SIGTERM, [](int) { ++old; });
  {
    const InterruptNote note(InterruptNote::Again::noted);
    EXPECT_FALSE(note.noted());
    for (int i = 0; i < 2; ++i) ::raise(SIGTERM);
    EXPECT_TRUE(note.noted());
  }
  EXPECT_EQ(old, 0);
  ::raise(SIGTERM);
  EXPECT_EQ(old, 1);
  EXPECT_FALSE(InterruptNote().noted()) << "a new one begins anew";
  ::signal(SIGTERM, before);
}

TEST(Interrupt, AClosedTerminalAndTheOthersAreNoted) {
  for (const int signal : {SIGHUP, SIGQUIT, SIGUSR1, SIGUSR2, SIGTERM, SIGINT}) {
    const auto before = ::signal(signal, SIG_DFL);
    {
      const InterruptNote note;
      EXPECT_FALSE(note.noted());
      ::raise(signal);
      EXPECT_TRUE(note.noted()) << signal;
    }
    EXPECT_EQ(::signal(signal, before), SIG_DFL) << signal;
  }
}

/// A terminal that closes sends its signal more than once.
TEST(Interrupt, AClosedTerminalNeverKills) {
  const auto before = ::signal(SIGHUP, SIG_DFL);
  {
    const InterruptNote note;
    for (int i = 0; i < 3; ++i) ::raise(SIGHUP);
    EXPECT_TRUE(note.noted());
  }
  ::signal(SIGHUP, before);
}

TEST(Interrupt, WhatNohupIgnoresStaysIgnored) {
  const auto before = ::signal(SIGHUP, SIG_IGN);
  {
    const InterruptNote note;
    ::raise(SIGHUP);
    EXPECT_FALSE(note.noted());
  }
  EXPECT_EQ(::signal(SIGHUP, before), SIG_IGN);
}

TEST(Interrupt, OneWithinAnotherNotesTheSame) {
  const InterruptNote outer(InterruptNote::Again::noted);
  ::raise(SIGTERM);
  {
    const InterruptNote inner;
    EXPECT_TRUE(inner.noted()) << "what was noted before it is not forgotten";
  }
  ::raise(SIGTERM);
  EXPECT_TRUE(outer.noted());
}

TEST(Interrupt, AReaderWhoHasGoneAwayDoesNotKill) {
  int ends[2];
  ASSERT_EQ(::pipe(ends), 0);
  ::close(ends[0]);
  const InterruptNote note;
  EXPECT_EQ(::write(ends[1], "x", 1), -1);
  EXPECT_FALSE(note.noted());
  ::close(ends[1]);
}

TEST(Interrupt, ASecondOneKills) {
  EXPECT_EXIT(
      {
        const InterruptNote note;
        ::raise(SIGINT);
        if (note.noted()) ::raise(SIGINT);
      },
      ::testing::KilledBySignal(SIGINT), "");
}

TEST(SystemTime, GoesOnAndSleepsUntilThen) {
  const std::int64_t until = monotonic_ns() + 2'000'000;
  sleepUntilMonotonic(until);
  EXPECT_GE(monotonic_ns(), until);
  sleepUntilMonotonic(0);  // long past: at once
  EXPECT_GT(monotonicResolution_ns(), 0);
  EXPECT_GT(date_ns(), 1'600'000'000'000'000'000) << "after 2020";
}

TEST(Program, OneThatIsNotInstalledIsNotStarted) {
  EXPECT_FALSE(startProgram("palpa-no-such-program", {}));
  EXPECT_GT(processNumber(), 1);
}

/// In a process of its own: the limit stays.
TEST(Signals, AFilePastItsLimitFailsInPlaceOfEndingTheProgram) {
  const test::ScratchFolder folder("os-limit");
  const auto written = [&] {
    const rlimit limit{1000, 1000};
    if (::setrlimit(RLIMIT_FSIZE, &limit) != 0) ::_exit(3);
    letLargeFilesFail();
    const int file = ::open((folder / "a").c_str(), O_WRONLY | O_CREAT, 0600);
    const std::string much(1000, 'x');
    if (::write(file, much.data(), much.size()) != 1000) ::_exit(4);
    ::_exit(::write(file, much.data(), 1) < 0 && errno == EFBIG ? 0 : 5);
  };
  EXPECT_EXIT(written(), testing::ExitedWithCode(0), "");
}

/// In a process of its own: the setting stays.
TEST(Memory, LargePiecesGoBackAsSoonAsTheyAreFree) {
  if (test::kSanitized) GTEST_SKIP() << "a sanitizer has its own memory";
  const auto given_back = [] {
    void* volatile piece = std::malloc(8 << 20);
    std::free(piece);  // as is usual, pieces up to this size are kept from now on
    giveLargeMemoryBack();
    const std::size_t before = mallinfo2().hblks;
    piece = std::malloc(1 << 20);
    if (mallinfo2().hblks != before + 1) ::_exit(3);
    std::free(piece);
    ::_exit(mallinfo2().hblks == before ? 0 : 4);
  };
  EXPECT_EXIT(given_back(), testing::ExitedWithCode(0), "");
}

/// In a process of its own: the setting stays.
TEST(Memory, AThreadsStackIsSmall) {
  const auto small = [] {
    keepStacksSmall();
    std::size_t size = 0;
    startThread([&size] {
      pthread_attr_t now;
      void* from = nullptr;
      if (pthread_getattr_np(pthread_self(), &now) != 0) return;
      pthread_attr_getstack(&now, &from, &size);
      pthread_attr_destroy(&now);
    }).join();
    ::_exit(size > 0 && size <= (2 << 20) + 65536 ? 0 : 3);
  };
  EXPECT_EXIT(small(), testing::ExitedWithCode(0), "");
}

/// Pages of this process that are in memory.
long residentPages() {
  std::ifstream statm("/proc/self/statm");
  long size = 0, resident = 0;
  statm >> size >> resident;
  return resident;
}

TEST(Memory, WhatIsFreeBetweenPiecesInUseGoesBack) {
  if (test::kSanitized) GTEST_SKIP() << "a sanitizer has its own memory";
  constexpr std::size_t kPiece = 20'000, kPieces = 2000;
  std::vector<std::unique_ptr<char[]>> pieces;
  for (std::size_t i = 0; i < kPieces; ++i) {
    pieces.emplace_back(new char[kPiece]);
    std::fill_n(pieces.back().get(), kPiece, 'x');
  }
  for (std::size_t i = 0; i < kPieces; ++i)
    if (i % 4 != 0) pieces[i].reset();
  const long before = residentPages();
  giveFreeMemoryBack();
  const auto free = static_cast<long>(3 * kPieces / 4 * kPiece) / ::sysconf(_SC_PAGESIZE);
  EXPECT_GT(before - residentPages(), free / 2);
}

}  // namespace
}  // namespace palpa::os

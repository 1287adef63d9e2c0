#include <gtest/gtest.h>
#include <sys/mman.h>
#include <sys/wait.h>
#include <unistd.h>

#include <atomic>
#include <csignal>

#include "synthetic_session.h"
#include "tests/support/counts.h"

namespace palpa::record {
namespace {

using namespace test;
namespace fs = std::filesystem;

/// What the child has done, in memory that outlives it.
struct Progress {
  std::atomic<std::int64_t> ticks{0};  ///< handed to the writer
};

[[noreturn]] void recordUntilKilled(const fs::path& file, Progress& progress) {
  SessionWriter writer(file, syntheticInfo());
  writer.beginTrial({1, 0, 1, "scored", true, 1.5});
  for (std::int64_t tick = 0;; ++tick) {
    writeTicks(writer, tick, tick + 1);
    progress.ticks.store(tick + 1);
  }
}

/// Forks a recorder and kills it once it has handed over at least `target` ticks.
std::int64_t killAfter(std::int64_t target, const fs::path& file, Progress& progress) {
  progress.ticks.store(0);
  const pid_t child = fork();
  if (child == 0) recordUntilKilled(file, progress);
  while (progress.ticks.load() < target) {
    if (waitpid(child, nullptr, WNOHANG) == child) {
      ADD_FAILURE() << "the recorder died by itself";
      return 0;
    }
    usleep(50);
  }
  kill(child, SIGKILL);
  int status = 0;
  waitpid(child, &status, 0);
  EXPECT_TRUE(WIFSIGNALED(status));
  return progress.ticks.load();
}

TEST(Kill, LosesAtMostTwoHundredTicks) {
  const fs::path folder = freshFolder("kill");
  void* shared =
      mmap(nullptr, sizeof(Progress), PROT_READ | PROT_WRITE, MAP_SHARED | MAP_ANONYMOUS, -1, 0);
  ASSERT_NE(shared, MAP_FAILED);
  auto& progress = *new (shared) Progress;
  const int kills = palpa::test::counted(10, 50);
  for (int k = 0; k < kills; ++k) {
    const fs::path file = folder / ("session" + std::to_string(k) + ".palpa");
    const auto target =
        static_cast<std::int64_t>(1 + splitMix64(static_cast<std::uint64_t>(k)) % 6000);
    const std::int64_t written = killAfter(target, file, progress);
    const std::string evidence = slurp(file), log = slurp(file.string() + "-wal");

    std::int64_t ticks = 0;
    {
      const SessionReader reader(file);
      reader.ticks([&](const haptics::FlightRecord& record) {
        ASSERT_EQ(bits(record), bits(syntheticTick(ticks++)));
      });
      // The child may die between its tick and its word about it: one more may be there.
      EXPECT_GE(ticks, written - 200) << "kill " << k;
      EXPECT_LE(ticks, written + 1) << "kill " << k;
      if (ticks > 0) {
        ASSERT_EQ(reader.trials().size(), 1u);
        EXPECT_FALSE(reader.trials()[0].ended);
      }
    }
    EXPECT_EQ(slurp(file), evidence) << "reading changed the evidence";
    EXPECT_EQ(slurp(file.string() + "-wal"), log) << "reading changed the log";
  }
  munmap(shared, sizeof(Progress));
}

}  // namespace
}  // namespace palpa::record

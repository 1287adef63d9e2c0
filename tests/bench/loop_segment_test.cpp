#include "apps/bench/loop_segment.h"

#include <gtest/gtest.h>

#include "apps/bench/bench_patients.h"
#include "apps/runtime/clock.h"

/// How late either loop was is the machine's affair; that they can be compared is ours.
namespace palpa::bench {
namespace {

constexpr std::int64_t kLength = 50 * runtime::kMillisecond;

struct LoopSegment : testing::Test {
  anatomy::Patient patient = torsoPatient(1000);
  anatomy::SurfaceQuery query{patient};
  anatomy::LocalGeometryBuilder builder{patient, query};
  LoopSurroundings around{{}, builder};
};

TEST_F(LoopSegment, BothLoopsAskTheSystemForTheSame) {
  const OurTimes ours = runOurSegment(around, kLength);
  const LoopTimes bare = runBareSegment(around, kLength);
  EXPECT_EQ(ours.times.scheduling, bare.scheduling);
  EXPECT_NE(ours.times.scheduling.find("memory"), std::string::npos) << ours.times.scheduling;
  EXPECT_GE(ours.times.late.count(), 1u);
  EXPECT_GE(bare.late.count(), 1u);
  EXPECT_LE(ours.contacts, ours.times.late.count());
}

TEST_F(LoopSegment, AProcessorIsAskedForInBoth) {
  around.cpu = 1 << 20;  // there is none like it
  const std::string refused = "CPU 1048576 refused (this computer has none)";
  EXPECT_NE(runOurSegment(around, kLength).times.scheduling.find(refused), std::string::npos);
  EXPECT_NE(runBareSegment(around, kLength).scheduling.find(refused), std::string::npos);
}

TEST_F(LoopSegment, NoMoreTicksThanPeriodsAndOneAtTheStart) {
  around.period_ns = runtime::kMillisecond / 4;
  const LoopTimes bare = runBareSegment(around, kLength);
  EXPECT_LE(bare.late.count(), static_cast<std::uint64_t>(kLength / around.period_ns));
  EXPECT_LE(bare.missed, bare.late.count());
}

}  // namespace
}  // namespace palpa::bench

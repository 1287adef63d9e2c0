#include "haptics/sensors/rdt_protocol.h"

#include <gtest/gtest.h>

namespace palpa::haptics {
namespace {

struct Stream {
  RdtSequence state;
  RdtStep take(std::uint32_t rdt, std::uint32_t ft) {
    RdtRecord record;
    record.rdt_sequence = rdt;
    record.ft_sequence = ft;
    return advance(state, record);
  }
};

TEST(RdtSequence, TheFirstRecordStartsAStreamWhateverItsNumber) {
  Stream s;
  const RdtStep first = s.take(17, 900);
  EXPECT_EQ(first.verdict, RdtVerdict::fresh);
  EXPECT_EQ(first.missing, 0u);
}

TEST(RdtSequence, GapsDuplicatesAndLateOnes) {
  Stream s;
  s.take(1, 101);
  EXPECT_EQ(s.take(2, 102).missing, 0u);
  EXPECT_EQ(s.take(5, 105).missing, 2u);
  EXPECT_EQ(s.take(5, 105).verdict, RdtVerdict::duplicate);
  EXPECT_EQ(s.take(3, 103).verdict, RdtVerdict::late);
  EXPECT_EQ(s.take(6, 106).missing, 0u) << "what was dropped does not move the state";
}

TEST(RdtSequence, BothNumbersWrap) {
  Stream s;
  s.take(0xfffffffe, 0xffffffff);
  const RdtStep next = s.take(1, 2);
  EXPECT_EQ(next.verdict, RdtVerdict::fresh);
  EXPECT_EQ(next.missing, 2u);
  EXPECT_EQ(s.take(0xffffffff, 0).verdict, RdtVerdict::late);
}

TEST(RdtSequence, ANewStreamIsToldFromALateRecordByTheSensorsOwnCounter) {
  Stream s;
  s.take(500, 7000);
  const RdtStep restarted = s.take(1, 7010);
  EXPECT_EQ(restarted.verdict, RdtVerdict::fresh);
  EXPECT_EQ(restarted.missing, 0u);
  EXPECT_EQ(s.take(501, 7001).verdict, RdtVerdict::late) << "left over from the old stream";
  EXPECT_EQ(s.take(2, 7011).missing, 0u);
}

TEST(RdtSequence, ARebootedSensorIsTakenAfterTheNextRequest) {
  Stream s;
  s.take(500, 7000);
  EXPECT_EQ(s.take(1, 3).verdict, RdtVerdict::late);
  s.state.known = false;
  EXPECT_EQ(s.take(2, 4).verdict, RdtVerdict::fresh);
}

}  // namespace
}  // namespace palpa::haptics

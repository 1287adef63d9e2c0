#include "haptics/sensors/rdt_protocol.h"

#include <gtest/gtest.h>

#include <cmath>

#include "anatomy/base/random.h"
#include "fake_net_ft.h"

namespace palpa::haptics {
namespace {

Bytes bytesOf(const RdtRequest& request) { return {request.begin(), request.end()}; }

RdtRecord parsed(const Bytes& bytes, std::size_t record = 0) {
  return rdtRecord(std::span(bytes).subspan(record * kRdtRecordBytes).first<kRdtRecordBytes>());
}

Bytes written(const RdtRecord& r) {
  return recordBytes(r.rdt_sequence, r.ft_sequence, r.status,
                     {r.force_counts[0], r.force_counts[1], r.force_counts[2], r.torque_counts[0],
                      r.torque_counts[1], r.torque_counts[2]});
}

TEST(RdtRequest, BytesAreThoseOfTheManual) {
  EXPECT_EQ(bytesOf(rdtRequest(kRdtStart)), kStartBytes);
  EXPECT_EQ(bytesOf(rdtRequest(kRdtStop)), kStopBytes);
  EXPECT_EQ(bytesOf(rdtRequest(kRdtSoftwareBias)), kBiasBytes);
  EXPECT_EQ(bytesOf(rdtRequest(0x0103, 0x0a0b0c0d)),
            (Bytes{0x12, 0x34, 0x01, 0x03, 0x0a, 0x0b, 0x0c, 0x0d}));
}

TEST(RdtRecord, IsReadBigEndianAndSigned) {
  const Bytes bytes{
      0, 0, 0,    7,    1,    2,    3,    4,    0x80, 0,    0,    1,     // numbers, status
      0, 0, 0,    1,    0xff, 0xff, 0xff, 0xff, 0x7f, 0xff, 0xff, 0xff,  // force
      0, 0, 0x27, 0x10, 0x80, 0,    0,    0,    0xff, 0xff, 0xff, 0};    // torque
  const RdtRecord record = parsed(bytes);
  EXPECT_EQ(record.rdt_sequence, 7u);
  EXPECT_EQ(record.ft_sequence, 0x01020304u);
  EXPECT_EQ(record.status, 0x80000001u);
  EXPECT_EQ(record.force_counts, (std::array<std::int32_t, 3>{1, -1, 2147483647}));
  EXPECT_EQ(record.torque_counts, (std::array<std::int32_t, 3>{10000, INT32_MIN, -256}));
}

TEST(RdtRecord, CountsBecomeNewtonsByTheSensorsScale) {
  const RdtRecord record =
      parsed(recordBytes(1, 55, 0, {1'500'000, -250'000, 3, 80'000, 4, -16'000}));
  const WrenchSample sample = rdtWrench(record, {1e6, 1.6e4});
  EXPECT_EQ(sample.f_S, (Packed3{1.5, -0.25, 3e-6}));
  EXPECT_EQ(sample.tau_S, (Packed3{5, 2.5e-4, -1}));
  EXPECT_EQ(sample.ft_sequence, 55u);
  EXPECT_EQ(sample.flags, 0u);
  EXPECT_EQ(rdtWrench(parsed(recordBytes(1, 1, 0x20)), {}).flags, kFault);
  EXPECT_EQ(rdtWrench(parsed(recordBytes(1, 1, 0x20)), {}).status, 0x20u);
}

TEST(RdtRecord, OnlyWholeRecordsOfOneFrameCount) {
  EXPECT_EQ(rdtRecordCount(0), 0u);
  EXPECT_EQ(rdtRecordCount(35), 0u);
  EXPECT_EQ(rdtRecordCount(36), 1u);
  EXPECT_EQ(rdtRecordCount(37), 0u);
  EXPECT_EQ(rdtRecordCount(72), 2u);
  EXPECT_EQ(rdtRecordCount(1440), 40u);
  EXPECT_EQ(rdtRecordCount(1476), 0u) << "more than one frame holds";
}

TEST(RdtRecord, AnyDatagramIsSurvivedAndNoBitIsLost) {
  RandomStream random(7, "rdt fuzz");
  int whole = 0;
  for (int i = 0; i < 100'000; ++i) {
    std::size_t length = random.bits() % 1600;
    if (i % 2) length -= length % kRdtRecordBytes;
    Bytes datagram(length);
    for (auto& byte : datagram) byte = static_cast<std::uint8_t>(random.bits());
    const std::size_t records = rdtRecordCount(length);
    ASSERT_TRUE(records == 0 || records * 36 == length);
    Bytes again;
    for (std::size_t r = 0; r < records; ++r) {
      const RdtRecord record = parsed(datagram, r);
      again = again + written(record);
      ASSERT_TRUE(std::isfinite(rdtWrench(record, {}).f_S[0]));
    }
    ASSERT_EQ(again, records > 0 ? datagram : Bytes{});
    whole += records > 0;
  }
  EXPECT_GT(whole, 40'000) << "the damage must not be all there is";
}

}  // namespace
}  // namespace palpa::haptics

#include "apps/record/record_codec.h"

#include <gtest/gtest.h>

#include "synthetic_session.h"

namespace palpa::record {
namespace {

Bytes someBytes(std::size_t size) {
  Bytes bytes(size);
  for (std::size_t i = 0; i < size; ++i) bytes[i] = static_cast<std::uint8_t>(splitMix64(i));
  return bytes;
}

TEST(ColumnCodec, TransposesBytes) {
  EXPECT_EQ(transposed(Bytes{1, 2, 3, 4, 5, 6}, 3), (Bytes{1, 4, 2, 5, 3, 6}));
}

TEST(ColumnCodec, RoundTripsEverySize) {
  for (const std::size_t record_size : {1u, 7u, 304u}) {
    for (const std::size_t count : {1u, 2u, 199u, 200u}) {
      const Bytes bytes = someBytes(record_size * count);
      const auto back = unpackRecords(packRecords(bytes, record_size), record_size, count);
      ASSERT_TRUE(back.has_value());
      EXPECT_EQ(*back, bytes);
    }
  }
}

TEST(ColumnCodec, RefusesDamagedShortAndLongBlobs) {
  const Bytes bytes = someBytes(3000);
  const Bytes blob = packRecords(bytes, 300);
  EXPECT_FALSE(unpackRecords(blob, 300, 9).has_value());
  EXPECT_FALSE(unpackRecords(blob, 300, 11).has_value());
  EXPECT_FALSE(unpackRecords(ByteView(blob).first(blob.size() - 1), 300, 10).has_value());
  EXPECT_FALSE(unpackRecords({}, 300, 10).has_value());
  Bytes longer = blob;
  longer.push_back(0);
  EXPECT_FALSE(unpackRecords(longer, 300, 10).has_value());
  for (std::size_t i = 0; i < blob.size(); i += 37) {
    Bytes flipped = blob;
    flipped[i] ^= 0x10;
    const auto back = unpackRecords(flipped, 300, 10);
    EXPECT_TRUE(!back || *back == bytes) << "byte " << i;
  }
}

TEST(ColumnCodec, SmoothTicksPackBetterAsColumns) {
  std::vector<haptics::FlightRecord> ticks;
  for (std::int64_t i = 0; i < 200; ++i) ticks.push_back(test::syntheticTick(i));
  const ByteView bytes = bytesOf(ticks.data(), ticks.size());
  const std::size_t columns = packRecords(bytes, sizeof(ticks[0])).size();
  const std::size_t rows = packRecords(bytes, bytes.size()).size();  // one record: no transposing
  EXPECT_LT(columns, rows);
  EXPECT_LT(columns, bytes.size() / 2);  // the noise alone, 10 doubles in 264 bytes, is a quarter
}

TEST(RowChecksum, TellsColumnsApart) {
  EXPECT_NE(rowChecksum(std::string_view("ab"), std::string_view("c")),
            rowChecksum(std::string_view("a"), std::string_view("bc")));
  EXPECT_EQ(rowChecksum(0.0), rowChecksum(-0.0));  // SQLite keeps no sign of zero
}

}  // namespace
}  // namespace palpa::record

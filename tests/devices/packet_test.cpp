#include "haptics/devices/falcon/falcon_protocol.h"

#include <gtest/gtest.h>

#include <vector>

#include "anatomy/base/random.h"
#include "falcon_twin.h"

namespace palpa::haptics {
namespace {

using test::Bytes;

/// Reports in `stream`, in order.
std::vector<FalconReport> reports(FalconParser& parser, const Bytes& stream) {
  std::vector<FalconReport> found;
  for (const std::uint8_t byte : stream)
    if (const auto report = parser.push(byte)) found.push_back(*report);
  return found;
}

test::TwinReply randomReply(RandomStream& random) {
  const std::uint64_t bits = random.bits();
  const auto number = [&](int shift) { return static_cast<std::int16_t>(bits >> shift); };
  return {{number(0), number(16), number(32)},
          static_cast<std::uint8_t>(bits >> 48 & 0xF),
          static_cast<std::uint8_t>(bits >> 52 & 7)};
}

void expectSame(const FalconReport& got, const test::TwinReply& sent) {
  EXPECT_EQ(got.encoder, sent.encoder);
  EXPECT_EQ(got.buttons, sent.buttons);
  EXPECT_EQ(got.homed, sent.homed);
}

TEST(FalconPacket, KnownCommandKnownBytes) {
  const FalconCommand command{{1, -1, 0x1234}, kFalconHoming | kFalconRed};
  const FalconPacket wanted{0x3C, 0x42, 0x41, 0x41, 0x41, 0x50, 0x50, 0x50,
                            0x50, 0x45, 0x44, 0x43, 0x42, 0x4A, 0x41, 0x3E};
  EXPECT_EQ(encode(command), wanted);
}

TEST(FalconPacket, CommandsAreReadAsTheyWereMeant) {
  for (int count = -32768; count <= 32767; ++count) {
    const auto motor = static_cast<std::int16_t>(count);
    const auto flags = static_cast<std::uint8_t>(count & 0xF);
    const auto read = test::readCommand(encode({{motor, 0, motor}, flags}));
    ASSERT_TRUE(read);
    ASSERT_EQ(read->motor, (std::array<std::int16_t, 3>{motor, 0, motor}));
    ASSERT_EQ(read->flags, flags);
  }
}

TEST(FalconParser, ReportsAreReadAsTheyWereSent) {
  RandomStream random(1, "falcon reports");
  FalconParser parser;
  for (int i = 0; i < 5000; ++i) {
    const test::TwinReply sent = randomReply(random);
    const auto found = reports(parser, test::writeReply(sent));
    ASSERT_EQ(found.size(), 1u);
    expectSame(found[0], sent);
  }
  EXPECT_EQ(parser.skipped(), 0u);
}

TEST(FalconParser, CutAtEveryByteThePacketsAfterTheCutAreFound) {
  RandomStream random(2, "falcon cuts");
  for (std::size_t cut = 0; cut <= kFalconPacketSize; ++cut) {
    FalconParser parser;
    Bytes stream = test::writeReply(randomReply(random));
    stream.resize(cut);  // the rest never comes
    const test::TwinReply a = randomReply(random), b = randomReply(random);
    for (const auto& reply : {a, b}) {
      const Bytes more = test::writeReply(reply);
      stream.insert(stream.end(), more.begin(), more.end());
    }
    const auto found = reports(parser, stream);
    const bool whole = cut == kFalconPacketSize;
    ASSERT_EQ(found.size(), whole ? 3u : 2u) << cut;
    expectSame(found[found.size() - 2], a);
    expectSame(found.back(), b);
    EXPECT_EQ(parser.skipped(), whole ? 0u : cut);
  }
}

TEST(FalconParser, GarbageBetweenPacketsIsCountedAndCostsNone) {
  RandomStream random(3, "falcon garbage");
  FalconParser parser;
  std::uint64_t garbage = 0;
  for (int i = 0; i < 2000; ++i) {
    const std::size_t length = random.bits() % 40;
    for (std::size_t k = 0; k < length; ++k) {
      // Frame bytes much more often than by chance, no values: a value could finish a packet.
      const std::uint8_t byte = "<>\x01\x40\xFF"[random.bits() % 5];
      EXPECT_FALSE(parser.push(byte));
    }
    garbage += length;
    const test::TwinReply sent = randomReply(random);
    const auto found = reports(parser, test::writeReply(sent));
    ASSERT_EQ(found.size(), 1u) << i;
    expectSame(found[0], sent);
    ASSERT_EQ(parser.skipped(), garbage);
  }
}

TEST(FalconParser, AfterAnyBytesItFindsThePacketsAgain) {
  int longest_wait = 0;
  for (std::uint64_t seed = 0; seed < 100'000; ++seed) {
    RandomStream random(seed, "falcon fuzz");
    FalconParser parser;
    const std::size_t length = random.bits() % 70;
    const bool near = random.bits() & 1;  // every second run looks much like packets
    for (std::size_t k = 0; k < length; ++k)
      parser.push(static_cast<std::uint8_t>(near ? 0x3C + random.bits() % 24 : random.bits()));
    const test::TwinReply sent = randomReply(random);
    int wait = 0;
    for (bool found = false; !found && wait < 5;) {
      ++wait;
      for (const FalconReport& report : reports(parser, test::writeReply(sent)))
        found = report.encoder == sent.encoder && report.homed == sent.homed;
    }
    longest_wait = std::max(longest_wait, wait);
  }
  EXPECT_LE(longest_wait, 2);
}

TEST(FalconParser, EveryByteIsEitherInAReportOrSkipped) {
  for (std::uint64_t seed = 0; seed < 2000; ++seed) {
    RandomStream random(seed, "falcon count");
    FalconParser parser;
    std::uint64_t pushed = 0, used = 0;
    for (; pushed < 300; ++pushed)
      used += parser.push(static_cast<std::uint8_t>(0x3C + random.bits() % 12)) ? 16 : 0;
    parser.forget();
    EXPECT_EQ(parser.skipped() + used, pushed);
  }
}

}  // namespace
}  // namespace palpa::haptics

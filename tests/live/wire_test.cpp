#include "apps/live/wire.h"

#include <gtest/gtest.h>

#include <vector>

#include "tests/support/counts.h"
#include "tests/support/damage.h"

namespace palpa::live {
namespace {

std::vector<LiveFrame> framesIn(FrameDecoder& decoder) {
  std::vector<LiveFrame> all;
  while (auto frame = decoder.next()) all.push_back(*frame);
  return all;
}

std::string bodyOf(std::size_t size, test::DamageDice& dice) {
  std::string body(size, '\0');
  for (char& c : body) c = static_cast<char>(dice.below(256));
  return body;
}

/// A frame whose head promises `length`.
std::string headOf(char kind, std::uint32_t length) {
  std::string head(1, kind);
  for (int shift = 0; shift < 32; shift += 8)
    head.push_back(static_cast<char>(length >> shift & 0xff));
  return head;
}

constexpr std::pair<FrameKind, std::size_t> kKinds[] = {{FrameKind::entry, kLongestEntry},
                                                        {FrameKind::picture, kLongestPicture},
                                                        {FrameKind::command, kLongestCommand},
                                                        {FrameKind::known, kLongestCount},
                                                        {FrameKind::watch, 1}};

TEST(Wire, WhatGoesInComesOutUpToTheLongest) {
  test::DamageDice dice(1);
  for (const auto& [kind, longest] : kKinds)
    for (const std::size_t size : {std::size_t{0}, std::size_t{1}, longest / 2, longest}) {
      FrameDecoder decoder;
      const std::string body = bodyOf(size, dice), bytes = encoded(kind, body);
      decoder.feed(bytes.data(), bytes.size());
      const auto frames = framesIn(decoder);
      ASSERT_EQ(frames.size(), 1u);
      EXPECT_EQ(frames[0].kind, kind);
      EXPECT_TRUE(frames[0].body == body);
    }
}

TEST(Wire, PiecesOfAnySizeMakeTheSameFrames) {
  test::DamageDice dice(2);
  std::string stream;
  std::vector<std::string> bodies;
  for (int i = 0; i < 50; ++i) {
    bodies.push_back(bodyOf(dice.below(300), dice));
    stream += encoded(i % 2 ? FrameKind::entry : FrameKind::picture, bodies.back());
  }
  for (const std::size_t most : {1, 2, 5, 6, 97, 100'000}) {
    FrameDecoder decoder;
    std::vector<LiveFrame> all;
    for (std::size_t at = 0; at < stream.size();) {
      const std::size_t count = std::min(most == 1 ? 1 : 1 + dice.below(most), stream.size() - at);
      decoder.feed(stream.data() + at, count);
      at += count;
      for (LiveFrame& frame : framesIn(decoder)) all.push_back(std::move(frame));
    }
    ASSERT_EQ(all.size(), bodies.size()) << most;
    for (std::size_t i = 0; i < all.size(); ++i) EXPECT_TRUE(all[i].body == bodies[i]) << i;
  }
}

TEST(Wire, OneByteTooLongIsRefusedAtItsHead) {
  for (const auto& [kind, longest] : kKinds) {
    FrameDecoder decoder;
    const std::string head =
        headOf(static_cast<char>(kind), static_cast<std::uint32_t>(longest + 1));
    decoder.feed(head.data(), head.size());
    EXPECT_THROW(decoder.next(), Error) << static_cast<char>(kind);
  }
  FrameDecoder decoder;
  const std::string head = headOf('L', 0xffffffffu);
  decoder.feed(head.data(), head.size());
  EXPECT_THROW(decoder.next(), Error);
}

TEST(Wire, AStopSaysNothingMore) {
  FrameDecoder decoder;
  const std::string bytes = encoded(FrameKind::stop, "") + headOf('S', 1);
  decoder.feed(bytes.data(), bytes.size());
  const auto stop = decoder.next();
  ASSERT_TRUE(stop);
  EXPECT_EQ(stop->kind, FrameKind::stop);
  EXPECT_THROW(decoder.next(), Error);
}

TEST(Wire, EveryOtherKindIsRefused) {
  for (int kind = 0; kind < 256; ++kind) {
    const char c = static_cast<char>(kind);
    FrameDecoder decoder;
    const std::string bytes = headOf(c, 0);
    decoder.feed(bytes.data(), bytes.size());
    if (std::string("LPCWKS").find(c) != std::string::npos)
      EXPECT_TRUE(decoder.next()) << kind;
    else
      EXPECT_THROW(decoder.next(), Error) << kind;
  }
}

/// Damaged streams end in an Error or in fewer frames; what came out before the damage is whole,
/// and nothing longer than its kind may be.
TEST(Wire, DamagedStreamsNeverBreakTheDecoder) {
  test::DamageDice dice(3);
  for (int round = 0; round < test::counted(2000, 100'000); ++round) {
    std::string stream;
    for (int i = 0; i < 8; ++i)
      stream += encoded(static_cast<FrameKind>("LCWK"[dice.below(4)]), bodyOf(dice.below(2), dice));
    for (std::size_t hits = 1 + dice.below(4); hits > 0; --hits)
      stream[dice.below(stream.size())] ^= static_cast<char>(1u << dice.below(8));
    if (dice.below(3) == 0) stream.resize(dice.below(stream.size()));
    FrameDecoder decoder;
    std::size_t got = 0;
    try {
      for (std::size_t at = 0; at < stream.size(); ++at) {
        decoder.feed(stream.data() + at, 1);
        for (const LiveFrame& frame : framesIn(decoder)) got += 5 + frame.body.size();
      }
    } catch (const Error&) {
    }
    EXPECT_LE(got, stream.size());
  }
}

}  // namespace
}  // namespace palpa::live

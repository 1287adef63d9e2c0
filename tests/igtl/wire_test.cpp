#include "apps/link/igtl/wire.h"

#include <gtest/gtest.h>

#include <limits>

#include "apps/link/igtl/conventions.h"
#include "library_peer.h"

/// Messages as bytes, poses in the conventions of 3D Slicer and PLUS, and what of a stream is
/// believed.
namespace palpa::igt {
namespace {

using igt_test::headerOf;
using igt_test::withMetadata;

const Pose kPose = makePose(Eigen::AngleAxisd(0.7, Vec3(1, 2, 3).normalized()).toRotationMatrix(),
                            Vec3(0.012, -0.345, 0.678));

std::vector<Message> messagesIn(MessageStream& stream, const Bytes& bytes, std::size_t piece) {
  std::vector<Message> messages;
  for (std::size_t at = 0; at < bytes.size(); at += piece) {
    stream.feed(View(bytes).subspan(at, std::min(piece, bytes.size() - at)));
    while (auto message = stream.next()) messages.push_back(std::move(*message));
  }
  return messages;
}

Bytes operator+(Bytes a, const Bytes& b) {
  a.insert(a.end(), b.begin(), b.end());
  return a;
}

TEST(IgtlConventions, MillimetresGoOutAndMetresComeBack) {
  const Mat4 X_mm = toWire(kPose);
  EXPECT_DOUBLE_EQ(X_mm(0, 3), 12);
  EXPECT_DOUBLE_EQ(X_mm(1, 3), -345);
  EXPECT_EQ(X_mm(1, 0), kPose.linear()(1, 0)) << "a rotation has no unit";
  const auto back = fromWire(X_mm);
  ASSERT_TRUE(back);
  EXPECT_TRUE(back->isApprox(kPose, 1e-12));
}

TEST(IgtlConventions, RasIsLpsWithXAndYTurned) {
  const Vec3 left_posterior_superior(0.1, 0.2, 0.3);
  EXPECT_TRUE((rasInAnatomy().inverse() * left_posterior_superior).isApprox(Vec3(-0.1, -0.2, 0.3)));
  EXPECT_GT(rasInAnatomy().linear().determinant(), 0) << "a turn, no mirror";
}

TEST(IgtlConventions, WhatIsNoPoseIsRefused) {
  const Mat4 good = toWire(kPose);
  const auto with = [&](int row, int column, double value) {
    Mat4 X = good;
    X(row, column) = value;
    return X;
  };
  EXPECT_FALSE(fromWire(with(0, 0, std::numeric_limits<double>::quiet_NaN())));
  EXPECT_FALSE(fromWire(with(2, 3, std::numeric_limits<double>::infinity())));
  EXPECT_FALSE(fromWire(with(2, 3, 2e5))) << "200 m away";
  EXPECT_FALSE(fromWire(with(3, 0, 0.5))) << "a projection";
  Mat4 scaled = good, mirrored = good;
  scaled.topLeftCorner<3, 3>() *= 1.01;
  mirrored.col(0) *= -1;
  EXPECT_FALSE(fromWire(scaled));
  EXPECT_FALSE(fromWire(mirrored));
  EXPECT_FALSE(fromWire(Mat4::Zero()));
  const auto single = fromWire(good.cast<float>().cast<double>());
  ASSERT_TRUE(single) << "single precision is what comes";
  EXPECT_NEAR(single->linear().determinant(), 1, 1e-12) << "and is made orthonormal";
}

TEST(IgtlWire, HeaderAndTransformComeBack) {
  const std::int64_t utc_ns = 1'788'000'123'456'789'012;
  const Bytes bytes = transformMessage("NeedleTipToReference", toWire(kPose), utc_ns);
  const auto read = readHeader(View(bytes).first<kHeaderSize>());
  ASSERT_TRUE(read);
  EXPECT_EQ(read->version, 1);
  EXPECT_EQ(read->type, "TRANSFORM");
  EXPECT_EQ(read->device, "NeedleTipToReference") << "twenty characters fill the field";
  EXPECT_NEAR(static_cast<double>(read->utc_ns - utc_ns), 0, 10)
      << "ns: as good as the library turns them into fractions and back";
  EXPECT_TRUE(crcFits(*read, View(bytes).subspan(kHeaderSize)));
  const auto X_mm = readTransform(View(bytes).subspan(kHeaderSize));
  ASSERT_TRUE(X_mm);
  EXPECT_LT((*X_mm - toWire(kPose)).cwiseAbs().maxCoeff(), 1e-4);
}

TEST(IgtlWire, TrackingRequestComesBack) {
  const Bytes bytes = startTrackingMessage("Palpa", {40, "Reference"}, 0);
  const auto request = readTrackingRequest(View(bytes).subspan(kHeaderSize));
  ASSERT_TRUE(request);
  EXPECT_EQ(request->resolution_ms, 40);
  EXPECT_EQ(request->coordinates, "Reference");
  EXPECT_FALSE(readTrackingRequest(View(bytes).subspan(kHeaderSize + 1)));
}

TEST(IgtlStream, MessagesComeWholeHoweverTheBytesCome) {
  const Bytes bytes =
      transformMessage("AToB", toWire(kPose), 1) + stopTrackingMessage("Q", 2) +
      trackingMessage("T", {{"AToB", toWire(kPose)}, {"CToB", Mat4::Identity()}}, 3);
  for (const std::size_t piece : {1u, 7u, 58u, 10000u}) {
    MessageStream stream;
    const auto messages = messagesIn(stream, bytes, piece);
    ASSERT_EQ(messages.size(), 3u) << piece;
    EXPECT_EQ(messages[1].header.type, "STP_TDATA");
    const auto tools = readTracking(messages[2].content);
    ASSERT_TRUE(tools && tools->size() == 2);
    EXPECT_EQ(tools->at(1).name, "CToB");
  }
}

TEST(IgtlStream, MetadataOfVersion2AreRead) {
  MessageStream stream;
  const auto messages =
      messagesIn(stream,
                 withMetadata(transformMessage("AToB", toWire(kPose), 1),
                              {{"TransformStatus", "OUT_OF_VIEW"}, {"Empty", ""}}),
                 5);
  ASSERT_EQ(messages.size(), 1u);
  EXPECT_EQ(messages[0].metadata.at("TransformStatus"), "OUT_OF_VIEW");
  EXPECT_EQ(messages[0].metadata.at("Empty"), "");
  EXPECT_TRUE(readTransform(messages[0].content));
}

TEST(IgtlStream, SizesInsideABodyAreNotBelieved) {
  const Bytes good =
      withMetadata(transformMessage("AToB", toWire(kPose), 1), {{"TransformStatus", "OK"}});
  for (std::size_t at = kHeaderSize; at < kHeaderSize + 12; ++at) {
    const Header read = *readHeader(View(good).first<kHeaderSize>());
    Bytes body(good.begin() + kHeaderSize, good.end());
    body[at - kHeaderSize] = 0xff;
    const auto content = contentOf(read, body);
    EXPECT_EQ(content.has_value(), at >= kHeaderSize + 8)
        << "byte " << at << ": sizes reach beyond the body; the message's number does not matter";
  }
  Bytes short_body(5, 0);
  EXPECT_FALSE(contentOf(*readHeader(View(good).first<kHeaderSize>()), short_body));
}

TEST(IgtlStream, WrongChecksumIsDroppedAndTheNextIsRead) {
  Bytes damaged = transformMessage("AToB", toWire(kPose), 1);
  damaged[kHeaderSize + 3] ^= 1;
  MessageStream stream;
  const auto messages =
      messagesIn(stream, damaged + transformMessage("CToB", toWire(kPose), 1), 100);
  ASSERT_EQ(messages.size(), 1u);
  EXPECT_EQ(messages[0].header.device, "CToB");
  EXPECT_EQ(stream.counts().damaged, 1u);
  EXPECT_FALSE(stream.broken());
}

TEST(IgtlStream, UnknownTypesAndPicturesArePassedOverBySize) {
  const std::uint64_t picture = 3 * MessageStream::kLargestBody;
  const Bytes bytes = headerOf("COLORT", 20) + Bytes(20, 0xab) + headerOf("IMAGE", picture) +
                      Bytes(picture, 0xcd) + headerOf("TRANSFORM", picture) + Bytes(picture, 0xef) +
                      transformMessage("AToB", toWire(kPose), 1);
  MessageStream stream;
  const auto messages = messagesIn(stream, bytes, 1000);
  ASSERT_EQ(messages.size(), 1u);
  EXPECT_EQ(stream.counts().skipped, 3u);
  EXPECT_EQ(stream.counts().messages, 1u);
}

TEST(IgtlStream, LaterVersionsArePassedOverBySize) {
  Bytes later = transformMessage("AToB", toWire(kPose), 1);
  later[1] = 3;
  MessageStream stream;
  const auto messages = messagesIn(stream, later + transformMessage("CToB", toWire(kPose), 1), 9);
  ASSERT_EQ(messages.size(), 1u);
  EXPECT_EQ(messages[0].header.device, "CToB");
  EXPECT_EQ(stream.counts().skipped, 1u);
  EXPECT_EQ(stream.counts().damaged, 0u);
  later[1] = 77;
  MessageStream nonsense;
  messagesIn(nonsense, later, 100);
  EXPECT_TRUE(nonsense.broken());
}

TEST(IgtlStream, GibibyteIsPassedOverWithoutBeingKept) {
  const std::uint64_t size = MessageStream::kLargestSkip;
  MessageStream stream;
  messagesIn(stream, headerOf("IMAGE", size), 100);
  const Bytes piece(1 << 20, 0x42);
  for (std::uint64_t sent = 0; sent < size; sent += piece.size()) {
    stream.feed(piece);
    ASSERT_FALSE(stream.next());
  }
  EXPECT_EQ(messagesIn(stream, transformMessage("AToB", toWire(kPose), 1), 50).size(), 1u);
  MessageStream larger;
  messagesIn(larger, headerOf("IMAGE", size + 1), 100);
  EXPECT_TRUE(larger.broken());
}

TEST(IgtlWire, TextTooLongForItsFieldIsCutBetweenCharacters) {
  const Bytes bytes = stringMessage("Text", std::string(65534, 'x') + "\xc3\xa4\xc3\xa4", 1);
  EXPECT_EQ(bytes.size(), kHeaderSize + 4 + 65534);
  EXPECT_TRUE(
      crcFits(*readHeader(View(bytes).first<kHeaderSize>()), View(bytes).subspan(kHeaderSize)));
  EXPECT_EQ(stringMessage("Text", "\xc3\xa4", 1).size(), kHeaderSize + 4 + 2);
}

TEST(IgtlStream, HugeBodyOrNoHeaderEndsIt) {
  MessageStream huge;
  messagesIn(huge, headerOf("TRANSFORM", ~0ull), 100);
  EXPECT_TRUE(huge.broken());
  MessageStream http;
  const std::string request =
      "GET / HTTP/1.1\r\nHost: localhost:18944\r\nUser-Agent: somebody\r\nAccept: */*\r\n\r\n";
  messagesIn(http, Bytes(request.begin(), request.end()), 100);
  EXPECT_TRUE(http.broken());
  EXPECT_FALSE(http.next());
}

TEST(IgtlStream, RandomBytesNeverBecomeMessages) {
  std::uint64_t state = 88172645463325252ull;
  const auto chance = [&] {
    return state ^= state << 13, state ^= state >> 7, state ^= state << 17;
  };
  for (int run = 0; run < 200; ++run) {
    Bytes bytes = run % 2 ? Bytes() : transformMessage("AToB", toWire(kPose), 1);
    const std::size_t from = run % 2 ? 0 : chance() % bytes.size();
    bytes.resize(400);
    for (std::size_t i = from; i < bytes.size(); ++i)
      bytes[i] = static_cast<std::uint8_t>(chance());
    MessageStream stream;
    EXPECT_EQ(messagesIn(stream, bytes, 1 + chance() % 90).size(), 0u) << run;
  }
}

}  // namespace
}  // namespace palpa::igt

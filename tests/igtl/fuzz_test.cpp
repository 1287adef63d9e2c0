#include <gtest/gtest.h>

#include <algorithm>

#include "apps/link/igtl/conventions.h"
#include "apps/link/igtl/igtl_server.h"
#include "apps/link/igtl/tracker_client.h"
#include "library_peer.h"
#include "tests/support/counts.h"
#include "tests/support/damage.h"

/// What a network may bring: sound messages with bits flipped, bytes replaced, added and lost,
/// sizes blown up; with the checksum made right afterwards, or not. Each is a message, or dropped,
/// or the end of the connection; under the sanitizers nothing else is seen either.
namespace palpa::igt {
namespace {

using test::DamageDice;

const Pose kSound = makePose(Eigen::AngleAxisd(0.7, Vec3(1, 2, 3).normalized()).toRotationMatrix(),
                             Vec3(0.012, -0.345, 0.678));

std::vector<Bytes> soundMessages() {
  const Mat4 X_mm = toWire(kSound);
  const std::vector<NamedMatrix> tools{{"AToB", X_mm}, {"ReferenceToCamera", X_mm}, {"CToB", X_mm}};
  const std::vector<std::pair<std::string, std::string>> metadata{
      {"TransformStatus", "OK"},
      {"IGTL_DEVICE_NAME", "ReferenceToCamera"},
      {"ReferenceToCameraStatus", "OK"}};
  return {transformMessage("ReferenceToCamera", X_mm, 5),
          trackingMessage("Plus", tools, 5),
          startTrackingMessage("X", {20, "Patient"}, 5),
          stopTrackingMessage("X", 5),
          statusMessage("X", "well", 5),
          stringMessage("X", "of no interest", 5),
          igt_test::withMetadata(transformMessage("ReferenceToCamera", X_mm, 5), metadata),
          igt_test::withMetadata(trackingMessage("Plus", tools, 5), metadata),
          igt_test::withMetadata(startTrackingMessage("X", {0, ""}, 5), metadata)};
}

/// Changed within [from, size): nothing where that is empty.
void spoil(Bytes& bytes, std::size_t from, DamageDice& dice) {
  static constexpr std::uint8_t kAbsurd[] = {0x00, 0xff, 0x7f, 0x80, 0x01};
  if (from >= bytes.size()) return;
  for (std::size_t i = 0, n = 1 + dice.below(6); i < n; ++i) {
    std::uint8_t& byte =
        bytes[from + dice.below(dice.below(2) ? bytes.size() - from
                                              : std::min<std::size_t>(bytes.size() - from, 16))];
    if (dice.below(2))
      byte = static_cast<std::uint8_t>(byte ^ (1 << dice.below(8)));
    else
      byte = kAbsurd[dice.below(std::size(kAbsurd))];
  }
}

/// The checksum's bytes are made right in half of the cases: what comes behind it is to be met,
/// too.
Bytes damaged(Bytes bytes, DamageDice& dice) {
  switch (dice.below(6)) {
    case 0:
      spoil(bytes, 0, dice);
      return bytes;
    case 1:
      bytes.resize(dice.below(bytes.size()));
      return bytes;
    case 2:
      bytes.insert(bytes.begin() + static_cast<std::ptrdiff_t>(dice.below(bytes.size())),
                   1 + dice.below(80), static_cast<std::uint8_t>(dice.below(256)));
      return bytes;
    default:
      spoil(bytes, kHeaderSize, dice);
      return igt_test::withChecksum(bytes);
  }
}

/// Whatever is in it, what is made of it is a pose, or nothing.
int posesIn(const Message& message) {
  int poses = 0;
  const auto look = [&](const Mat4& X_mm) {
    const auto X = fromWire(X_mm);
    if (!X) return;
    ++poses;
    ASSERT_TRUE(X->matrix().allFinite());
    ASSERT_NEAR(X->linear().determinant(), 1, 1e-9);
    ASSERT_LT((X->linear().transpose() * X->linear() - Mat3::Identity()).cwiseAbs().maxCoeff(),
              1e-9);
    ASSERT_LE(X->translation().cwiseAbs().maxCoeff(), 100);
  };
  if (const auto X_mm = readTransform(message.content)) look(*X_mm);
  if (const auto tools = readTracking(message.content))
    for (const NamedMatrix& tool : *tools) look(tool.X_mm);
  readTrackingRequest(message.content);
  return poses;
}

TEST(IgtlFuzz, DamageGivesAMessageOrNothing) {
  const std::vector<Bytes> sound = soundMessages();
  DamageDice dice(20'261'125);
  StreamCounts all;
  int broken = 0, poses = 0, whole_after = 0;
  const int cases = test::counted(60'000, 1'000'000);
  for (int i = 0; i < cases; ++i) {
    Bytes bytes;
    for (std::size_t k = 0, n = 1 + dice.below(4); k < n; ++k) {
      const Bytes piece = damaged(sound[dice.below(sound.size())], dice);
      bytes.insert(bytes.end(), piece.begin(), piece.end());
    }
    bytes.insert(bytes.end(), sound[0].begin(), sound[0].end());
    MessageStream stream;
    bool last = false;
    for (std::size_t at = 0; at < bytes.size();) {
      const std::size_t piece = std::min(bytes.size() - at, 1 + dice.below(300));
      stream.feed(View(bytes).subspan(at, piece));
      at += piece;
      while (const auto message = stream.next()) {
        ASSERT_LE(message->content.size(), MessageStream::kLargestBody);
        poses += posesIn(*message);
        last = at == bytes.size() && message->header.device == "ReferenceToCamera";
      }
    }
    whole_after += last;
    broken += stream.broken();
    all.messages += stream.counts().messages;
    all.damaged += stream.counts().damaged;
    all.skipped += stream.counts().skipped;
  }
  EXPECT_GT(poses, cases / 4) << "some damage does no harm";
  EXPECT_GT(whole_after, cases / 4)
      << "after damage that leaves sizes right the next message is read";
  EXPECT_GT(all.damaged, static_cast<std::uint64_t>(cases) / 10);
  EXPECT_GT(all.skipped, static_cast<std::uint64_t>(cases) / 20);
  EXPECT_GT(broken, cases / 20);
  test::expectLessThan2GiB();
}

TEST(IgtlFuzz, ServerGoesOnForTheOthers) {
  constexpr std::int64_t kStep_ns = 10'000'000;
  const std::vector<Bytes> sound = soundMessages();
  DamageDice dice(4711);
  IgtlServer server("127.0.0.1", 0, kSound);
  igt_test::LibraryClient good(server.port());
  ShownMoment moment;
  moment.poses = {{"NeedleTip", kSound, 5}};
  std::int64_t now_ns = 0;
  server.serve(moment, now_ns);
  for (int i = 0, n = test::counted(400, 4000); i < n; ++i) {
    os::TcpSocket bad = os::TcpSocket::connecting("127.0.0.1", server.port());
    ASSERT_EQ(bad.connected(2000), os::TcpSocket::Progress::done);
    for (std::size_t k = 0, messages = 1 + dice.below(5); k < messages; ++k) {
      bad.send(damaged(sound[dice.below(sound.size())], dice));
      if (dice.below(2)) server.serve(moment, now_ns += kStep_ns);
    }
    server.show(moment);
    server.serve(moment, now_ns += kStep_ns);
    if (i % 50 != 0) continue;
    const auto heard = good.all();
    ASSERT_TRUE(igt_test::lastOf(heard, "NeedleTipToReference")) << i;
    for (const igt_test::Got& message : heard) ASSERT_TRUE(message.whole) << message.type;
  }
  for (int i = 0; i < 3; ++i) server.serve(moment, now_ns += kStep_ns);
  EXPECT_EQ(server.peers(), 1u) << "who has gone is forgotten";
}

TEST(IgtlFuzz, TrackerTakesPosesOnly) {
  struct HandClock final : runtime::Clock {
    std::int64_t t_ns = runtime::kSecond;
    std::int64_t now() const noexcept override { return t_ns; }
  } clock;
  const std::vector<Bytes> sound = soundMessages();
  DamageDice dice(815);
  os::TcpListener plus("127.0.0.1", 0);
  runtime::EventQueue<runtime::TrackedPose> poses{64};
  TrackerClient client(
      {"127.0.0.1", plus.port(), "ReferenceToCamera", Pose::Identity(), Pose::Identity(), 0, 0},
      clock, poses);
  os::TcpSocket peer;
  int taken = 0;
  for (int i = 0, n = test::counted(1500, 20'000); i < n; ++i) {
    if (os::TcpSocket next = plus.accept(); next.open()) peer = std::move(next);
    const Bytes& message = sound[dice.below(sound.size())];
    peer.send(dice.below(4) ? damaged(message, dice) : message);
    client.step(clock.t_ns);
    clock.t_ns += 200 * runtime::kMillisecond;
    for (runtime::TrackedPose pose; poses.pop(&pose); ++taken) {
      ASSERT_TRUE(pose.X_CW.matrix().allFinite());
      ASSERT_NEAR(pose.X_CW.linear().determinant(), 1, 1e-9);
    }
  }
  const TrackerCounts counts = client.counts();
  EXPECT_GT(taken, 50);
  EXPECT_GT(counts.connections, 10u) << "again and again";
  EXPECT_GT(counts.damaged + counts.not_rigid + counts.unusable, 20u);
}

}  // namespace
}  // namespace palpa::igt

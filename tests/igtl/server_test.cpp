#include "apps/link/igtl/igtl_server.h"

#include <gtest/gtest.h>
#include <igtlUnit.h>

#include <atomic>
#include <thread>

#include "anatomy/base/error.h"
#include "apps/link/igtl/conventions.h"
#include "library_peer.h"

/// The server on loopback, listened to by the library's own client. One thread: what is sent waits
/// in the connection until it is read.
namespace palpa::igt {
namespace {

using igt_test::countOf;
using igt_test::Got;
using igt_test::lastOf;
using igt_test::LibraryClient;

constexpr std::int64_t kMs = 1'000'000, kUtc = 1'788'000'000'250'000'000;
const Pose kX_WA =
    makePose(Eigen::AngleAxisd(-1.2, Vec3::UnitX()).toRotationMatrix(), Vec3(0.01, 0.2, 0.1));
const Pose kX_WT = makePose(Eigen::AngleAxisd(0.7, Vec3(1, 2, 3).normalized()).toRotationMatrix(),
                            Vec3(0.012, -0.345, 0.678));

ShownMoment momentAt(std::int64_t t_ns) {
  ShownMoment moment;
  moment.utc_ns = kUtc + t_ns;
  moment.poses = {{"NeedleTip", kX_WT, kUtc + t_ns}, {"Camera", kX_WA, kUtc + t_ns - 40 * kMs}};
  moment.forces = {{"NeedleContactForce", Vec3(0.5, -1.25, 2)}};
  moment.lengths_mm = {{"NeedleDepth", 12.5}};
  return moment;
}

class IgtlServerTest : public ::testing::Test {
 protected:
  void serve(int times = 1, bool show = true) {
    for (int i = 0; i < times; ++i, now_ns_ += 10 * kMs) {
      if (show) server_.show(momentAt(now_ns_));
      server_.serve(momentAt(now_ns_), now_ns_);
    }
  }

  std::int64_t now_ns_ = 0;
  IgtlServer server_{"127.0.0.1", 0, kX_WA};
};

void expectPose(const Mat4& X_mm, const Pose& X, const std::string& what) {
  EXPECT_LT((X_mm - toWire(X)).cwiseAbs().maxCoeff(), 1e-4) << what << "\n" << X_mm;
}

TEST_F(IgtlServerTest, PosesComeInMillimetresWithNameAndTime) {
  LibraryClient slicer(server_.port());
  ASSERT_TRUE(slicer.connected());
  serve();  // accepts
  now_ns_ = 70 * kMs;
  serve();
  const auto messages = slicer.all();
  for (const Got& m : messages) EXPECT_TRUE(m.whole) << m.type << " " << m.device;
  const auto tip = lastOf(messages, "NeedleTipToReference");
  ASSERT_TRUE(tip);
  EXPECT_EQ(tip->type, "TRANSFORM");
  EXPECT_EQ(tip->header_version, 1);
  expectPose(tip->X_mm, kX_WT, "tip");
  EXPECT_NEAR(static_cast<double>(tip->utc_ns - kUtc - 70 * kMs), 0, 20);
  const auto camera = lastOf(messages, "CameraToReference");
  ASSERT_TRUE(camera);
  EXPECT_NEAR(static_cast<double>(camera->utc_ns - kUtc - 30 * kMs), 0, 20)
      << "each pose has a time of its own";
}

TEST_F(IgtlServerTest, AnatomyIsRas) {
  LibraryClient slicer(server_.port());
  serve(2);
  const auto messages = slicer.all();
  const auto to_ras = lastOf(messages, "ReferenceToRas"),
             to_reference = lastOf(messages, "PatientToReference");
  ASSERT_TRUE(to_ras && to_reference);
  const Vec3 left_posterior_superior(0.03, -0.04, 0.05);
  const Vec3 p_W = kX_WA * left_posterior_superior;
  const Vec3 ras_mm =
      (to_ras->X_mm * Eigen::Vector4d(1e3 * p_W.x(), 1e3 * p_W.y(), 1e3 * p_W.z(), 1)).head<3>();
  EXPECT_TRUE(ras_mm.isApprox(Vec3(-30, 40, 50), 1e-5)) << ras_mm.transpose();
  EXPECT_TRUE((to_ras->X_mm * to_reference->X_mm).isApprox(Mat4::Identity(), 1e-4));
}

TEST_F(IgtlServerTest, ForcesSayTheirUnit) {
  LibraryClient slicer(server_.port());
  serve(2);
  const auto messages = slicer.all();
  const auto force = lastOf(messages, "NeedleContactForce"),
             depth = lastOf(messages, "NeedleDepth");
  ASSERT_TRUE(force && depth);
  EXPECT_EQ(force->values, (std::vector<double>{0.5, -1.25, 2})) << "doubles on the wire";
  EXPECT_EQ(depth->values, std::vector<double>{12.5});
  igtl::Unit::Pointer newton = igtl::Unit::New(), millimetre = igtl::Unit::New();
  newton->SetPrefix(igtl::Unit::SI_PREFIX_NONE);
  newton->Append(igtl::Unit::SI_DERIVED_NEWTON, 1);
  millimetre->SetPrefix(igtl::Unit::SI_PREFIX_MILLI);
  millimetre->Append(igtl::Unit::SI_BASE_METER, 1);
  EXPECT_EQ(force->unit, newton->Pack());
  EXPECT_EQ(depth->unit, millimetre->Pack());
}

TEST_F(IgtlServerTest, EventsComeInOrderAndTheLastingOneIsToldToLatecomers) {
  LibraryClient early(server_.port());
  serve();
  for (int i = 0; i < 20; ++i) server_.say("PalpaEvent", std::to_string(i), kUtc + i);
  server_.say("PalpaPhase", "Phase \xc3\xa4", kUtc, true);
  LibraryClient late(server_.port());
  serve();
  std::vector<std::string> heard;
  for (const Got& m : early.all())
    if (m.device == "PalpaEvent") heard.push_back(m.text);
  ASSERT_EQ(heard.size(), 20u);
  EXPECT_EQ(heard.front(), "0");
  EXPECT_EQ(heard.back(), "19");
  const auto messages = late.all();
  const auto phase = lastOf(messages, "PalpaPhase");
  ASSERT_TRUE(phase);
  EXPECT_EQ(phase->text, "Phase \xc3\xa4");
  EXPECT_EQ(phase->encoding, 106) << "UTF-8";
  EXPECT_FALSE(lastOf(messages, "PalpaEvent")) << "what happened before is over";
}

TEST_F(IgtlServerTest, TrackingDataComeFromStartToStopAtTheirResolution) {
  LibraryClient asks(server_.port()), listens(server_.port());
  serve();
  asks.all();
  asks.startTracking(50, "Reference");
  serve(50, false);  // half a second
  const auto started = asks.all();
  const auto answer = lastOf(started, "Palpa");
  ASSERT_TRUE(answer);
  EXPECT_EQ(countOf(started, "RTS_TDATA"), 1);
  EXPECT_GE(countOf(started, "TDATA"), 9);
  EXPECT_LE(countOf(started, "TDATA"), 10) << "no more often than every 50 ms";
  const auto& both = started.back();
  ASSERT_EQ(both.tools.size(), 2u) << "several tools in one message";
  expectPose(both.tools.at("NeedleTip"), kX_WT, "tip");
  EXPECT_EQ(countOf(listens.all(), "TDATA"), 0) << "another client, who has not asked";
  asks.stopTracking();
  serve(20, false);
  const auto stopped = asks.all();
  EXPECT_EQ(countOf(stopped, "TDATA"), 0);
  EXPECT_EQ(countOf(stopped, "RTS_TDATA"), 1);
}

TEST_F(IgtlServerTest, TrackingDataInAnatomyAndInWhatIsNotKnown) {
  LibraryClient asks(server_.port());
  serve();
  asks.all();
  asks.startTracking(0, "Patient");
  serve(1, false);
  auto messages = asks.all();
  ASSERT_EQ(countOf(messages, "TDATA"), 1);
  expectPose(messages.back().tools.at("NeedleTip"), (kX_WA * rasInAnatomy()).inverse() * kX_WT,
             "tip in RAS");
  asks.stopTracking();
  serve(1, false);
  asks.all();
  asks.startTracking(20, "Moon");
  serve(10, false);
  messages = asks.all();
  ASSERT_EQ(messages.size(), 1u);
  EXPECT_EQ(messages[0].answer, 1) << "refused";
}

TEST_F(IgtlServerTest, RequestsOfVersion2AreUnderstood) {
  LibraryClient plus(server_.port());
  serve();
  plus.all();
  plus.send(igt_test::withMetadata(startTrackingMessage("Plus", {20, ""}, 0), {{"Who", "PLUS"}}));
  serve(10, false);
  EXPECT_GE(countOf(plus.all(), "TDATA"), 4);
}

TEST_F(IgtlServerTest, StatusIsAnswered) {
  LibraryClient asks(server_.port());
  serve();
  asks.all();
  igtl::GetStatusMessage::Pointer question = igtl::GetStatusMessage::New();
  asks.ask(*question);
  serve(1, false);
  EXPECT_EQ(countOf(asks.all(), "STATUS"), 1);
}

TEST_F(IgtlServerTest, GarbageEndsOnlyWhoSendsIt) {
  LibraryClient good(server_.port()), bad(server_.port());
  serve();
  EXPECT_EQ(server_.peers(), 2u);
  bad.send(Bytes(5000, 0x5a));
  serve(3);
  EXPECT_EQ(server_.peers(), 1u);
  good.all();
  Bytes damaged = startTrackingMessage("X", {10, ""}, 0);
  damaged.back() ^= 1;
  good.send(damaged);
  serve(3);
  EXPECT_EQ(countOf(good.all(), "TDATA"), 0) << "a wrong checksum asks for nothing";
  good.startTracking(10, "");
  serve(3);
  EXPECT_GT(countOf(good.all(), "TDATA"), 0) << "but the next request is heard";
}

TEST_F(IgtlServerTest, WhoHangsUpInTheMiddleIsForgotten) {
  auto leaves = std::make_unique<LibraryClient>(server_.port());
  LibraryClient stays(server_.port());
  serve();
  const Bytes request = startTrackingMessage("X", {10, ""}, 0);
  leaves->send(Bytes(request.begin(), request.begin() + 70));  // header and a part of the body
  serve();
  leaves.reset();
  serve(5);
  EXPECT_EQ(server_.peers(), 1u);
  stays.all();
  serve(2);
  EXPECT_TRUE(lastOf(stays.all(), "NeedleTipToReference"));
}

TEST_F(IgtlServerTest, SlowReaderCostsNoTimeAndGetsTheNewest) {
  LibraryClient slow(server_.port());
  serve();
  const int kMoments = 20'000;
  for (int i = 0; i < kMoments; ++i) {  // more than any connection's buffers hold
    server_.say("PalpaEvent", std::string(200, 'x'), kUtc);
    serve();
  }
  EXPECT_EQ(server_.peers(), 0u) << "200 s without taking anything: given up";
  EXPECT_GT(server_.lostEvents(), 1000u);
}

TEST_F(IgtlServerTest, WhoReadsAgainGetsTheNewestState) {
  LibraryClient slow(server_.port());
  serve();
  for (int i = 0; i < 2500; ++i) {  // 25 s
    for (int k = 0; k < 4; ++k) server_.say("PalpaEvent", std::string(1000, 'x'), kUtc);
    serve();
  }
  ASSERT_EQ(server_.peers(), 1u);
  std::atomic<bool> stop{false};
  std::thread serving([&] {
    while (!stop) server_.serve(momentAt(now_ns_), now_ns_), std::this_thread::yield();
  });
  const auto messages = slow.all();
  stop = true;
  serving.join();
  const auto tip = lastOf(messages, "NeedleTipToReference");
  ASSERT_TRUE(tip);
  EXPECT_NEAR(static_cast<double>(tip->utc_ns - kUtc - (now_ns_ - 10 * kMs)), 0, 20)
      << "the last moment that was shown, none of those that waited";
  for (const Got& m : messages) EXPECT_TRUE(m.whole) << "no message is cut";
}

TEST_F(IgtlServerTest, HugeBodiesAreNeitherKeptNorWaitedFor) {
  LibraryClient good(server_.port()), promises(server_.port()), lies(server_.port());
  serve();
  promises.send(
      igt_test::headerOf("IMAGE", 1ull << 30));  // 1 GiB: passed over as it comes, if ever
  lies.send(igt_test::headerOf("STT_TDATA", (1ull << 30) + 1));  // no OpenIGTLink
  promises.send(Bytes(100'000, 0x11));
  serve(5);
  EXPECT_EQ(server_.peers(), 2u);
  promises.all();
  promises.startTracking(10, "");
  good.all();
  serve(5);
  EXPECT_EQ(countOf(promises.all(), "TDATA"), 0) << "what comes is a part of the picture";
  EXPECT_TRUE(lastOf(good.all(), "NeedleTipToReference"));
}

TEST_F(IgtlServerTest, RequestsOfALaterVersionArePassedOver) {
  LibraryClient asks(server_.port());
  serve();
  Bytes later = startTrackingMessage("X", {10, ""}, 0);
  later[1] = 3;
  asks.all();
  asks.send(later);
  serve(3, false);
  EXPECT_EQ(asks.all().size(), 0u);
  asks.startTracking(10, "");
  serve(3, false);
  EXPECT_GT(countOf(asks.all(), "TDATA"), 0) << "the next is understood";
}

TEST_F(IgtlServerTest, WhoComesBackIsServedAnew) {
  server_.say("PalpaPhase", "inserted", kUtc, true);
  for (int visit = 0; visit < 20; ++visit) {
    LibraryClient slicer(server_.port());
    ASSERT_TRUE(slicer.connected());
    serve(3);
    const auto messages = slicer.all();
    EXPECT_TRUE(lastOf(messages, "NeedleTipToReference")) << visit;
    EXPECT_TRUE(lastOf(messages, "PalpaPhase")) << visit;
    EXPECT_EQ(countOf(messages, "TDATA"), 0) << "what an earlier one asked for is over";
    slicer.startTracking(10, "");
    serve(2);
  }
  serve(2);
  EXPECT_EQ(server_.peers(), 0u);
  EXPECT_EQ(server_.everConnected(), 20u);
}

TEST_F(IgtlServerTest, NoTrackingDataWhereNothingIsKnown) {
  LibraryClient asks(server_.port());
  serve();
  asks.all();
  asks.startTracking(10, "");
  for (int i = 0; i < 5; ++i, now_ns_ += 10 * kMs) server_.serve(ShownMoment{}, now_ns_);
  const auto messages = asks.all();
  EXPECT_EQ(countOf(messages, "RTS_TDATA"), 1);
  EXPECT_EQ(countOf(messages, "TDATA"), 0) << "one without tools would be taken for damage";
}

TEST_F(IgtlServerTest, NinthIsTurnedAway) {
  std::vector<std::unique_ptr<LibraryClient>> clients;
  for (std::size_t i = 0; i <= IgtlServer::kMostPeers; ++i)
    clients.push_back(std::make_unique<LibraryClient>(server_.port()));
  serve(2);
  EXPECT_EQ(server_.peers(), IgtlServer::kMostPeers);
  EXPECT_TRUE(clients.front()->next());
  EXPECT_FALSE(clients.back()->next());
}

TEST(IgtlServerPlace, PortThatIsTakenAndAddressThatIsNoneAreRefusedInWords) {
  const IgtlServer first("127.0.0.1", 0, Pose::Identity());
  EXPECT_THROW(IgtlServer("127.0.0.1", first.port(), Pose::Identity()), Error);
  EXPECT_THROW(IgtlServer("my.computer", 0, Pose::Identity()), UsageError);
}

TEST(IgtlServerPlace, SamePortServesAgainAtOnce) {
  std::uint16_t port = 0;
  std::unique_ptr<LibraryClient> client;
  for (int session = 0; session < 3; ++session) {
    IgtlServer server("127.0.0.1", port, Pose::Identity());
    port = server.port();
    client = std::make_unique<LibraryClient>(port);
    for (std::int64_t t = 0; t < 3; ++t) server.show(momentAt(t)), server.serve(momentAt(t), t);
    EXPECT_TRUE(lastOf(client->all(), "NeedleTipToReference")) << session;
  }
}

}  // namespace
}  // namespace palpa::igt

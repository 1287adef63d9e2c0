#include "haptics/sensors/net_ft_sensor.h"

#include <gtest/gtest.h>

#include <cmath>
#include <memory>

#include "anatomy/base/random.h"
#include "fake_net_ft.h"

namespace palpa::haptics {
namespace {

constexpr std::int64_t kMs = 1'000'000;

NetFtSettings settingsFor(const FakeNetFt& server) {
  NetFtSettings s;
  s.address = "127.0.0.1";
  s.port = server.port();
  s.wait_ms = 5000;  // a step ends when its datagram is there
  s.scale = {1000, 2000};
  return s;
}

/// A sensor whose clock the test sets, and its server.
struct Bench {
  FakeNetFt server;
  std::atomic<std::int64_t> now{kMs};
  NetFtSensor sensor;

  explicit Bench(int wait_ms = 5000, const NetFtSettings& more = {})
      : sensor(completed(more, wait_ms), [this] { return now.load(); }) {
    sensor.start();
  }
  NetFtSettings completed(const NetFtSettings& more, int wait_ms) const {
    NetFtSettings s = settingsFor(server);
    s.wait_ms = wait_ms;
    s.saturation_bits = more.saturation_bits;
    s.capabilities = more.capabilities;
    return s;
  }
  WrenchSample deliver(const Bytes& datagram) {
    server.send(datagram);
    sensor.step();
    return sensor.read(now);
  }
  std::array<std::uint64_t, kNetFtCounts> counts() const {
    std::array<std::uint64_t, kNetFtCounts> all{};
    for (std::size_t i = 0; i < kNetFtCounts; ++i)
      all[i] = sensor.count(static_cast<NetFtCount>(i));
    return all;
  }
};

using Counts = std::array<std::uint64_t, kNetFtCounts>;

TEST(NetFtSensor, BeforeTheFirstRecordThereIsNothing) {
  FakeNetFt server;
  NetFtSensor sensor(settingsFor(server), [] { return 0; });
  EXPECT_EQ(sensor.read(0).flags, kNothingYet);
  sensor.start();
  EXPECT_EQ(sensor.read(0).flags, 0u);
  EXPECT_EQ(sensor.read(0).sequence, 1u);
}

TEST(NetFtSensor, TheScriptIsCountedExactly) {
  Bench b;  // the start was answered with record 1, ft 100
  EXPECT_EQ(b.deliver(recordBytes(2, 101, 0, {1000, -2000, 500, 2000, 1, -4000})).f_S,
            (Packed3{1, -2, 0.5}));
  EXPECT_EQ(b.sensor.read(b.now).tau_S, (Packed3{1, 0.0005, -2}));
  EXPECT_EQ(b.deliver(recordBytes(5, 104)).ft_sequence, 104u);  // 3 and 4 lost
  b.deliver(recordBytes(5, 104));                               // duplicate
  b.deliver(recordBytes(4, 103));                               // late
  b.deliver(Bytes(35, 1));                                      // short
  b.deliver(Bytes{});                                           // empty
  b.deliver(Bytes(1476, 1));                                    // too long
  EXPECT_EQ(b.sensor.read(b.now).ft_sequence, 104u) << "nothing of that was taken";
  const WrenchSample faulty = b.deliver(recordBytes(6, 105, 0x80000002));
  EXPECT_EQ(faulty.status, 0x80000002u);
  EXPECT_EQ(faulty.flags, kFault);
  const WrenchSample last =
      b.deliver(recordBytes(7, 106) + recordBytes(9, 108) + recordBytes(8, 107));
  EXPECT_EQ(last.ft_sequence, 108u) << "three records in one datagram: the newest";
  EXPECT_EQ(last.flags, 0u);
  EXPECT_EQ(last.sequence, 6u);
  EXPECT_EQ(b.counts(), (Counts{6, 3, 1, 2, 3, 1, 0, 0}));
}

TEST(NetFtSensor, SaturationAndOverloadAreFlagged) {
  NetFtSettings more;
  more.saturation_bits = 0x20000;
  more.capabilities.max_force_N = {10, 10, 20};
  more.capabilities.max_torque_Nm = {0, 0, 1};
  Bench b(5000, more);
  EXPECT_EQ(b.deliver(recordBytes(2, 101, 0x20000)).flags, kFault | kSaturated);
  EXPECT_EQ(b.deliver(recordBytes(3, 102, 0, {0, -10'000, 0, 0, 0, 0})).flags, kOverload);
  EXPECT_EQ(b.deliver(recordBytes(4, 103, 0, {0, 0, 19'999, 9'000'000, 0, 0})).flags, 0u);
  EXPECT_EQ(b.deliver(recordBytes(5, 104, 0, {0, 0, 0, 0, 0, 2'000})).flags, kOverload);
}

TEST(NetFtSensor, SilenceIsJudgedByTheTimeGivenAlone) {
  Bench b;
  b.now = 50 * kMs;
  EXPECT_EQ(b.deliver(recordBytes(2, 101)).t_ns, 50 * kMs);
  EXPECT_EQ(b.sensor.read(60 * kMs).flags, 0u);
  EXPECT_EQ(b.sensor.read(60 * kMs + 1).flags, kSilent);
  EXPECT_EQ(b.sensor.read(60 * kMs + 1).ft_sequence, 101u) << "the last value stays";
  EXPECT_EQ(b.sensor.read(60 * kMs).flags, 0u);
}

TEST(NetFtSensor, ASilentSensorIsStartedAgain) {
  Bench b(1);
  b.now = 201 * kMs;
  b.sensor.step();
  EXPECT_EQ(b.sensor.count(NetFtCount::restarts), 0u) << "200 ms are not over";
  b.now = 201 * kMs + 1;
  b.sensor.step();
  EXPECT_EQ(b.sensor.count(NetFtCount::restarts), 1u);
  ASSERT_TRUE(b.server.heard(kStartBytes, 2));
  while (b.sensor.count(NetFtCount::records) < 2)
    b.sensor.step();  // the same numbers: a new stream
  EXPECT_EQ(b.sensor.read(b.now).flags, 0u);
  EXPECT_EQ(b.sensor.count(NetFtCount::duplicates), 0u);
  EXPECT_EQ(b.sensor.count(NetFtCount::restarts), 1u);
}

TEST(NetFtSensor, AServerThatVanishesAndComesBack) {
  auto server = std::make_unique<FakeNetFt>();
  const std::uint16_t port = server->port();
  std::atomic<std::int64_t> now{0};
  NetFtSettings settings = settingsFor(*server);
  settings.wait_ms = 1;
  NetFtSensor sensor(settings, [&] { return now.load(); });
  sensor.start();
  server.reset();
  for (int i = 0; i < 5; ++i) {
    now += 201 * kMs;
    sensor.step();
  }
  EXPECT_EQ(sensor.count(NetFtCount::restarts), 5u);
  EXPECT_EQ(sensor.read(now).flags, kSilent);
  server = std::make_unique<FakeNetFt>(recordBytes(1, 3), port);  // rebooted: both counters small
  now += 201 * kMs;
  while (sensor.count(NetFtCount::records) < 2) sensor.step();
  EXPECT_EQ(sensor.read(now).flags, 0u);
  EXPECT_EQ(sensor.read(now).ft_sequence, 3u);
  EXPECT_TRUE(server->heard(kStartBytes));
}

TEST(NetFtSensor, TheBiasRequestArrivesOnceAndTheStopOnClose) {
  FakeNetFt server;
  {
    NetFtSensor sensor(settingsFor(server), [] { return 0; });
    sensor.start();
    sensor.requestBias();
    for (std::uint32_t i = 2; i < 4; ++i) {
      server.send(recordBytes(i, 100 + i));
      sensor.step();
    }
    ASSERT_TRUE(server.heard(kBiasBytes));
  }
  ASSERT_TRUE(server.heard(kStopBytes));
  EXPECT_EQ(server.requests(), (std::vector<Bytes>{kStartBytes, kBiasBytes, kStopBytes}));
}

TEST(NetFtSensor, DamagedDatagramsAreSurvivedAndEachIsAccountedFor) {
  Bench b;
  RandomStream random(11, "net ft fuzz");
  std::uint64_t whole = 0, broken = 0;
  for (int i = 0; i < 20'000; ++i) {
    std::size_t length = random.bits() % 200;
    if (i % 2) length -= length % kRdtRecordBytes;
    Bytes datagram(length);
    for (auto& byte : datagram) byte = static_cast<std::uint8_t>(random.bits());
    const std::uint64_t records = length / kRdtRecordBytes;
    const bool good = length > 0 && length % kRdtRecordBytes == 0;
    whole += good ? records : 0;
    broken += !good;
    b.deliver(datagram);
  }
  const Counts c = b.counts();
  EXPECT_EQ(c[0] - 1 + c[2] + c[3], whole);
  EXPECT_EQ(b.sensor.count(NetFtCount::wrong_length), broken);
  EXPECT_EQ(b.sensor.count(NetFtCount::errors), 0u);
}

TEST(NetFtSensor, AReaderInAnotherThreadSeesWholeSamplesInOrder) {
  Bench b(1);
  constexpr std::uint32_t kLast = 2000;
  std::atomic<bool> done{false};
  std::thread stepping([&] {
    while (!done) b.sensor.step();
  });
  std::uint64_t torn = 0, back = 0;
  std::thread reading([&] {
    std::uint64_t seen = 0;
    while (seen < kLast) {
      const WrenchSample s = b.sensor.read(b.now);
      back += s.sequence < seen;
      const auto sequence = static_cast<std::int64_t>(s.sequence);
      torn += sequence > 1 &&
              (std::llround(s.f_S[0] * 1000) != sequence ||
               std::llround(s.tau_S[2] * 2000) != -sequence || s.ft_sequence != 100 + s.sequence);
      seen = s.sequence;
    }
  });
  for (std::uint32_t i = 2; i <= kLast; ++i) {
    const auto count = static_cast<std::int32_t>(i);
    b.server.send(recordBytes(i, 100 + i, 0, {count, 0, 0, 0, 0, -count}));
    while (i % 20 == 0 && b.sensor.count(NetFtCount::records) < i) std::this_thread::yield();
  }
  reading.join();
  done = true;
  stepping.join();
  EXPECT_EQ(torn, 0u);
  EXPECT_EQ(back, 0u);
  EXPECT_EQ(b.counts(), (Counts{kLast, 0, 0, 0, 0, 0, 0, 0}));
}

}  // namespace
}  // namespace palpa::haptics

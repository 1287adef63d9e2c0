#include "apps/live/port.h"

#include <gtest/gtest.h>
#include <sys/resource.h>

#include <filesystem>
#include <fstream>
#include <memory>
#include <nlohmann/json.hpp>
#include <opencv2/imgcodecs.hpp>
#include <optional>

#include "apps/live/live_session.h"
#include "peer.h"
#include "tests/support/counts.h"
#include "tests/support/damage.h"
#include "tests/support/short_folder.h"

namespace palpa::live {
namespace {

using namespace std::chrono_literals;
using nlohmann::json;

std::string newSocket() {
  static const test::ShortFolder folder;
  static int count = 0;
  return folder / std::to_string(++count);
}

/// Of this process; 0 under a sanitizer, which keeps what was freed for a while.
long residentKiB() {
  if (test::kSanitized) return 0;
  std::ifstream file("/proc/self/status");
  for (std::string word; file >> word;)
    if (word == "VmRSS:") {
      long kib = 0;
      file >> kib;
      return kib;
    }
  return 0;
}

scene::Image pictureOf(int width, int height) {
  scene::Image image{width, height, 3,
                     std::vector<std::uint8_t>(3 * static_cast<std::size_t>(width) *
                                               static_cast<std::size_t>(height))};
  test::DamageDice dice(5);
  for (auto& value : image.pixels)
    value = static_cast<std::uint8_t>(dice.below(256));  // noise: what packs worst
  return image;
}

/// A log with its port, and what was asked of it.
struct Told {
  explicit Told(std::chrono::milliseconds patience = 10s)
      : port(
            path, log, [this](const std::string& command) { hear(command); }, patience) {}
  void hear(const std::string& command) {
    if (slow) runtime::rest(2ms);
    const std::lock_guard lock(mutex);
    heard.push_back(command);
  }
  std::size_t heardCount() {
    const std::lock_guard lock(mutex);
    return heard.size();
  }
  const std::string path = newSocket();
  LiveLog log;
  std::atomic<bool> slow{false};
  std::mutex mutex;
  std::vector<std::string> heard;
  Port port;
};

void fill(LiveLog& log, int count, std::size_t size = 10) {
  for (int i = 0; i < count; ++i) log.add(std::to_string(i) + ":" + std::string(size, 'x'));
}

TEST(Port, WhoeverComesGetsAllOfTheLogInOrder) {
  Told told;
  fill(told.log, 1000);
  Peer first(told.path);
  ASSERT_TRUE(first.getsEntries(1000));
  EXPECT_EQ(first.known, "1000");
  fill(told.log, 500);
  Peer second(told.path);
  ASSERT_TRUE(first.getsEntries(1500));
  ASSERT_TRUE(second.getsEntries(1500));
  EXPECT_EQ(second.known, "1500");
  EXPECT_EQ(first.entries, told.log.since(0, 10'000));
  EXPECT_EQ(second.entries, first.entries);
}

TEST(Port, WhatIsLeftIsToldWhenTheSessionEnds) {
  auto told = std::make_unique<Told>();
  Peer peer(told->path);
  ASSERT_TRUE(eventually([&] { return !peer.known.empty() || !peer.read(); }));
  const std::string path = told->path;
  fill(told->log, 200);
  told.reset();
  EXPECT_TRUE(peer.isLeft());
  EXPECT_EQ(peer.entries.size(), 200u);
  EXPECT_FALSE(std::filesystem::exists(path));
}

/// (Whose thread hangs: HungPartSession, in tests/cli.)
TEST(Port, EndsOnceAndIsNotSilentBefore) {
  Told told;
  Peer peer(told.path);
  fill(told.log, 10);
  ASSERT_TRUE(peer.getsEntries(10));
  EXPECT_FALSE(told.port.silentFor(60s));
  EXPECT_TRUE(told.port.end());
  EXPECT_TRUE(told.port.end());
  EXPECT_TRUE(peer.isLeft());
  EXPECT_TRUE(eventually([&] { return told.port.silentFor(1ms); }));
}

/// The session goes on, what waits for that peer stays small, and in the end it is left.
TEST(Port, APeerThatNeverReadsIsLeft) {
  Told told(300ms);
  Peer stuck(told.path), reader(told.path);
  ASSERT_TRUE(stuck.sendAll(encoded(FrameKind::watch, "1")));
  const long before = residentKiB();
  const int entries = test::counted(20'000, 100'000);
  constexpr int kAtOnce = 2000;
  for (int known = kAtOnce; known <= entries; known += kAtOnce) {
    fill(told.log, kAtOnce, 200);
    ASSERT_TRUE(reader.getsEntries(static_cast<std::size_t>(known)));  // who reads is kept
  }
  ASSERT_TRUE(eventually([&] {
    return stuck.send(encoded(FrameKind::watch, "1")) < 0 && errno == EPIPE;
  })) << "it was not left";
  EXPECT_LT(
      residentKiB() - before,
      300L * entries / 1024 * 6 +
          (64 << 10));  // log, reader's copy, this test's; not another for the stuck one's queue
  fill(told.log, 10);
  EXPECT_TRUE(reader.getsEntries(static_cast<std::size_t>(entries) + 10));
}

/// A slow one that does take something now and then is kept, and gets all of it.
TEST(Port, ASlowPeerIsKept) {
  Told told(5s);
  fill(told.log, 20'000, 100);
  Peer slow(told.path);
  for (int i = 0; i < 10; ++i) {
    runtime::rest(50ms);
    ASSERT_TRUE(slow.read());
  }
  EXPECT_TRUE(slow.getsEntries(20'000));
}

TEST(Port, PicturesOnlyToWhoWatchesAndNeverAQueueOfThem) {
  Told told(60s);
  EXPECT_FALSE(told.port.wantsPicture());
  Peer watcher(told.path), stuck(told.path), other(told.path);
  for (Peer* peer : {&watcher, &stuck}) ASSERT_TRUE(peer->sendAll(encoded(FrameKind::watch, "1")));
  const long before = residentKiB();
  const int pictures = test::counted(40, 400);
  for (int i = 0; i < pictures; ++i) {
    ASSERT_TRUE(eventually([&] { return told.port.wantsPicture(); }));
    told.port.offer(pictureOf(1280, 720));
    watcher.pictures.clear();
    ASSERT_TRUE(eventually([&] { return !watcher.pictures.empty() || !watcher.read(); }));
  }
  const cv::Mat shown = cv::imdecode(
      std::vector<std::uint8_t>(watcher.pictures[0].begin(), watcher.pictures[0].end()),
      cv::IMREAD_COLOR);
  EXPECT_EQ(shown.cols, 1280);
  EXPECT_LT(residentKiB() - before,
            128 << 10);  // one such picture is 1 MB packed: the stuck one's did not pile up
  fill(told.log, 1);
  ASSERT_TRUE(other.getsEntries(1));
  EXPECT_TRUE(other.pictures.empty());
  watcher.leave();
  stuck.leave();
  EXPECT_TRUE(eventually([&] { return !told.port.wantsPicture(); }));
}

TEST(Port, APictureThatIsNoneChangesNothing) {
  Told told;
  Peer watcher(told.path);
  ASSERT_TRUE(watcher.sendAll(encoded(FrameKind::watch, "1")));
  for (scene::Image bad :
       {scene::Image{}, scene::Image{100, 100, 3, {1, 2, 3}}, scene::Image{-1, 100, 3, {1}},
        scene::Image{1, 1, 4, {1, 2, 3, 4}}, scene::Image{1 << 20, 1 << 20, 3, {1}}})
    told.port.offer(std::move(bad));
  fill(told.log, 1);
  EXPECT_TRUE(watcher.getsEntries(1));
  EXPECT_TRUE(watcher.pictures.empty());
}

TEST(Port, WhoTalksNonsenseIsLeftAndNobodyElse) {
  Told told;
  Peer good(told.path);
  test::DamageDice dice(6);
  for (int i = 0; i < test::counted(60, 1000); ++i) {
    Peer bad(told.path);
    std::string bytes(1 + dice.below(200), '\0');
    for (char& c : bytes) c = static_cast<char>(dice.below(256));
    if (i % 3 == 0) bytes = "GET / HTTP/1.1\r\nHost: localhost\r\n\r\n";
    if (i % 3 == 1) bytes = std::string("C\xff\xff\xff\x7f", 5) + bytes;  // 2 GiB promised
    if (i % 3 == 2) bytes[0] = 'X';
    bytes.resize(std::max<std::size_t>(bytes.size(), 5), 'X');
    bad.send(bytes);
    ASSERT_TRUE(bad.isLeft()) << i;
  }
  EXPECT_TRUE(good.sendAll(encoded(FrameKind::command, "{}")));
  EXPECT_TRUE(eventually([&] { return told.heardCount() == 1; }));
}

TEST(Port, EightAreHeardAndTheTwelveOthersAreLeft) {
  Told told;
  fill(told.log, 3);
  std::vector<std::unique_ptr<Peer>> crowd;
  for (int i = 0; i < 20; ++i) {
    crowd.push_back(std::make_unique<Peer>(told.path));
    eventually([&] {
      return !crowd.back()->connected() || !crowd.back()->known.empty() || !crowd.back()->read();
    });  // one after the other: the kernel's own queue is short
  }
  const auto served = [&] {
    return std::count_if(crowd.begin(), crowd.end(),
                         [](const auto& peer) { return !peer->known.empty(); });
  };
  EXPECT_EQ(served(), 8);
  for (auto& peer : crowd) EXPECT_TRUE(peer->known.empty() || peer->getsEntries(3));
  crowd.clear();
  EXPECT_TRUE(eventually([&] {
    Peer again(told.path);
    return again.getsEntries(3);
  })) << "places were not given back";
}

TEST(Port, WhoLeavesInTheMiddleOfAFrameAsksForNothing) {
  Told told;
  const std::string command = encoded(FrameKind::command, "{\"command\":\"stop\"}");
  for (std::size_t cut = 1; cut < command.size(); ++cut)
    ASSERT_TRUE(eventually([&] {  // places of those who left are given back a moment later
      Peer peer(told.path);
      return peer.sendAll(command.substr(0, cut));
    }));
  std::optional<Peer> whole;
  ASSERT_TRUE(eventually([&] {
    whole.emplace(told.path);
    return eventually([&] { return !whole->read() || !whole->known.empty(); }) &&
           !whole->known.empty();
  })) << "nobody is served any more";
  ASSERT_TRUE(whole->sendAll(command));
  ASSERT_TRUE(eventually([&] { return told.heardCount() >= 1; }));
  EXPECT_EQ(told.heardCount(), 1u);
}

/// Whoever sends without end, and faster than it is heard, holds up neither the others nor the
/// session's end.
TEST(Port, AFloodHoldsNobodyUp) {
  auto told = std::make_unique<Told>();
  told->slow = true;
  std::atomic<bool> ending{false};
  std::thread flood([&, path = told->path] {
    Peer peer(path);
    std::string many;
    for (int i = 0; i < 20; ++i) many += encoded(FrameKind::command, std::string(4000, ' '));
    while (!ending.load() && peer.sendAll(many)) {
    }
  });
  ASSERT_TRUE(eventually([&] { return told->heardCount() > 50; }));
  Peer other(told->path);
  fill(told->log, 100);
  EXPECT_TRUE(other.getsEntries(100));
  told.reset();  // returns although it still comes
  ending.store(true);
  flood.join();
}

TEST(LiveSession, WhatIsNoRequestIsToldAThousandTimesAndNoMore) {
  trial::Channels channels;
  runtime::StopSwitch stop;
  const std::string path = newSocket();
  LiveSession session(path, {"u", "paracentesis", "T017", true, false, 1}, channels, stop);
  Peer peer(path);
  std::string many;
  for (int i = 0; i < 1500; ++i) many += encoded(FrameKind::command, "{\"command\":\"<script>\"}");
  many += encoded(FrameKind::command, "{\"command\":\"stop\"}");
  ASSERT_TRUE(peer.sendAll(many));
  ASSERT_TRUE(eventually([&] { return stop.noForce(); }));
  EXPECT_EQ(stop.presses(), 1u);
  EXPECT_EQ(session.log().size(), 1001u);  // and hello
  ASSERT_TRUE(peer.getsEntries(1001));
  EXPECT_EQ(json::parse(peer.entries[0])["kind"], "hello");
  EXPECT_EQ(json::parse(peer.entries[1])["kind"], "refused");
}

/// 64 wait at most; the session does not take them, as while it is being made: the rest is lost,
/// nothing waits, nothing breaks.
TEST(LiveSession, MoreRequestsThanTheTaskTakesHurtNothing) {
  trial::Channels channels;
  runtime::StopSwitch stop;
  const std::string path = newSocket();
  LiveSession session(path, {"u", "paracentesis", "", true, false, 1}, channels, stop);
  Peer peer(path);
  std::string many;
  for (int i = 0; i < 500; ++i) many += encoded(FrameKind::command, "{\"command\":\"pause\"}");
  ASSERT_TRUE(peer.sendAll(many));
  ASSERT_TRUE(eventually([&] { return channels.console_to_task.overflows() == 500 - 64; }));
  ASSERT_TRUE(peer.sendAll(encoded(FrameKind::command, "{\"command\":\"stop\"}")));
  EXPECT_TRUE(eventually([&] { return stop.noForce(); })) << "the stop waits behind them";
  session.log().add("{}");
  EXPECT_TRUE(peer.getsEntries(2));
}

TEST(LiveSession, WordsAreToldWhenTheyChangeAtMostFiveTimesASecond) {
  trial::Channels channels;
  runtime::StopSwitch stop;
  LiveSession session(newSocket(), {"u", "t", "", true, false, 1}, channels, stop);
  trial::TrialStatus status;
  scene::Hud hud;
  for (int frame = 0; frame < 600; ++frame) {
    hud.force = std::to_string(frame);
    session.show(hud, status, frame * 16'666'667ll);  // 10 s at 60 Hz, new words in every frame
  }
  EXPECT_LE(session.log().size(), 1u + 51);
  EXPECT_GT(session.log().size(), 1u + 40);
  const std::size_t told = session.log().size();
  for (int frame = 600; frame < 1200; ++frame) session.show(hud, status, frame * 16'666'667ll);
  EXPECT_LE(session.log().size(), told + 1);
}

}  // namespace
}  // namespace palpa::live

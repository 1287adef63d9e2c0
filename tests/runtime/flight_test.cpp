#include <gtest/gtest.h>
#include <malloc.h>
#include <unistd.h>

#include <atomic>
#include <cmath>
#include <cstring>
#include <fstream>
#include <map>
#include <memory>
#include <vector>

#include "activities.h"
#include "apps/runtime/device_adapters.h"
#include "apps/runtime/haptic_activity.h"
#include "apps/runtime/recorders.h"
#include "haptics/loop/tick.h"
#include "tests/haptics/needle_bench.h"
#include "tests/support/counts.h"

/// The haptic and the recorder activity with all threads, and what the recorder got: run again, the
/// same bits. The needle dips into a block of tissue; a snapshot of it is renewed like the geometry
/// activity's.
namespace palpa::runtime {
namespace {

using haptics::NeedleBench;

class Memory final : public FlightSink {
 public:
  void beginTrial(const TrialHeader& header) override {
    log.push_back("begin " + std::to_string(header.trial));
  }
  void snapshot(const LocalGeometry& geometry) override { snapshots[geometry.number] = geometry; }
  void tick(const haptics::FlightRecord& record) override { ticks.push_back(record); }
  void keyframe(std::int64_t tick, const haptics::TickState& state) override {
    keyframes[tick] = state;
  }
  void event(const Event& event) override { log.push_back("event " + event.kind); }
  void endTrial(const TrialEnd& end) override { log.push_back("end " + end.outcome); }
  void commit() override { ++commits; }

  std::map<std::uint64_t, LocalGeometry> snapshots;
  std::map<std::int64_t, haptics::TickState> keyframes;
  std::vector<haptics::FlightRecord> ticks;
  std::vector<std::string> log;
  int commits = 0;
};

haptics::TickConfig benchConfig() {
  haptics::TickConfig config;
  config.materials = NeedleBench{}.materials;
  config.X_ET.p = {0, 0, 0.11};
  return config;
}

/// Tip from 5 mm above the skin to 30 mm below it and back, every two seconds.
haptics::DeviceReading readingAt(std::int64_t now_ns, std::uint64_t sequence) {
  const double depth = 0.0125 - 0.0175 * std::cos(3.14159265 * static_cast<double>(now_ns) * 1e-9);
  haptics::DeviceReading reading;
  reading.t_ns = now_ns;
  reading.sequence = sequence;
  reading.homed = 1;
  reading.q_DE = {0, 1, 0, 0};  // needle down
  reading.p_DE = {0, 0, 0.11 - depth};
  return reading;
}

LocalGeometry snapshotAt(std::int64_t now_ns, std::uint64_t number) {
  LocalGeometry geometry = NeedleBench{}.geometry;
  geometry.number = number;
  geometry.t_ns = now_ns;
  // Each differs a little from the last, as snapshots of a curved surface do.
  geometry.skin.p[2] = 1e-4 * std::sin(static_cast<double>(number));
  return geometry;
}

bool sameBits(const haptics::FlightRecord& a, const haptics::FlightRecord& b) {
  const auto same = [](const auto& x, const auto& y) { return std::memcmp(&x, &y, sizeof x) == 0; };
  return same(a.f_contact_D, b.f_contact_D) && same(a.f_command_D, b.f_command_D) &&
         same(a.tau_missing_D, b.tau_missing_D) && same(a.depth, b.depth) &&
         same(a.v_axial, b.v_axial) && a.events == b.events && a.phase == b.phase &&
         a.tissue == b.tissue && a.safety == b.safety && a.tick == b.tick &&
         a.snapshot == b.snapshot;
}

constexpr double kTouch = 0.5;  ///< N; skin gives way at 1.5 N
constexpr std::int64_t kGivenUp = 60'000 * kMillisecond;

/// Every activity of a session's heart on `executive`, until the sink has `last` ticks and the
/// needle has touched: a thread that waits long for its turn may miss a dip, not every one.
struct Heart {
  Heart(std::unique_ptr<Executive> e, std::size_t last)
      : executive(std::move(e)),
        bus(executive->mode()),
        device({}, executive->mode()),
        haptic(bus, device, benchConfig()),
        recorder(bus, sink),
        hand("hand",
             [this](std::int64_t now) {
               device.publish(readingAt(now, ++sequence), now);
               return now + kMillisecond;
             }),
        geometry("geometry",
                 [this](std::int64_t now) {
                   const LocalGeometry snapshot = snapshotAt(now, ++number);
                   bus.geometry_to_haptic.publish(snapshot, now + 2 * kMillisecond);
                   bus.geometry_to_recorder.push(snapshot);
                   return now + 16 * kMillisecond;
                 }),
        task("task",
             [this](std::int64_t now) {
               haptics::TickCommands commands;
               commands.armed = commands.trial = 1;
               bus.task_to_haptic.publish(commands, now);
               haptics::FlightRecord record;
               while (bus.haptic_to_task.pop(&record)) {
                 ++judged;
                 if (unpack(record.f_contact_D).norm() > 0.5) touched = true;
               }
               return now + 10 * kMillisecond;
             }),
        watch("watch", [this, last](std::int64_t now) {
          if (const ToolState* tool = bus.haptic_to_scene.read(now)) {
            backwards += tool->t_ns < last_seen;
            last_seen = tool->t_ns;
          }
          const bool enough = static_cast<std::size_t>(judged.load()) >= last && touched;
          if (enough || now > kGivenUp) executive->stop();
          return now + 5 * kMillisecond;
        }) {
    executive->add(hand, {0, false, false});
    executive->add(haptic, {1, true, false});
    executive->add(geometry, {2, false, false});
    executive->add(task, {4, false, false});
    executive->add(watch, {5, false, true});
    executive->add(recorder, {6, false, false});
  }
  void run() {
    executive->run();
    recorder.finish();
  }

  std::unique_ptr<Executive> executive;
  Bus bus;
  ChannelDevice device;
  Memory sink;
  HapticActivity haptic;
  RecorderActivity recorder;
  std::uint64_t sequence = 0, number = 0;
  std::atomic<int> judged{0};
  std::atomic<bool> touched{false};
  std::int64_t last_seen = 0;
  int backwards = 0;
  Doing hand, geometry, task, watch;
};

void expectReplayEquals(const Memory& sink) {
  const haptics::TickConfig config = benchConfig();
  haptics::TickState state = sink.keyframes.at(sink.ticks.front().tick);
  int different = 0;
  for (const haptics::FlightRecord& recorded : sink.ticks) {
    const auto snapshot = sink.snapshots.find(recorded.snapshot);
    ASSERT_TRUE(recorded.snapshot == 0 || snapshot != sink.snapshots.end())
        << "snapshot " << recorded.snapshot;
    if (const auto keyframe = sink.keyframes.find(recorded.tick);
        keyframe != sink.keyframes.end()) {
      EXPECT_EQ(keyframe->second.now.number, state.now.number);
      EXPECT_EQ(keyframe->second.contact.phase, state.contact.phase);
    }
    haptics::FlightRecord again = haptics::tick(config, state, recorded.reading,
                                                recorded.snapshot ? &snapshot->second : nullptr,
                                                recorded.commands, recorded.t_ns, recorded.sensed);
    again.late_ns = recorded.late_ns;  // the thread's, not the tick's
    different += !sameBits(recorded, again);
  }
  EXPECT_EQ(different, 0) << "of " << sink.ticks.size();
}

void expectAWholeRecord(const Heart& heart, std::size_t ticks) {
  ASSERT_GE(heart.sink.ticks.size(), ticks);
  EXPECT_EQ(heart.recorder.dropped(), 0u);
  EXPECT_EQ(heart.backwards, 0);
  for (std::size_t i = 0; i < heart.sink.ticks.size(); ++i)
    ASSERT_EQ(heart.sink.ticks[i].tick, heart.sink.ticks[0].tick + static_cast<std::int64_t>(i))
        << "none lost";
  EXPECT_EQ(heart.sink.keyframes.size(),
            (heart.sink.ticks.size() + kKeyframeTicks - 1) / kKeyframeTicks);
  double strongest = 0;
  std::uint64_t snapshots = 0;
  for (const auto& record : heart.sink.ticks) {
    strongest = std::max(strongest, unpack(record.f_contact_D).norm());
    snapshots = std::max(snapshots, record.snapshot);
  }
  EXPECT_GT(strongest, kTouch) << "the needle touched nothing";
  EXPECT_GT(snapshots, 3u);
}

TEST(Flight, OnAllThreadsTheRecordIsWholeAndRunsAgainToTheSameBits) {
  Heart heart(makeRealExecutive(), 1200);
  heart.run();
  expectAWholeRecord(heart, 1200);
  expectReplayEquals(heart.sink);
}

TEST(Flight, InVirtualTimeTooAndTwiceTheSame) {
  Heart a(makeVirtualExecutive(), 2000), b(makeVirtualExecutive(), 2000);
  a.run();
  b.run();
  expectAWholeRecord(a, 2000);
  expectReplayEquals(a.sink);
  ASSERT_EQ(a.sink.ticks.size(), b.sink.ticks.size());
  for (std::size_t i = 0; i < a.sink.ticks.size(); ++i)
    ASSERT_TRUE(sameBits(a.sink.ticks[i], b.sink.ticks[i])) << i;
}

TEST(HapticActivity, TicksStayOnTheGridAndALateOneCausesNoBurst) {
  Bus bus(TimeMode::real);
  ChannelDevice device({}, TimeMode::real);
  HapticActivity haptic(bus, device, benchConfig());
  EXPECT_EQ(haptic.step(0), 1 * kMillisecond);
  EXPECT_EQ(haptic.step(1'200'000), 2 * kMillisecond) << "a little late: back on the grid";
  EXPECT_EQ(haptic.step(7'500'000), 7'500'000) << "very late: one more at once ...";
  EXPECT_EQ(haptic.step(7'500'000), 8'500'000) << "... then the usual pace, not five in a row";
}

TEST(HapticActivity, WithoutAReadingOrCommandsThereIsNoForce) {
  Bus bus(TimeMode::real);
  ChannelDevice device({}, TimeMode::real);
  HapticActivity haptic(bus, device, benchConfig());
  for (std::int64_t t = 0; t < 100; ++t) {
    bus.geometry_to_haptic.publish(snapshotAt(t * kMillisecond, 1 + static_cast<std::uint64_t>(t)),
                                   0);
    haptic.step(t * kMillisecond);
    EXPECT_EQ(device.commanded(0), (Packed3{0, 0, 0}));
  }
}

void endsWithTheLoop(TimeMode mode) {
  ChannelDevice device({}, mode);
  const Packed3 f{0, 0, 2}, zero{0, 0, 0};
  EXPECT_EQ(device.commanded(0), zero);
  EXPECT_EQ(device.timeouts(), 0u) << "nothing was commanded yet";
  device.command(5 * kMillisecond, f);
  EXPECT_EQ(device.commanded(6 * kMillisecond), f);
  EXPECT_EQ(device.commanded(15 * kMillisecond), f);
  EXPECT_EQ(device.commanded(15 * kMillisecond + 1), zero) << "10 ms without a command";
  EXPECT_EQ(device.commanded(30 * kMillisecond), zero);
  EXPECT_EQ(device.timeouts(), 1u) << "once for the whole pause";
  device.command(31 * kMillisecond, f);
  EXPECT_EQ(device.commanded(31 * kMillisecond), f) << "the loop is back";
  EXPECT_EQ(device.commanded(60 * kMillisecond), zero);
  EXPECT_EQ(device.timeouts(), 2u);
}

TEST(ChannelDevice, TheForceEndsWhenTheLoopStopsCommanding) {
  endsWithTheLoop(TimeMode::real);
  endsWithTheLoop(TimeMode::virtual_time);
}

TEST(RecorderActivity, DrainsInOrderCommitsAndCountsWhatWasLost) {
  Bus bus(TimeMode::real);
  Memory sink;
  RecorderActivity recorder(bus, sink);
  TrialHeader header;
  header.trial = 3;
  bus.task_to_recorder.push(header);
  Event event;
  event.kind = "puncture";
  bus.task_to_recorder.push(event);
  TrialEnd end;
  end.outcome = "success";
  bus.task_to_recorder.push(end);
  for (int i = 0; i < 5; ++i) {
    haptics::FlightRecord record;
    record.tick = i;
    bus.haptic_to_recorder.push(record);
  }
  EXPECT_GT(recorder.step(0), 0);
  EXPECT_LE(recorder.step(0), 200 * kMillisecond) << "at least every 200 ticks of 1 kHz";
  EXPECT_EQ(sink.log, (std::vector<std::string>{"begin 3", "event puncture", "end success"}));
  ASSERT_EQ(sink.ticks.size(), 5u);
  for (int i = 0; i < 5; ++i) EXPECT_EQ(sink.ticks[static_cast<std::size_t>(i)].tick, i);
  EXPECT_EQ(sink.commits, 2);
  EXPECT_EQ(recorder.dropped(), 0u);
  for (int i = 0; i < 9000; ++i) bus.haptic_to_recorder.push({});
  EXPECT_EQ(recorder.dropped(), 9000u - 8192u);
}

/// Of this process in memory, bytes.
long residentBytes() {
  std::ifstream statm("/proc/self/statm");
  long size = 0, resident = 0;
  statm >> size >> resident;
  return resident * ::sysconf(_SC_PAGESIZE);
}

/// In a process of its own: the setting stays.
TEST(RecorderActivity, GivesFreeMemoryBackOnceAMinute) {
  if (test::kSanitized) GTEST_SKIP() << "a sanitizer has its own memory";
  const auto given_back = [] {
    ::mallopt(M_TRIM_THRESHOLD, 64 << 20);  // nothing goes back by itself
    Bus bus(TimeMode::real);
    Memory sink;
    RecorderActivity recorder(bus, sink);
    recorder.step(0);
    constexpr std::size_t kPiece = 50'000, kPieces = 200;
    constexpr long kMost = kPiece * kPieces / 2;
    for (const std::int64_t minute : {1, 2}) {
      std::vector<std::unique_ptr<char[]>> pieces;
      for (std::size_t i = 0; i < kPieces; ++i)
        std::memset(pieces.emplace_back(new char[kPiece]).get(), 1, kPiece);
      pieces.clear();
      const long free = residentBytes();
      recorder.step(60 * minute * kSecond - 100 * kMillisecond);
      if (residentBytes() < free - kMost) ::_exit(3);  // too early
      recorder.step(60 * minute * kSecond + 100 * kMillisecond);
      if (residentBytes() > free - kMost) ::_exit(4);
    }
    ::_exit(0);
  };
  EXPECT_EXIT(given_back(), testing::ExitedWithCode(0), "");
}

}  // namespace
}  // namespace palpa::runtime

#include "apps/session/force_guard.h"

#include <gtest/gtest.h>
#include <signal.h>
#include <sys/socket.h>
#include <unistd.h>

#include <atomic>
#include <sstream>
#include <thread>

#include "apps/os/socket.h"
#include "apps/os/worker_processes.h"
#include "apps/runtime/clock.h"
#include "tests/devices/falcon_rig.h"
#include "tests/devices/scripted_usb.h"

/// A guard beside a session that ends in order, dies, is stopped.
namespace palpa::session {
namespace {

void rest() { runtime::rest(std::chrono::milliseconds(1)); }

/// A process with the session's end of a line; it says that it is alive until somebody ends it.
class GuardedSession {
 public:
  GuardedSession() {
    if (::socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0, line_) != 0) return;
    pool_.start(0, [this](const os::Report& report) {
      ::close(line_[1]);
      report(std::to_string(os::thisProcess().began) + " " + std::to_string(os::thisProcess().pid));
      for (;;) {
        os::sendSome(line_[0], ".", 1);
        rest();
      }
    });
    os::closeSocket(line_[0]);
    std::vector<os::WorkerNews> news;
    while (news.empty()) news = pool_.await(runtime::kSecond);
    std::istringstream(news.front().lines.at(0)) >> who_.began >> who_.pid;
  }
  ~GuardedSession() {
    os::endAtOnce(process());
    while (os::runs(process())) rest();
    os::closeSocket(line_[1]);
  }
  GuardedSession(const GuardedSession&) = delete;
  GuardedSession& operator=(const GuardedSession&) = delete;
  os::ProcessId process() const { return who_; }
  int guardsEnd() const { return line_[1]; }

 private:
  int line_[2] = {-1, -1};
  os::WorkerPool pool_{1};
  os::ProcessId who_;
};

TEST(ForceGuard, SeesASessionThatDies) {
  const GuardedSession session;
  std::thread killer([&] { ::kill(session.process().pid, SIGKILL); });
  EXPECT_EQ(watchSession(session.guardsEnd(), session.process()), GuardWatch::dead);
  killer.join();
}

TEST(ForceGuard, EndsASessionThatIsStopped) {
  const GuardedSession session;
  ::kill(session.process().pid, SIGSTOP);
  EXPECT_EQ(watchSession(session.guardsEnd(), session.process()), GuardWatch::stopped);
  while (os::runs(session.process())) rest();
}

TEST(ForceGuard, LetsAloneASessionThatIsSilentAndGoesWithAFarewell) {
  int line[2];
  ASSERT_EQ(::socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0, line), 0);
  std::atomic<bool> watched{false};
  GuardWatch watch = GuardWatch::dead;
  std::thread guard([&] {
    watch = watchSession(line[1], os::thisProcess());  // runs, and says nothing
    watched = true;
  });
  runtime::rest(std::chrono::milliseconds(700));  // three silences
  EXPECT_FALSE(watched);
  os::sendSome(line[0], "..q", 3);
  guard.join();
  EXPECT_EQ(watch, GuardWatch::dismissed);
  for (const int end : line) os::closeSocket(end);
}

TEST(ForceGuard, StandsOnlyBesideTheProgramItself) {
  // Of a test: started anew it would run all tests.
  ForceGuard guard(*haptics::driverNamed("falcon"), {});
  EXPECT_FALSE(guard.stands());
  EXPECT_EQ(guard.step(0), runtime::kNever);
  EXPECT_TRUE(isGuard({"force-guard", "1", "2", "falcon", "firmware=a b.bin"}));
  EXPECT_FALSE(isGuard({"force-guard", "1", "2"}));
  EXPECT_FALSE(isGuard({"subclavian", "--fast", "--quiet"}));
}

/// Its program pushes and is gone from one packet to the next: nobody says zero.
TEST(ForceGuard, TakesAwayTheForceThatADeadProgramLeft) {
  test::FalconTwin twin{test::someImage()};
  twin.startFirmware();
  auto usb = std::make_unique<test::ScriptedUsb>(twin);
  test::ScriptedUsb& cable = *usb;
  test::FalconRig dead(std::move(usb), twin, test::someImage());
  ASSERT_TRUE(dead.reach(haptics::DriverState::ready));
  dead.f_D = {0, 0, 2};
  for (int i = 0; i < 3; ++i) dead.step();
  cable.unplug();  // of this program: the device keeps what it was told
  ASSERT_TRUE(dead.lastCommand().pushes());
  const std::size_t before = dead.heard();

  auto again = std::make_unique<test::ScriptedUsb>(twin);
  const test::ScriptedUsb& free_again = *again;
  haptics::FalconDriver driver(std::move(again), {});
  EXPECT_TRUE(takeForceAway(driver));
  ASSERT_GT(dead.heard(), before);
  for (std::size_t i = before; i < dead.heard(); ++i)
    EXPECT_FALSE(twin.commands[i].pushes()) << "packet " << i - before;
  EXPECT_EQ(free_again.closed, 1);
}

/// The kernel has not freed it yet.
class HeldUsb final : public haptics::UsbTransport {
 public:
  using Status = haptics::UsbStatus;
  explicit HeldUsb(test::FalconTwin& twin) : usb_(twin) {}
  Status open() noexcept override { return ++tries_ < 3 ? Status::busy : usb_.open(); }
  void close() noexcept override { usb_.close(); }
  Status control(const haptics::UsbControl& request, unsigned ms) noexcept override {
    return usb_.control(request, ms);
  }
  Status bulkOut(std::span<const std::uint8_t> bytes, unsigned ms) noexcept override {
    return usb_.bulkOut(bytes, ms);
  }
  Status bulkIn(std::span<std::uint8_t> into, std::size_t& got, unsigned ms) noexcept override {
    return usb_.bulkIn(into, got, ms);
  }

 private:
  test::ScriptedUsb usb_;
  int tries_ = 0;
};

TEST(ForceGuard, WaitsForADeviceThatIsNotFreeYet) {
  test::FalconTwin twin{test::someImage()};
  twin.startFirmware();
  haptics::FalconDriver driver(std::make_unique<HeldUsb>(twin), {});
  EXPECT_TRUE(takeForceAway(driver));
  ASSERT_FALSE(twin.commands.empty());
  EXPECT_FALSE(twin.commands.back().pushes());
}

}  // namespace
}  // namespace palpa::session

#include <fcntl.h>
#include <gtest/gtest.h>
#include <poll.h>
#include <stdlib.h>
#include <unistd.h>

#include <atomic>
#include <cstdio>
#include <mutex>
#include <thread>

#include "anatomy/base/error.h"
#include "anatomy/base/whole_file.h"
#include "apps/station/station_file.h"
#include "haptics/devices/driver.h"
#include "tests/support/scratch_folder.h"

namespace palpa::haptics {
namespace {

constexpr std::int64_t kMs = 1'000'000;

/// The device at the other end of a pseudo-terminal: answers each line with its place.
class PenTwin {
 public:
  PenTwin() : end_(::posix_openpt(O_RDWR | O_NOCTTY | O_CLOEXEC)) {
    ::grantpt(end_);
    ::unlockpt(end_);
    thread_ = std::thread([this] { live(); });
  }
  ~PenTwin() { unplug(); }
  PenTwin(const PenTwin&) = delete;
  PenTwin& operator=(const PenTwin&) = delete;

  std::string port() const { return ::ptsname(end_); }
  void unplug() {
    ending_ = true;
    if (thread_.joinable()) thread_.join();
    if (end_ >= 0) ::close(end_);
    end_ = -1;
  }
  void say(const std::string& answer) {
    const std::lock_guard lock(mutex_);
    answer_ = answer;
  }
  std::string heard() {
    const std::lock_guard lock(mutex_);
    return heard_;
  }

 private:
  void live() {
    std::string line;
    while (!ending_) {
      pollfd one{end_, POLLIN, 0};
      if (::poll(&one, 1, 2) <= 0 || !(one.revents & POLLIN)) continue;
      char c = 0;
      if (::read(end_, &c, 1) != 1) continue;
      if (c != '\n') {
        line += c;
        continue;
      }
      const std::lock_guard lock(mutex_);
      heard_ = line;
      line.clear();
      const std::string all = answer_ + "\n";
      if (!answer_.empty() && ::write(end_, all.data(), all.size()) < 0) ending_ = true;
    }
  }

  int end_;
  std::mutex mutex_;
  std::string heard_, answer_ = "0 0 0 1";
  std::atomic<bool> ending_{false};
  std::thread thread_;
};

const DriverDescription& pen() { return *driverNamed("serial_pen"); }

struct Rig {
  explicit Rig(const std::string& port) {
    DriverSettings settings;
    settings.set("port", port);
    driver = pen().make(settings);
    driver->open();
  }
  void step() {
    now_ns = std::max(now_ns + kMs, due_ns);
    if (commanding) driver->command(now_ns, f_D);
    due_ns = driver->step(now_ns);
  }
  bool reach(DriverState wanted) {
    for (int i = 0; i < 100 && driver->status().state != wanted; ++i) step();
    return driver->status().state == wanted;
  }
  std::unique_ptr<Driver> driver;
  std::int64_t now_ns = 0, due_ns = 0;
  Packed3 f_D{0, 0, 1.5};
  bool commanding = true;
};

TEST(TenthDriver, StandsInTheRegistryBesideTheOthers) {
  ASSERT_NE(driverNamed("serial_pen"), nullptr);
  ASSERT_NE(driverNamed("falcon"), nullptr);
  EXPECT_EQ(driverNamed("template"), nullptr);
  for (const DriverDescription* one : drivers()) {
    EXPECT_FALSE(one->title.empty()) << one->name;
    EXPECT_NE(one->make, nullptr) << one->name;
    EXPECT_GT(one->capabilities({}).max_force_N, 0) << one->name;
    for (const DriverField& field : one->fields) EXPECT_FALSE(field.about.empty()) << field.name;
  }
}

/// The shipped station with another driver, and a field of it.
std::filesystem::path stationWith(const test::ScratchFolder& folder, const char* field) {
  nlohmann::json station =
      nlohmann::json::parse(readWhole(PALPA_SOURCE_DIR "/assets/stations/falcon.json").value());
  station["device"]["driver"] = "serial_pen";
  station["device"][field] = "/dev/ttyACM3";
  station["safety"]["max_force_N"] = 1.5;
  station["coupling"]["stiffness_N_per_m"] = 500;
  writeWhole(folder / "station.json", station.dump());
  return folder / "station.json";
}

TEST(TenthDriver, IsReadFromAStationsFile) {
  const test::ScratchFolder folder("tenth_driver");
  const station::Station station = station::readStation(stationWith(folder, "port"));
  ASSERT_EQ(station.device.real, &pen());
  EXPECT_EQ(station.device.settings.text("port"), "/dev/ttyACM3");
  EXPECT_EQ(station.device.capabilities.max_force_N, 2);
  EXPECT_EQ(station.device.capabilities.apparent_mass, 0.15);
}

TEST(TenthDriver, FieldsOfNobodyAreRefused) {
  const test::ScratchFolder folder("tenth_driver");
  for (const auto& [field, meant] : {std::pair{"prot", "port"}, std::pair{"firmware", "unknown"}})
    try {
      station::readStation(stationWith(folder, field));
      ADD_FAILURE() << field;
    } catch (const UsageError& e) {
      EXPECT_NE(std::string(e.what()).find(meant), std::string::npos) << e.what();
    }
}

TEST(TenthDriver, SettingsComeBackFromWords) {
  DriverSettings settings;
  settings.set("port", "/dev/a=b c");
  const std::vector<std::string> words = settings.words();
  EXPECT_EQ(DriverSettings::ofWords(words, pen().fields).text("port"), "/dev/a=b c");
  EXPECT_EQ(DriverSettings::ofWords({"other=1", "port"}, pen().fields).text("port"), "");
}

TEST(TenthDriver, ReportsMetresInTheBase) {
  PenTwin twin;
  twin.say("1000 -2000 30000 1");
  Rig rig(twin.port());
  ASSERT_TRUE(rig.reach(DriverState::ready));
  const DeviceReading reading = rig.driver->read(rig.now_ns);
  EXPECT_NEAR(reading.p_DE[0], 0.001, 1e-12);
  EXPECT_NEAR(reading.p_DE[1], -0.002, 1e-12);
  EXPECT_NEAR(reading.p_DE[2], 0.03, 1e-12);
  EXPECT_EQ(reading.homed, 1u);
  EXPECT_EQ(rig.driver->words(rig.driver->status()), "");
}

TEST(TenthDriver, GivesNoForceUnlessHomedAnsweredAndFresh) {
  PenTwin twin;
  twin.say("0 0 0 0");
  Rig rig(twin.port());
  for (int i = 0; i < 5; ++i) rig.step();
  EXPECT_EQ(rig.driver->status().state, DriverState::homing);
  EXPECT_EQ(twin.heard(), "0 0 0") << "not homed";
  EXPECT_NE(rig.driver->words(rig.driver->status()), "");
  twin.say("0 0 0 1");
  ASSERT_TRUE(rig.reach(DriverState::ready));
  rig.step();
  EXPECT_EQ(twin.heard(), "0 0 1500");
  rig.commanding = false;
  for (int i = 0; i < 12; ++i) rig.step();
  EXPECT_EQ(twin.heard(), "0 0 0") << "the loop stands still";
  rig.commanding = true;
  rig.f_D = {0, std::nan(""), 1};
  rig.step();
  EXPECT_EQ(twin.heard(), "0 0 0") << "no number";
}

TEST(TenthDriver, IsSilentOnAnythingThatIsNoReading) {
  PenTwin twin;
  Rig rig(twin.port());
  ASSERT_TRUE(rig.reach(DriverState::ready));
  for (const char* wrong : {"1 2 3", "1 2 x 1", "1 2 3 1 9", "99999999999 0 0 1"}) {
    rig.step();
    const std::uint64_t before = rig.driver->read(rig.now_ns).sequence;
    twin.say(wrong);
    rig.step();
    EXPECT_EQ(rig.driver->read(rig.now_ns).sequence, before) << wrong;
    twin.say("0 0 0 1");
    rig.step();
    EXPECT_EQ(twin.heard(), "0 0 0") << wrong;
  }
}

TEST(TenthDriver, SaysZeroAtItsEndAndWhatIsWrong) {
  const test::ScratchFolder folder("tenth_driver");
  const std::string port = (folder / "port").string();
  {
    PenTwin twin;
    std::filesystem::create_symlink(twin.port(), port);
    Rig rig(port);
    ASSERT_TRUE(rig.reach(DriverState::ready));
    rig.step();
    ASSERT_EQ(twin.heard(), "0 0 1500");
    rig.driver->close();
    for (int i = 0; i < 1000 && twin.heard() != "0 0 0"; ++i) ::usleep(1000);
    EXPECT_EQ(twin.heard(), "0 0 0");
    EXPECT_EQ(rig.driver->step(rig.now_ns), Driver::kNever);
  }
  std::filesystem::remove(port);
  Rig rig(port);
  rig.step();
  EXPECT_NE(rig.driver->words(rig.driver->status()).find("is not there"), std::string::npos);
}

/// Pulled out while it pushes, and plugged in again.
TEST(TenthDriver, ComesBackWithoutAForce) {
  const test::ScratchFolder folder("tenth_driver");
  const std::string port = (folder / "port").string();
  auto twin = std::make_unique<PenTwin>();
  std::filesystem::create_symlink(twin->port(), port);
  Rig rig(port);
  ASSERT_TRUE(rig.reach(DriverState::ready));
  twin.reset();
  std::filesystem::remove(port);
  ASSERT_TRUE(rig.reach(DriverState::lost));
  EXPECT_EQ(rig.driver->read(rig.now_ns).homed, 0u);
  PenTwin again;
  again.say("0 0 0 0");
  std::filesystem::create_symlink(again.port(), port);
  ASSERT_TRUE(rig.reach(DriverState::homing));
  for (int i = 0; i < 3; ++i) rig.step();
  EXPECT_EQ(again.heard(), "0 0 0");
  EXPECT_EQ(rig.driver->status().opened, 2u);
}

}  // namespace
}  // namespace palpa::haptics

#include <fstream>

#include "apps/doctor/device_check.h"
#include "haptics/devices/falcon/falcon_link.h"
#include "says.h"
#include "tests/support/files.h"

namespace palpa::doctor {
namespace {

namespace fs = std::filesystem;

const haptics::DriverDescription& falcon() { return *haptics::driverNamed("falcon"); }

TEST(DoctorsDevice, EveryProblemOfAFalconIsNamed) {
  using haptics::DriverState;
  using haptics::FalconProblem;
  haptics::DriverStatus status;
  const auto driver = falcon().make({});
  const auto judged = [&] { return judgeDriver(status, falcon().title, driver->words(status)); };
  status.state = DriverState::ready;
  status.exchanges = 1000;
  expectSays(judged(), State::well, "knows where its grip is");
  status.missed = 100;
  expectSays(judged(), State::note, "had no answer");
  status.state = DriverState::homing;
  expectSays(judged(), State::note, "does not know where its grip is");
  status.state = DriverState::opening;
  expectSays(judged(), State::ill, "does not answer");
  for (const auto& [problem, words] : {std::pair{FalconProblem::absent, "is not there"},
                                       {FalconProblem::denied, "may not be used by this user"},
                                       {FalconProblem::busy, "in use by another program"},
                                       {FalconProblem::needs_firmware, "no firmware"},
                                       {FalconProblem::upload_failed, "did not take the firmware"},
                                       {FalconProblem::silent, "stopped answering"}}) {
    status.problem = static_cast<std::uint8_t>(problem);
    expectSays(judged(), State::ill, words);
  }
}

TEST(DoctorsDevice, WhatBecomesOfTheForceOfADeadProgramIsSaid) {
  haptics::DeviceCapabilities device;
  expectSays(sayWatchdog(device), State::well, "Keep its power switch within reach");
  device.watchdog = haptics::Watchdog::own;
  expectSays(sayWatchdog(device), State::well, "lets go by itself");
}

TEST(DoctorsDevice, FirmwareThatIsNotThereOrNoneIsNamed) {
  const fs::path folder = test::freshFolder("doctor", "firmware");
  station::DeviceSetup setup;
  setup.driver = station::DeviceDriver::real;
  setup.real = &falcon();
  const auto asked = [&] { return askNeeds(setup).at(0); };
  EXPECT_EQ(asked().state, State::absent);
  const fs::path firmware = folder / "falcon.bin";
  setup.settings.set("firmware", firmware.string());
  expectSays(asked(), State::ill, firmware.string());
  std::ofstream(firmware) << "a page that a browser saved";
  expectSays(asked(), State::ill, firmware.string());
  std::ofstream(firmware) << std::string(8492, 'F');
  expectSays(asked(), State::well, "8492 bytes");
}

/// As udev reads them: a file in an earlier folder hides one of its name.
TEST(DoctorsDevice, TheRuleOfUdevIsLookedForWhereUdevLooks) {
  const fs::path top = test::freshFolder("doctor", "udev"), etc = top / "etc", lib = top / "lib";
  const std::vector<fs::path> folders{etc, top / "nowhere", lib};
  expectSays(askUdevRule(folders, falcon()), State::note, "there is none");
  fs::create_directories(etc);
  fs::create_directories(lib);
  std::ofstream(etc / "50-other.rules")
      << "ATTR{idVendor}==\"0403\", ATTR{idProduct}==\"6001\", GROUP=\"plugdev\"\n# 0403 cb48\n";
  expectSays(askUdevRule(folders, falcon()), State::note, "there is none");
  fs::copy(station::assetFile("udev/60-palpa-falcon.rules"), lib);
  expectSays(askUdevRule(folders, falcon()), State::well, (lib / "60-palpa-falcon.rules").string());
  std::ofstream(etc / "60-palpa-falcon.rules").close();
  expectSays(askUdevRule(folders, falcon()), State::note, "there is none");
  std::ofstream(etc / "60-palpa-falcon.rules")
      << "ATTR{idVendor}==\"0403\", ATTR{idProduct}==\"cb48\", MODE=\"0600\"\n";
  expectSays(askUdevRule(folders, falcon()), State::note, "nobody but root");
}

TEST(DoctorsSensor, SilenceLossAndFaultsAreNamed) {
  expectSays(judgeSensor({500, 0, 0, 0.5, ""}), State::well, "1000 samples a second");
  expectSays(judgeSensor({0, 0, 0, 0.5, ""}), State::ill, "no samples");
  expectSays(judgeSensor({500, 30, 0, 0.5, ""}), State::note, "30 samples were lost");
  expectSays(judgeSensor({500, 0, 400, 0.5, ""}), State::ill, "overloaded or broken");
  station::Station station = benchStation();
  EXPECT_EQ(askSensor(station).state, station.force_sensor ? State::well : State::absent);
  station.force_sensor.emplace();
  station.force_sensor->driver = station::ForceSensorDriver::net_ft;
  station.force_sensor->net_ft.address = "127.0.0.1";  // nobody answers there
  station.force_sensor->net_ft.port = 9;
  station.force_sensor->net_ft.answer_tries = 1;
  EXPECT_EQ(askSensor(station).state, State::ill);
}

}  // namespace
}  // namespace palpa::doctor

#include <fstream>

#include "apps/doctor/device_check.h"
#include "says.h"
#include "tests/support/files.h"

namespace palpa::doctor {
namespace {

namespace fs = std::filesystem;

TEST(DoctorsDevice, EveryProblemOfAFalconIsNamed) {
  using haptics::FalconProblem;
  using haptics::FalconState;
  haptics::FalconStatus status;
  status.state = FalconState::ready;
  status.exchanges = 1000;
  expectSays(judgeFalcon(status), State::well, "knows where its grip is");
  status.missed = 100;
  expectSays(judgeFalcon(status), State::note, "had no answer");
  status.state = FalconState::homing;
  expectSays(judgeFalcon(status), State::note, "does not know where its grip is");
  status.state = FalconState::opening;
  expectSays(judgeFalcon(status), State::ill, "does not answer");
  for (const auto& [problem, words] : {std::pair{FalconProblem::absent, "is not there"},
                                       {FalconProblem::denied, "may not be used by this user"},
                                       {FalconProblem::busy, "in use by another program"},
                                       {FalconProblem::needs_firmware, "no firmware"},
                                       {FalconProblem::upload_failed, "did not take the firmware"},
                                       {FalconProblem::silent, "stopped answering"}}) {
    status.problem = problem;
    expectSays(judgeFalcon(status), State::ill, words);
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
  setup.driver = station::DeviceDriver::falcon;
  EXPECT_EQ(askFirmware(setup).state, State::absent);
  setup.firmware = folder / "falcon.bin";
  expectSays(askFirmware(setup), State::ill, setup.firmware.string());
  std::ofstream(setup.firmware) << "a page that a browser saved";
  expectSays(askFirmware(setup), State::ill, setup.firmware.string());
  std::ofstream(setup.firmware) << std::string(8492, 'F');
  expectSays(askFirmware(setup), State::well, "8492 bytes");
}

/// As udev reads them: a file in an earlier folder hides one of its name.
TEST(DoctorsDevice, TheRuleOfUdevIsLookedForWhereUdevLooks) {
  const fs::path top = test::freshFolder("doctor", "udev"), etc = top / "etc", lib = top / "lib";
  const std::vector<fs::path> folders{etc, top / "nowhere", lib};
  expectSays(askUdevRule(folders), State::note, "there is none");
  fs::create_directories(etc);
  fs::create_directories(lib);
  std::ofstream(etc / "50-other.rules")
      << "ATTR{idVendor}==\"0403\", ATTR{idProduct}==\"6001\", GROUP=\"plugdev\"\n# 0403 cb48\n";
  expectSays(askUdevRule(folders), State::note, "there is none");
  fs::copy(station::assetFile("udev/60-palpa-falcon.rules"), lib);
  expectSays(askUdevRule(folders), State::well, (lib / "60-palpa-falcon.rules").string());
  std::ofstream(etc / "60-palpa-falcon.rules").close();
  expectSays(askUdevRule(folders), State::note, "there is none");
  std::ofstream(etc / "60-palpa-falcon.rules")
      << "ATTR{idVendor}==\"0403\", ATTR{idProduct}==\"cb48\", MODE=\"0600\"\n";
  expectSays(askUdevRule(folders), State::note, "nobody but root");
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

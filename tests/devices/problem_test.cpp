#include "haptics/devices/falcon/falcon_link.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <string>

#include "falcon_rig.h"
#include "scripted_usb.h"

namespace palpa::haptics {
namespace {

namespace fs = std::filesystem;

std::string words(FalconProblem problem) { return falconError(problem).what(); }
bool says(const std::string& text, const std::string& word) { return text.find(word) != text.npos; }

TEST(FalconProblems, WhatKeepsItFromOpeningIsToldApart) {
  const std::pair<UsbStatus, FalconProblem> cases[] = {{UsbStatus::gone, FalconProblem::absent},
                                                       {UsbStatus::denied, FalconProblem::denied},
                                                       {UsbStatus::busy, FalconProblem::busy},
                                                       {UsbStatus::other, FalconProblem::usb}};
  for (const auto& [answer, problem] : cases) {
    test::FalconTwin twin(test::someImage());
    auto usb = std::make_unique<test::ScriptedUsb>(twin);
    usb->open_answer = answer;
    test::FalconRig rig(std::move(usb), twin, test::someImage());
    rig.step();
    EXPECT_EQ(rig.driver.details().problem, problem);
    EXPECT_EQ(rig.state(), DriverState::opening);
  }
}

TEST(FalconProblems, EachSaysWhatToDo) {
  EXPECT_TRUE(says(words(FalconProblem::denied), "assets/udev/60-palpa-falcon.rules"));
  EXPECT_TRUE(says(words(FalconProblem::denied), "/etc/udev/rules.d"));
  EXPECT_TRUE(says(words(FalconProblem::absent), "power supply"));
  EXPECT_TRUE(says(words(FalconProblem::busy), "another program"));
  EXPECT_TRUE(says(words(FalconProblem::needs_firmware), "path of a firmware file"));
  EXPECT_TRUE(says(falconInstruction(DriverState::homing), "Pull the grip"));
}

TEST(FalconProblems, TheRuleThatIsNamedExistsAndIsForThisDevice) {
  std::ifstream file(PALPA_SOURCE_DIR "/assets/udev/60-palpa-falcon.rules");
  const std::string rule{std::istreambuf_iterator<char>(file), {}};
  EXPECT_TRUE(says(rule, "ATTR{idVendor}==\"0403\", ATTR{idProduct}==\"cb48\""));
}

class FirmwareFile : public testing::Test {
 protected:
  fs::path write(std::size_t bytes) {
    fs::path path = fs::path(PALPA_BUILD_DIR) / ("firmware-" + std::to_string(bytes) + ".bin");
    std::ofstream(path, std::ios::binary) << std::string(bytes, 'F');
    return path;
  }
  std::string complaint(const fs::path& path) {
    try {
      readFalconFirmware(path);
    } catch (const Error& error) {
      return error.what();
    }
    return "";
  }
};

TEST_F(FirmwareFile, IsReadWhole) { EXPECT_EQ(readFalconFirmware(write(8492)).size(), 8492u); }

TEST_F(FirmwareFile, MissingOrOfTheWrongSizeIsSaidWithItsPath) {
  EXPECT_TRUE(says(complaint("/nowhere/nvent.bin"), "/nowhere/nvent.bin: cannot be read"));
  EXPECT_TRUE(says(complaint(write(0)), "has 0 bytes"));
  EXPECT_TRUE(says(complaint(write(100'000)), "firmware-100000.bin"));
  EXPECT_TRUE(says(complaint(PALPA_BUILD_DIR), "firmware")) << "a folder";
}

}  // namespace
}  // namespace palpa::haptics

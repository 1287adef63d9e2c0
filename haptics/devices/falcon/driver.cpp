#include "haptics/devices/driver.h"

#include "haptics/devices/falcon/falcon_driver.h"

namespace palpa::haptics::falcon {

const DriverDescription& description();

namespace {

constexpr char kFirmware[] = "firmware";

std::vector<std::uint8_t> firmwareOf(const DriverSettings& settings) {
  const std::filesystem::path file = settings.file(kFirmware);
  return file.empty() ? std::vector<std::uint8_t>{} : readFalconFirmware(file);
}

std::unique_ptr<Driver> make(const DriverSettings& settings) {
  return std::make_unique<FalconDriver>(std::make_unique<LibusbTransport>(kFalconUsb),
                                        firmwareOf(settings));
}

/// The firmware file that a station names: there, and as large as a firmware is.
std::vector<DriverNeed> needs(const DriverSettings& settings) {
  using State = DriverNeed::State;
  if (settings.file(kFirmware).empty())
    return {{kFirmware, State::absent,
             "the station's file names none: something else must give the Falcon its firmware "
             "whenever its power was off"}};
  try {
    return {{kFirmware, State::well,
             "good: " + std::to_string(firmwareOf(settings).size()) + " bytes in " +
                 settings.file(kFirmware).string()}};
  } catch (const std::exception& e) {
    return {{kFirmware, State::ill, e.what()}};
  }
}

}  // namespace

const DriverDescription& description() {
  static const DriverDescription falcon{
      .name = "falcon",
      .title = "Novint Falcon",
      .fields = {{.name = kFirmware,
                  .kind = DriverField::Kind::file,
                  .title = "Firmware",
                  .about = "Its maker's file, relative to this one. Without it the firmware must "
                           "be running."}},
      .usb = {{kFalconUsb.vendor, kFalconUsb.product}},
      .udev_rule = "60-palpa-falcon.rules",
      .capabilities = [](const DriverSettings&) { return falconCapabilities(); },
      .make = make,
      .needs = needs};
  return falcon;
}

}  // namespace palpa::haptics::falcon

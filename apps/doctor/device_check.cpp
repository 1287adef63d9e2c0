#include "apps/doctor/device_check.h"

#include "anatomy/geometry/error.h"
#include "apps/doctor/words.h"
#include "apps/runtime/clock.h"
#include "haptics/devices/falcon_driver.h"
#include "haptics/devices/libusb_transport.h"
#include "haptics/sensors/net_ft_sensor.h"

namespace palpa::doctor {
namespace {

constexpr std::int64_t kPatience = 3 * runtime::kSecond;  // a firmware upload takes two
constexpr const char* kDevice = "haptic device";
constexpr const char* kSensor = "force sensor";

bool isGood(const std::filesystem::path& firmware) {
  try {
    haptics::readFalconFirmware(firmware);
    return true;
  } catch (const std::exception&) {
    return false;
  }
}

/// Tried until it is ready, has to be homed, or the time is up.
haptics::FalconStatus triedFalcon(const station::DeviceSetup& setup) {
  haptics::FalconDriver falcon(std::make_unique<haptics::LibusbTransport>(haptics::kFalconUsb),
                               !isGood(setup.firmware)
                                   ? std::vector<std::uint8_t>{}
                                   : haptics::readFalconFirmware(setup.firmware));
  const runtime::SteadyClock clock;
  falcon.open();
  haptics::FalconStatus status = falcon.status();
  for (std::int64_t now = clock.now(); now < kPatience; now = clock.now()) {
    const std::int64_t due = falcon.step(now);
    status = falcon.status();
    const bool settled =
        status.state == haptics::FalconState::ready || status.state == haptics::FalconState::homing;
    if (settled && status.exchanges > 200) break;
    if (status.problem == haptics::FalconProblem::absent ||
        status.problem == haptics::FalconProblem::denied ||
        status.problem == haptics::FalconProblem::busy ||
        status.problem == haptics::FalconProblem::needs_firmware)
      break;
    clock.sleepUntil(std::min(due, now + 5 * runtime::kMillisecond));
  }
  falcon.close();
  return status;
}

}  // namespace

Finding judgeFalcon(const haptics::FalconStatus& status) {
  using haptics::FalconProblem;
  using haptics::FalconState;
  if (status.problem != FalconProblem::none)
    return troubled(kDevice, State::ill, haptics::falconError(status.problem).what());
  if (status.state == FalconState::homing)
    return {kDevice, State::note, "the Novint Falcon is there and does not know where its grip is",
            haptics::falconInstruction(status.state)};
  if (status.state != FalconState::ready)
    return {kDevice, State::ill, "the Novint Falcon does not answer",
            haptics::falconInstruction(status.state)};
  if (status.missed * 20 > status.exchanges) {
    const std::string missed =
        std::to_string(status.missed) + " of " + std::to_string(status.exchanges + status.missed);
    return {kDevice, State::note, missed + " packets to the Novint Falcon had no answer",
            "Use another cable or a USB port that no camera is on"};
  }
  return {kDevice, State::well, "the Novint Falcon answers and knows where its grip is"};
}

Finding askFirmware(const station::DeviceSetup& setup) {
  if (setup.firmware.empty())
    return {"firmware", State::absent,
            "the station's file names none: something else must give the Falcon its firmware "
            "whenever its power was off"};
  try {
    return {"firmware", State::well,
            text("%.0f bytes in ",
                 static_cast<double>(haptics::readFalconFirmware(setup.firmware).size())) +
                setup.firmware.string()};
  } catch (const std::exception& e) {
    return troubled("firmware", State::ill, e.what());
  }
}

Finding askDevice(const station::DeviceSetup& setup) {
  using station::DeviceDriver;
  try {
    if (setup.driver == DeviceDriver::falcon) return judgeFalcon(triedFalcon(setup));
  } catch (const UsageError& e) {
    return troubled(kDevice, State::ill, e.what());
  } catch (const Error& e) {
    return troubled(kDevice, State::ill, e.what());
  }
  if (setup.driver == DeviceDriver::bench)
    return {kDevice, State::well, "simulated, on the virtual bench"};
  if (setup.driver == DeviceDriver::replay)
    return {kDevice, State::well, "a recording's hand: " + setup.recording.string()};
  return {kDevice, State::note, "the mouse holds the needle: nothing is felt by hand",
          "Give a station with a haptic device, where touch matters"};
}

Finding judgeSensor(const SensorFacts& facts) {
  if (!facts.trouble.empty()) return troubled(kSensor, State::ill, facts.trouble);
  const auto count = [](std::uint64_t n) { return std::to_string(n); };
  if (facts.records == 0)
    return {kSensor, State::ill, "gives no samples",
            "See its power, its network cable and force_sensor/address in the station's file"};
  if (facts.faults * 10 > facts.records)
    return {kSensor, State::ill,
            "says that it is overloaded or broken in " + count(facts.faults) + " of " +
                count(facts.records) + " samples",
            "Take the load off the tool; if it stays so, the sensor's page in a browser says which "
            "gauge"};
  if (facts.lost * 50 > facts.records)
    return {kSensor, State::note,
            count(facts.lost) + " samples were lost beside " + count(facts.records) + " that came",
            "Give the sensor a network cable of its own, not the laboratory's network"};
  return {kSensor, State::well,
          text("%.0f samples a second, none lost",
               facts.seconds > 0 ? static_cast<double>(facts.records) / facts.seconds : 0)};
}

Finding askSensor(const station::Station& station) {
  if (!station.force_sensor) return {kSensor, State::absent, "this station has none"};
  if (station.force_sensor->driver != station::ForceSensorSetup::Driver::net_ft)
    return {kSensor, State::well, "simulated, on the virtual bench"};
  const runtime::SteadyClock clock;
  SensorFacts facts;
  try {
    haptics::NetFtSensor sensor(station.force_sensor->net_ft, [&clock] { return clock.now(); });
    sensor.start();
    const std::int64_t begun = clock.now();
    while (clock.now() < begun + runtime::kSecond / 2) sensor.step();
    facts.seconds = 1e-9 * static_cast<double>(clock.now() - begun);
    facts.records = sensor.count(haptics::NetFtCount::records);
    facts.lost = sensor.count(haptics::NetFtCount::lost);
    facts.faults = sensor.count(haptics::NetFtCount::faults);
  } catch (const std::exception& e) {
    facts.trouble = e.what();
  }
  return judgeSensor(facts);
}

}  // namespace palpa::doctor

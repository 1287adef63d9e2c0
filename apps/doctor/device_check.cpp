#include "apps/doctor/device_check.h"

#include <algorithm>
#include <cmath>
#include <fstream>
#include <set>

#include "anatomy/base/error.h"
#include "apps/doctor/finding.h"
#include "apps/runtime/clock.h"
#include "apps/station/assets.h"
#include "haptics/sensors/net_ft_sensor.h"

namespace palpa::doctor {
namespace {

constexpr std::int64_t kPatience = 3 * runtime::kSecond;  // a firmware upload takes two
constexpr std::uint64_t kEnough = 200;                    // exchanges
constexpr const char* kDevice = "haptic device";
constexpr const char* kSensor = "force sensor";

constexpr std::int64_t kSure = runtime::kSecond / 2;  // what is wrong for so long stays so

/// Tried until it is ready, has to be homed, or the time is up. One whose settings are no good is
/// tried without them.
Finding triedDevice(const station::DeviceSetup& setup) {
  const bool good = std::ranges::none_of(
      askNeeds(setup), [](const Finding& need) { return need.state == State::ill; });
  const auto driver = setup.real->make(good ? setup.settings : haptics::DriverSettings());
  const runtime::SteadyClock clock;
  driver->open();
  haptics::DriverStatus status = driver->status();
  std::int64_t wrong_since = -1;
  for (std::int64_t now = clock.now(); now < kPatience; now = clock.now()) {
    const std::int64_t due = driver->step(now);
    status = driver->status();
    const bool settled =
        status.state == haptics::DriverState::ready || status.state == haptics::DriverState::homing;
    if (settled && status.exchanges > kEnough) break;
    const bool wrong = status.problem != 0 && status.exchanges == 0;
    if (!wrong || wrong_since < 0) wrong_since = wrong ? now : -1;
    if (wrong && now - wrong_since > kSure) break;
    clock.sleepUntil(std::min(due, now + 5 * runtime::kMillisecond));
  }
  driver->close();
  return judgeDriver(status, setup.real->title, driver->words(status));
}

}  // namespace

Finding judgeDriver(const haptics::DriverStatus& status, const std::string& device,
                    const std::string& words) {
  using haptics::DriverState;
  if (status.problem != 0) return troubled(kDevice, State::ill, words);
  if (status.state == DriverState::homing)
    return {kDevice, State::note, device + " is there and does not know where its grip is", words};
  if (status.state != DriverState::ready)
    return {kDevice, State::ill, device + " does not answer", words};
  if (status.missed * 20 > status.exchanges) {
    const std::string missed =
        std::to_string(status.missed) + " of " + std::to_string(status.exchanges + status.missed);
    return {kDevice, State::note, missed + " messages to " + device + " had no answer",
            "Use another cable or a USB port that no camera is on"};
  }
  return {kDevice, State::well, device + " answers and knows where its grip is"};
}

Findings askNeeds(const station::DeviceSetup& setup) {
  Findings all;
  if (!setup.real || !setup.real->needs) return all;
  for (const haptics::DriverNeed& need : setup.real->needs(setup.settings)) {
    const auto state = static_cast<State>(need.state);
    all.push_back(need.fix.empty() && state == State::ill
                      ? troubled(need.subject, state, need.verdict)
                      : Finding{need.subject, state, need.verdict, need.fix});
  }
  return all;
}

Finding askDevice(const station::DeviceSetup& setup) {
  using station::DeviceDriver;
  try {
    if (setup.real) return triedDevice(setup);
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

Finding sayWatchdog(const haptics::DeviceCapabilities& device) {
  constexpr const char* kWatchdog = "force guard";
  if (device.watchdog == haptics::Watchdog::own)
    return {kWatchdog, State::well, "the device lets go by itself when the program dies"};
  return {kWatchdog, State::well,
          "the device may keep its last force when the program dies, is stopped, or hangs in its "
          "driver. A guard process takes that force away; where the driver hangs, only once the "
          "session has ended. Keep its power switch within reach"};
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
            "Take the load off the tool; if that does not help, the sensor's page in a browser "
            "says which gauge"};
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
  if (station.force_sensor->driver != station::ForceSensorDriver::net_ft)
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

namespace {

namespace fs = std::filesystem;

constexpr const char* kRule = "permission (udev rule)";

bool holds(const std::string& line, const std::string& words) {
  return line.find(words) != std::string::npos;
}

std::string inHex(std::uint16_t number) { return text("%04x", unsigned{number}); }

bool names(const std::string& line, const haptics::UsbId& id) {
  return holds(line, inHex(id.vendor)) && holds(line, inHex(id.product));
}

/// A line for the device; empty: there is none in the file.
std::string lineIn(const fs::path& file, const haptics::DriverDescription& device) {
  std::ifstream stream(file);
  for (std::string line; std::getline(stream, line);) {
    const std::size_t begin = line.find_first_not_of(" \t");
    const bool counts = begin != std::string::npos && line[begin] != '#';
    if (counts && std::ranges::any_of(device.usb, [&](auto id) { return names(line, id); }))
      return line;
  }
  return {};
}

std::string remedy(const haptics::DriverDescription& device) {
  std::string file = device.udev_rule;
  try {
    file = station::assetFile("udev/" + file).string();
  } catch (const std::exception&) {  // that the data are missing is told elsewhere
  }
  return "Ask whoever looks after the computer, as root: cp " + file +
         " /etc/udev/rules.d/, then udevadm control --reload, and plug the device in again. The "
         "Debian package brings the rule";
}

}  // namespace

const std::vector<fs::path>& udevFolders() {
  static const std::vector<fs::path> folders{"/etc/udev/rules.d", "/run/udev/rules.d",
                                             "/usr/local/lib/udev/rules.d", "/usr/lib/udev/rules.d",
                                             "/lib/udev/rules.d"};
  return folders;
}

Finding askUdevRule(const std::vector<fs::path>& folders,
                    const haptics::DriverDescription& device) {
  std::set<std::string> seen;
  std::error_code none;
  for (const fs::path& folder : folders)
    for (const auto& entry : fs::directory_iterator(folder, none)) {
      const fs::path& file = entry.path();
      if (file.extension() != ".rules" || !seen.insert(file.filename().string()).second) continue;
      const std::string line = lineIn(file, device);
      if (line.empty()) continue;
      if (holds(line, "uaccess") || holds(line, "GROUP") || holds(line, "0666"))
        return {kRule, State::well, device.title + " may be used: " + file.string()};
      return {kRule, State::note, file.string() + " names it and lets nobody but root use it",
              remedy(device)};
    }
  return {kRule, State::note, "there is none: only the administrator (root) may use the device",
          remedy(device)};
}

namespace {

constexpr const char* kTracker = "tracking system";

std::string placeOf(const station::TrackerSetup& setup) {
  return setup.host + ", port " + std::to_string(setup.port);
}

/// Nobody hears these poses but the counts.
TrackerFacts listen(const station::TrackerSetup& setup, double wait_s) {
  const runtime::SteadyClock clock;
  runtime::EventQueue<runtime::TrackedPose> poses(64);
  igt::TrackerClient client({setup.host, setup.port, setup.transform, setup.X_CK, setup.X_RW,
                             setup.ask_tdata_ms, setup.latency_s},
                            clock, poses);
  const auto received = [&] {
    return client.counts().poses + client.counts().unusable + client.counts().not_rigid;
  };
  std::int64_t begun = clock.now(), end = begun + std::llround(1e9 * wait_s);
  bool waited = true;
  for (std::int64_t now = begun; now < end; now = clock.now()) {
    const std::int64_t next = client.step(now);
    if (next > now) clock.sleepUntil(std::min(next, end));
    for (runtime::TrackedPose pose; poses.pop(&pose);) {
    }
    if (!waited || received() == 0) continue;
    waited = false;
    begun = now;
    end = now + runtime::kSecond;
  }
  return {client.counts(), 1e-9 * static_cast<double>(clock.now() - begun)};
}

}  // namespace

Finding judgeTracker(const TrackerFacts& facts, const station::TrackerSetup& setup) {
  const igt::TrackerCounts& c = facts.counts;
  if (!facts.trouble.empty()) return troubled(kTracker, State::ill, facts.trouble);
  if (c.connections == 0)
    return {kTracker, State::ill, "does not answer at " + placeOf(setup),
            "Start its server (PLUS: PlusServer), look at the network's cable, at tracker/host and "
            "tracker/port in the station's file, and at the firewall there"};
  if (c.poses + c.unusable + c.not_rigid == 0)
    return {kTracker, State::note,
            "answers at " + placeOf(setup) + ", but sends no " + setup.transform,
            "Put both markers in its sight; let its server send that transform by this very name "
            "(case counts), or correct tracker/transform; where it waits to be asked, set "
            "tracker/ask_tdata_ms"};
  if (c.poses == 0 && c.not_rigid > 0)
    return {kTracker, State::ill,
            setup.transform + " is not a pose: it scales, mirrors or is not finite",
            "Let its server send a rigid transform in millimetres"};
  if (c.poses == 0)
    return {kTracker, State::note, "does not see the camera's marker or the table's",
            "Put both markers in its sight"};
  const double rate_Hz = static_cast<double>(c.poses) / facts.seconds;
  const std::string verdict = text("%.0f poses a second", rate_Hz);
  if (rate_Hz * setup.stale_s < 2)
    return {kTracker, State::note,
            verdict + text(", and after %.0f ms without one the camera counts as lost: the overlay "
                           "will come and go",
                           1e3 * setup.stale_s),
            "Let its server send more often, or see what slows the network"};
  return {kTracker, State::well, verdict + " from " + placeOf(setup)};
}

Finding askTracker(const station::TrackerSetup& setup, double wait_s) {
  try {
    return judgeTracker(listen(setup, wait_s), setup);
  } catch (const std::exception& e) {
    return judgeTracker({{}, 0, e.what()}, setup);
  }
}

}  // namespace palpa::doctor

#include "apps/cli/session_devices.h"

#include "apps/record/session_file.h"
#include "apps/station/assets.h"
#include "apps/twin/operator.h"
#include "haptics/devices/falcon_firmware.h"
#include "haptics/devices/libusb_transport.h"

namespace palpa::cli {
namespace {

using station::DeviceDriver;
using station::ForceSensorSetup;

std::vector<haptics::RecordedReading> readingsOf(const std::filesystem::path& session) {
  std::vector<haptics::RecordedReading> readings;
  record::SessionReader(session).ticks(
      [&](const haptics::FlightRecord& tick) { readings.push_back({tick.t_ns, tick.reading}); });
  return readings;
}

twin::OperatorSkill skillOf(OperatorKind who) {
  return twin::readOperatorSkill(
      station::assetFile(who == OperatorKind::novice ? "operators/novice.json" : "operators/expert.json"));
}

/// The bench's sensor, where the station has one and it is not a real one.
std::unique_ptr<runtime::ChannelSensor> benchSensor(const station::Station& station, runtime::TimeMode mode) {
  if (!station.force_sensor || station.force_sensor->driver != ForceSensorSetup::Driver::bench) return nullptr;
  return std::make_unique<runtime::ChannelSensor>(station.force_sensor->net_ft.capabilities, mode);
}

}  // namespace

SessionDevices::SessionDevices(const SessionOptions& options, const NeedleWorld& world, runtime::Bus& bus,
                               task_needle::TaskChannels& channels, const runtime::Clock& clock,
                               runtime::TimeMode mode)
    : bench_moves_(isSimulated(options.who)), channel_(world.station.device.capabilities, mode) {
  if (bench_moves_) bench_sensor_ = benchSensor(world.station, mode);
  const auto give_up = [&channels] {
    channels.operator_to_task.push({task_needle::UserCommand::abort, "The simulated operator gave up"});
  };
  if (bench_moves_ || (options.camera.empty() && world.station.camera_setup.driver == station::CameraSetup::Driver::bench))
    bench_ = makeBench(options, world, give_up, bus);
  openDevice(options, world, bus, channels);
  openSensor(world, options, clock, mode);
}

SessionDevices::~SessionDevices() = default;

std::unique_ptr<twin::VirtualBench> SessionDevices::makeBench(const SessionOptions& options, const NeedleWorld& world, const std::function<void()>& give_up, runtime::Bus& bus) {
  const twin::OperatorSkill skill = skillOf(options.who);
  const twin::VisibleAnatomy anatomy = world.visible(skill, options.knows_patient);
  twin::VirtualBench::Setup setup{world.station,
                                  std::make_unique<twin::Operator>(skill, anatomy, world.station.X_ET, options.seed),
                                  twin::needlePickedUp(world.station, world.X_WA, anatomy.entry_A, options.left_handed),
                                  world.X_WA * anatomy.entry_A,
                                  world.X_WA.rotation() * anatomy.normal_A,
                                  options.seed,
                                  give_up,
                                  bench_sensor_.get(),
                                  {}};
  return std::make_unique<twin::VirtualBench>(std::move(setup), bus, channel_);
}

void SessionDevices::openDevice(const SessionOptions& options, const NeedleWorld& world, runtime::Bus& bus,
                                task_needle::TaskChannels& channels) {
  const station::DeviceSetup& setup = world.station.device;
  haptics::HapticDevice* device = &channel_;
  if (bench_moves_) {
    // the bench's own
  } else if (setup.driver == DeviceDriver::falcon) {
    falcon_ = std::make_unique<haptics::FalconDriver>(
        std::make_unique<haptics::LibusbTransport>(haptics::kFalconUsb),
        setup.firmware.empty() ? std::vector<std::uint8_t>{} : haptics::readFalconFirmware(setup.firmware));
    falcon_activity_ = std::make_unique<runtime::FalconActivity>(*falcon_, bus.device_to_task);
    device = falcon_.get();
  } else if (setup.driver == DeviceDriver::replay) {
    replay_ = std::make_unique<haptics::ReplayDevice>(setup.capabilities, readingsOf(setup.recording));
    device = replay_.get();
  } else {
    mouse_ = std::make_unique<MouseHand>(
        MouseHand::Setup{world.X_DA, world.station.X_ET, world.visible(skillOf(OperatorKind::expert), false),
                         options.left_handed},
        channel_, channels);
  }
  if (world.station.workspace.order > 0) {
    corrected_.emplace(*device, world.station.workspace);
    device = &*corrected_;
  }
  plunger_.emplace(*device, falcon_ ? setup.plunger_button : 0);
}

void SessionDevices::openSensor(const NeedleWorld& world, const SessionOptions& options,
                                const runtime::Clock& clock, runtime::TimeMode mode) {
  if (!world.station.force_sensor) return;
  // A simulated operator has no part in what a real sensor measures, nor a real hand in what the bench's does.
  if (bench_moves_ == (world.station.force_sensor->driver == ForceSensorSetup::Driver::net_ft)) return;
  const ForceSensorSetup& setup = *world.station.force_sensor;
  haptics::ForceSensor* sensor = bench_sensor_.get();
  if (setup.driver == ForceSensorSetup::Driver::net_ft) {
    if (mode == runtime::TimeMode::virtual_time)
      throw UsageError("needs real time", "force_sensor \"" + setup.net_ft.capabilities.name + "\"", "Leave out --fast");
    net_ft_ = std::make_unique<haptics::NetFtSensor>(setup.net_ft, [&clock] { return clock.now(); });
    net_ft_->start();
    net_ft_activity_ = std::make_unique<runtime::NetFtActivity>(*net_ft_);
    sensor = net_ft_.get();
  }
  runtime::ForceSensing::Setup sensing{setup.filter, world.station.X_WD, setup.X_ES};
  sensing.filter.low_pass = haptics::butterworth(setup.cutoff_Hz, options.rate_Hz);
  sensing.filter.p_SK = pack(Vec3((setup.X_ES.inverse() * world.station.X_ET).translation()));
  sensing_.emplace(*sensor, sensing);
}

void SessionDevices::addTo(runtime::Executive& executive) {
  if (bench_moves_) executive.add(bench_->activity(), {0, false, false});
  if (mouse_) executive.add(*mouse_, {0, false, false});
  if (falcon_activity_) executive.add(*falcon_activity_, {0, true, false});
  if (net_ft_activity_) executive.add(*net_ft_activity_, {0, false, false});
}

std::vector<SessionDevices::Fact> SessionDevices::facts() const {
  std::vector<Fact> facts;
  if (const std::uint64_t late = channel_.timeouts())
    facts.push_back({"Forces taken away by the device's watchdog", std::to_string(late),
                     "the haptic loop had not commanded for 10 ms"});
  if (falcon_) {
    const haptics::FalconStatus status = falcon_->status();
    facts.push_back({"Packets exchanged with the Falcon", std::to_string(status.exchanges),
                     std::to_string(status.missed) + " without an answer; opened " + std::to_string(status.opened) +
                         " times"});
  }
  if (net_ft_) {
    using haptics::NetFtCount;
    facts.push_back({"Samples of the force sensor", std::to_string(net_ft_->count(NetFtCount::records)),
                     std::to_string(net_ft_->count(NetFtCount::lost)) + " lost on the way, " +
                         std::to_string(net_ft_->count(NetFtCount::faults)) + " with a fault"});
  }
  return facts;
}

}  // namespace palpa::cli

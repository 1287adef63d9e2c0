#include "apps/session/session_devices.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "anatomy/base/counted.h"
#include "anatomy/base/error.h"
#include "anatomy/base/nearest_word.h"
#include "apps/record/session_file.h"
#include "apps/runtime/clock.h"
#include "apps/station/assets.h"
#include "apps/trial/trial_status.h"
#include "apps/twin/soft_samples.h"

namespace palpa::session {
namespace {

using station::DeviceDriver;
using station::ForceSensorDriver;
using station::ForceSensorSetup;

std::vector<haptics::RecordedReading> readingsOf(const std::filesystem::path& session) {
  std::vector<haptics::RecordedReading> readings;
  record::SessionReader(session).ticks([&](const haptics::FlightRecord& tick) {
    if (tick.tool == 0) readings.push_back({tick.t_ns, tick.reading});
  });
  return readings;
}

/// The bench's sensor, where the station has one and it is not a real one.
std::unique_ptr<runtime::ChannelSensor> benchSensor(const station::Station& station,
                                                    runtime::TimeMode mode) {
  if (!station.force_sensor || station.force_sensor->driver != ForceSensorDriver::bench)
    return nullptr;
  return std::make_unique<runtime::ChannelSensor>(station.force_sensor->net_ft.capabilities, mode);
}

trial::UserRequest requestOf(const twin::Hand::Word& word) {
  if (word.kind == twin::Hand::WordKind::grade)
    return {trial::UserCommand::grade,
            trial::gradeText(word.diameter, word.hardness, word.mobility)};
  if (word.kind == twin::Hand::WordKind::chooses)
    return {trial::UserCommand::choose, std::to_string(word.choice)};
  if (word.kind == twin::Hand::WordKind::done) return {trial::UserCommand::done, ""};
  return {trial::UserCommand::abort, "The simulated operator gave up"};
}

}  // namespace

haptics::TickConfig sensedTick(const SessionOptions& options, const station::Station& station,
                               const station::LumpLibrary& library) {
  const bool bench = station.device.driver == station::DeviceDriver::bench;
  haptics::TickConfig tick;
  tick.contact_mode = haptics::ContactMode::sensed_object;
  tick.object_at_port = 1;
  tick.coupling = station.coupling;
  tick.safety = station.safety;
  if (bench) tick.safety.deadman_button = 0;
  tick.passivity = station.passivity;
  tick.X_ET = pack(station.X_ET);
  tick.touch = station::touchOf(library);
  tick.touch.texture =
      station::bounded(tick.touch.texture, station.safety.max_slew_N_per_s, options.rate_Hz);
  tick.X_DP = pack(Pose(station.X_WD.inverse() * station.sample->X_WP));
  tick.period_ns = std::llround(1e9 / options.rate_Hz);
  tick.device_turns = bench || station.device.capabilities.has_orientation;
  return tick;
}

SessionDevices::Hands SessionDevices::overSilicone(const SessionOptions& options,
                                                   const station::Station& station,
                                                   std::unique_ptr<twin::Hand> hand,
                                                   const Pose& X_WO, double tip_radius) {
  constexpr double kPickedUp = 0.05;  // m above the surface
  const Mat3 down = Eigen::AngleAxisd(std::numbers::pi, Vec3::UnitX()).toRotationMatrix();
  twin::VirtualBenchSetup bench{.station = station,
                                .hand = std::move(hand),
                                .X_DE_start = station.X_WD.inverse() * X_WO *
                                              makePose(down, Vec3(0, 0, kPickedUp)) *
                                              station.X_ET.inverse(),
                                .watched_W = X_WO.translation(),
                                .normal_W = X_WO.linear() * Vec3::UnitZ(),
                                .seed = options.benchSeed()};
  if (station.device.driver == station::DeviceDriver::bench) {
    const auto sample =
        std::make_shared<twin::SampleTwin>(station, options.surface, options.benchSeed());
    bench.real_thing = [sample](const std::array<Pose, 2>& X_WT_true, double dt) {
      const twin::SampleTouch touch = sample->step(X_WT_true[0], dt);
      return std::array<twin::RealTouch, 2>{twin::RealTouch{touch.f_W, touch.p_W}, {}};
    };
  }
  return {std::move(bench), std::nullopt, tip_radius};
}

station::LumpLibrary libraryOn(const SessionOptions& options, const station::Station& station,
                               station::LumpLibrary library) {
  if (!options.surface.empty()) {
    if (station.device.driver != station::DeviceDriver::bench)
      throw UsageError("lies on the virtual bench only", "--surface \"" + options.surface + '"',
                       "Leave it out: what lies on a station is what its calibrations say");
    const std::filesystem::path file = station::assetFile("materials/surfaces.json");
    const std::vector<std::string> known = station::surfacesIn(file);
    if (options.map.empty() &&
        std::find(known.begin(), known.end(), options.surface) == known.end()) {
      std::string all;
      for (const std::string& one : known) all += one + ", ";
      throw UsageError("is not a surface" + didYouMean(options.surface, known),
                       "--surface \"" + options.surface + '"',
                       "There are " + all +
                           "and objects that are not the same everywhere, which need their map: "
                           "palpa calibrate object --mockup NAME, then --map");
    }
    library = station::withSurface(std::move(library), file, options.surface);
  }
  library = station::onStation(std::move(library), station.calibrations);
  if (options.map.empty()) return library;
  library.map = station::readMappedObject(options.map, station.id);
  library.simulated = library.simulated || library.map->simulated;
  library.of_surface += "; from place to place: the map of " + library.map->date.substr(0, 10);
  return library;
}

station::Station feelingStation(const SessionOptions& options) {
  station::Station station = station::readStation(
      options.station.empty() ? station::assetFile("stations/palpation_bench.json")
                              : std::filesystem::path(options.station));
  station::judgeAge(station, runtime::utcNow());
  if (!station.sample)
    throw UsageError("has no \"sample\"", station.file.name(),
                     "Say where it lies: sample/X_WP, the middle of its top, and "
                     "sample/tip_radius_mm");
  if (!station.force_sensor)
    throw UsageError("has no \"force_sensor\"", station.file.name(),
                     "What is added rests on what is felt of the sample: that must be measured. "
                     "Describe the sensor");
  if (station.device.driver == DeviceDriver::bench &&
      station.force_sensor->driver != ForceSensorDriver::bench)
    station.file.refuse("force_sensor/driver",
                        "is a real sensor, but the device is simulated and touches simulated "
                        "silicone; it must be \"virtual\", too");
  return station;
}

SessionDevices::SessionDevices(const SessionOptions& options, const station::Station& station,
                               Hands hands, runtime::Bus& bus, trial::Channels& channels,
                               const runtime::Clock& clock, runtime::TimeMode mode)
    : station_(station),
      bench_moves_(isSimulated(options.who) || hands.pointing),
      pointing_(hands.pointing),
      channel_(station.device.capabilities, mode) {
  if (bench_moves_) bench_sensor_ = benchSensor(station, mode);
  if (hands.bench.second) {
    second_ = std::make_unique<Second>(station.device.capabilities, mode);
    const bool tracked = hands.bench.second->tracker.has_value();
    if (!tracked) second_->sensor = benchSensor(station, mode);
    if (!bench_moves_ || (!tracked && !second_->sensor))
      throw UsageError("does not have two devices with force sensors that this program can drive",
                       station.file.name(),
                       "So far, two tools can only be simulated: leave out --station, take "
                       "--operator expert or novice");
    hands.bench.second->device = &second_->device;
    hands.bench.second->sensor = second_->sensor.get();
    if (!tracked)
      second_->sensing.emplace(*second_->sensor, sensingSetup(options.rate_Hz, hands.tip_radius,
                                                              hands.bench.second->X_WD));
  }
  if (bench_moves_ ||
      (options.camera.empty() && station.camera_setup.driver == station::CameraDriver::bench))
    makeBench(std::move(hands.bench), bus, channels);
  openDevice(hands.mouse, bus, channels);
  openSensor(options, hands.tip_radius, clock, mode);
}

SessionDevices::~SessionDevices() = default;

void SessionDevices::makeBench(twin::VirtualBenchSetup setup, runtime::Bus& bus,
                               trial::Channels& channels) {
  setup.sensor = bench_sensor_.get();
  setup.on_word = [&channels](const twin::Hand::Word& word) {
    channels.operator_to_task.push(requestOf(word));
  };
  bench_ = std::make_unique<twin::VirtualBench>(std::move(setup), bus, channel_);
}

void SessionDevices::openDevice(const std::optional<MouseHandSetup>& mouse, runtime::Bus& bus,
                                trial::Channels& channels) {
  const station::DeviceSetup& setup = station_.device;
  haptics::HapticDevice* device = &channel_;
  if (bench_moves_) {
    // the bench's own
  } else if (setup.real) {
    driver_ = setup.real->make(setup.settings);
    driver_activity_ = std::make_unique<runtime::DriverActivity>(*driver_, bus.device_to_task);
    device = driver_.get();
    if (device->capabilities().watchdog == haptics::Watchdog::unknown)
      guard_ = std::make_unique<ForceGuard>(*setup.real, setup.settings);
  } else if (setup.driver == DeviceDriver::replay) {
    replay_ =
        std::make_unique<haptics::ReplayDevice>(setup.capabilities, readingsOf(setup.recording));
    device = replay_.get();
  } else if (mouse) {
    mouse_ = std::make_unique<MouseHand>(*mouse, channel_, channels, bus.stop);
  } else {
    throw UsageError(
        "cannot feel anything", station_.file.name() + ", device",
        "Give a station with a haptic device, or one whose device/driver is \"virtual\"");
  }
  if (station_.workspace.order > 0) {
    corrected_.emplace(*device, station_.workspace);
    device = &*corrected_;
  }
  plunger_.emplace(*device, driver_ ? setup.plunger_button : 0);
}

void SessionDevices::openSensor(const SessionOptions& options, double tip_radius,
                                const runtime::Clock& clock, runtime::TimeMode mode) {
  if (!station_.force_sensor) return;
  // A simulated operator has no part in what a real sensor measures, nor a real hand in what the
  // bench's does.
  if (bench_moves_ == (station_.force_sensor->driver == ForceSensorDriver::net_ft)) return;
  const ForceSensorSetup& setup = *station_.force_sensor;
  haptics::ForceSensor* sensor = bench_sensor_.get();
  if (setup.driver == ForceSensorDriver::net_ft) {
    if (mode == runtime::TimeMode::virtual_time)
      throw UsageError("needs real time", "force_sensor \"" + setup.net_ft.capabilities.name + "\"",
                       "Leave out --fast");
    net_ft_ =
        std::make_unique<haptics::NetFtSensor>(setup.net_ft, [&clock] { return clock.now(); });
    net_ft_->start();
    net_ft_activity_ = std::make_unique<runtime::NetFtActivity>(*net_ft_);
    sensor = net_ft_.get();
  }
  sensing_.emplace(*sensor, sensingSetup(options.rate_Hz, tip_radius, station_.X_WD));
}

runtime::ForceSensingSetup SessionDevices::sensingSetup(double rate_Hz, double tip_radius,
                                                        const Pose& X_WD) const {
  const ForceSensorSetup& setup = *station_.force_sensor;
  const Vec3 p_EK = station_.X_ET * Vec3(0, 0, -tip_radius);
  const Packed3 p_SK = pack(Vec3(setup.X_ES.inverse() * p_EK));
  runtime::ForceSensingSetup sensing{{}, X_WD, setup.X_ES};
  if (setup.noise_N) {
    haptics::ReactionSettings known;
    known.noise_N = *setup.noise_N;
    const double step = std::hypot(station_.device.capabilities.position_resolution,
                                   station_.device.angle_resolution * p_EK.norm());
    if (step > 0) known.place_m = step / std::sqrt(12.0);
    known.tool = setup.tool;
    known.bias_N = setup.bias.f_S;
    known.p_SK = p_SK;
    sensing.filter = haptics::ReactionFilter(known);
  } else {
    sensing.filter = haptics::WrenchFilter{
        haptics::butterworth(setup.cutoff_Hz, rate_Hz), {}, setup.tool, setup.bias, p_SK};
  }
  return sensing;
}

void SessionDevices::addTo(runtime::Executive& executive) {
  if (bench_moves_)
    executive.add(bench_->activity(),
                  {0, true, false});  // a device moves in time, whatever the computer does
  if (mouse_) executive.add(*mouse_, {0, false, false});
  if (driver_activity_) executive.add(*driver_activity_, {0, true, false});
  if (guard_) executive.add(*guard_, {0, false, false});
  if (net_ft_activity_) executive.add(*net_ft_activity_, {0, false, false});
}

std::string SessionDevices::warning() const {
  if (!guard_ || guard_->stands()) return "";
  return "This device may keep its last force when the program dies: keep a hand on its power "
         "switch";
}

std::vector<report::Fact> SessionDevices::facts() const {
  std::vector<report::Fact> facts;
  if (const std::uint64_t late = channel_.timeouts())
    facts.push_back({"Forces taken away by the device's watchdog", std::to_string(late),
                     "the haptic loop had not commanded for 10 ms"});
  if (driver_) {
    const haptics::DriverStatus status = driver_->status();
    facts.push_back(
        {"Exchanges with the haptic device", std::to_string(status.exchanges),
         std::to_string(status.missed) + " without an answer; opened " + howOften(status.opened)});
  }
  if (net_ft_) {
    using haptics::NetFtCount;
    facts.push_back({"Samples of the force sensor",
                     std::to_string(net_ft_->count(NetFtCount::records)),
                     std::to_string(net_ft_->count(NetFtCount::lost)) + " lost on the way, " +
                         std::to_string(net_ft_->count(NetFtCount::faults)) + " with a fault"});
  }
  return facts;
}

}  // namespace palpa::session

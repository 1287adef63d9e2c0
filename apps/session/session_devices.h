#pragma once

#include <functional>
#include <memory>
#include <vector>

#include "apps/report/page/page_parts.h"
#include "apps/runtime/device_activity.h"
#include "apps/runtime/device_adapters.h"
#include "apps/runtime/executive.h"
#include "apps/runtime/haptic_activity.h"
#include "apps/session/force_guard.h"
#include "apps/session/mouse_hands.h"
#include "apps/session/session_options.h"
#include "apps/station/material_files.h"
#include "apps/twin/virtual_bench.h"
#include "haptics/devices/replay_device.h"
#include "haptics/loop/tick_config.h"

namespace palpa::session {

/// The station of a task that is felt with one tool on a sample: the palpation bench where none is
/// named. Throws UsageError where it has no sample or nothing that measures the force on it.
station::Station feelingStation(const SessionOptions& options);

/// The loop under one tool with a force sensor on that silicone: frames, limits, the library's
/// laws, its texture within the limiter. On the bench without a dead-man's button: nobody could
/// hold it. Throws UsageError for a texture that this loop cannot give.
haptics::TickConfig sensedTick(const SessionOptions& options, const station::Station& station,
                               const station::LumpLibrary& library);

/// What a task's tools touch: the task's library with the surface that was asked for as it was
/// identified, that as this station's own calibrations have it, and the map that was learnt of it.
/// Throws UsageError for a surface that does not lie there, or that is not the same everywhere
/// where there is no map of it, and Error for a map that cannot be used.
station::LumpLibrary libraryOn(const SessionOptions& options, const station::Station& station,
                               station::LumpLibrary library);

/// Who or what holds the tool, behind HapticDevice, and what measures the force on it: the bench's
/// twins, a person's mouse, a real device, a recorded hand; the station file and the operator
/// decide. Their threads are its own. Throws UsageError / Error when something that the station
/// names is not there.
class SessionDevices {
 public:
  /// Who may hold the tool: a simulated person on the bench, and somebody with a mouse (none: a
  /// task that must be felt).
  struct Hands {
    /// what is simulated; sensor and how one gives up are put in here
    twin::VirtualBenchSetup bench;
    std::optional<MouseHandSetup> mouse;
    /// m: the point whose place goes with the sensed force lies so far behind the tip
    double tip_radius = 0;
    PointingHand* pointing = nullptr;  ///< it holds the bench's device, for a person
  };
  /// Such a hand with one upright tool, picked up above X_WO, and on the bench its silicone.
  static Hands overSilicone(const SessionOptions& options, const station::Station& station,
                            std::unique_ptr<twin::Hand> hand, const Pose& X_WO, double tip_radius);
  SessionDevices(const SessionOptions& options, const station::Station& station, Hands hands,
                 runtime::Bus& bus, trial::Channels& channels, const runtime::Clock& clock,
                 runtime::TimeMode mode);
  ~SessionDevices();

  haptics::HapticDevice& device() { return *plunger_; }
  /// Another device beside the first, with its sensor, or a finger that is only tracked; null where
  /// the task takes one.
  struct Second {
    Second(const haptics::DeviceCapabilities& capabilities, runtime::TimeMode mode)
        : device(capabilities, mode) {}
    runtime::ChannelDevice device;
    std::unique_ptr<runtime::ChannelSensor> sensor;
    std::optional<runtime::ForceSensing> sensing;
    runtime::ForceSensing* sense() { return sensing ? &*sensing : nullptr; }
  };
  Second* second() { return second_.get(); }
  runtime::ForceSensing* sensing() { return sensing_ ? &*sensing_ : nullptr; }
  /// For its camera; null where recorded pictures stand for it
  twin::VirtualBench* bench() { return bench_.get(); }
  MouseHand* mouse() { return mouse_.get(); }  ///< null: nobody leads with the mouse
  const runtime::DriverActivity* driver() const { return driver_activity_.get(); }  ///< or null
  PointingHand* pointing() { return pointing_; }  ///< null: nobody points at the bench

  void addTo(runtime::Executive& executive);  ///< what has to run beside the loop

  std::vector<report::Fact> facts() const;  ///< what a driver has counted, for the report
  /// What whoever holds the device has to know before the first trial; empty: nothing.
  std::string warning() const;

 private:
  void makeBench(twin::VirtualBenchSetup setup, runtime::Bus& bus, trial::Channels& channels);
  void openDevice(const std::optional<MouseHandSetup>& mouse, runtime::Bus& bus,
                  trial::Channels& channels);
  void openSensor(const SessionOptions& options, double tip_radius, const runtime::Clock& clock,
                  runtime::TimeMode mode);
  runtime::ForceSensingSetup sensingSetup(double rate_Hz, double tip_radius,
                                          const Pose& X_WD) const;

  const station::Station& station_;
  const bool bench_moves_;        // the bench's device is the one that is held
  PointingHand* const pointing_;  // the bench's
  runtime::ChannelDevice channel_;
  std::unique_ptr<runtime::ChannelSensor> bench_sensor_;
  std::unique_ptr<Second> second_;
  std::unique_ptr<haptics::NetFtSensor> net_ft_;
  std::unique_ptr<runtime::NetFtActivity> net_ft_activity_;
  std::optional<runtime::ForceSensing> sensing_;
  std::unique_ptr<twin::VirtualBench> bench_;
  std::unique_ptr<MouseHand> mouse_;
  std::unique_ptr<haptics::Driver> driver_;
  std::unique_ptr<runtime::DriverActivity> driver_activity_;
  std::unique_ptr<ForceGuard> guard_;  ///< of a device without a watchdog; takes leave last
  std::unique_ptr<haptics::ReplayDevice> replay_;
  std::optional<runtime::CorrectedDevice> corrected_;  ///< where the workspace was calibrated
  std::optional<runtime::ButtonPlunger> plunger_;      // around whichever it is
};

}  // namespace palpa::session

#pragma once

#include "anatomy/phantom_block.h"
#include "apps/cli/session_devices.h"
#include "apps/cli/session_options.h"
#include "apps/record/session_file.h"
#include "apps/station/station_file.h"
#include "apps/task_palpation/palpation_file.h"

namespace palpa::cli {

/// Everything a palpation session rests on, read and checked before anything starts. Immovable:
/// parts refer to each other.
struct PalpationWorld {
  explicit PalpationWorld(const SessionOptions& options);  ///< throws UsageError / Error
  PalpationWorld(const PalpationWorld&) = delete;
  PalpationWorld& operator=(const PalpationWorld&) = delete;

  station::Station station;
  task_palpation::PalpationSettings task;
  anatomy::Patient phantom;  ///< as it is shown
  Pose X_WA = Pose::Identity();

  bool simulated(const SessionOptions& options) const {
    return isSimulated(options.who) || station.simulated || task.library.simulated;
  }
  bool onBench() const { return station.device.driver == station::DeviceDriver::bench; }
  haptics::TickConfig tickConfig(const SessionOptions& options) const;
  /// Who may hold the tool: on the bench's silicone a simulated person, or one with a mouse, who
  /// sees what is felt there.
  SessionDevices::Hands hands(const SessionOptions& options) const;
  record::SessionInfo info(const SessionOptions& options) const;
  /// "Scaled force: ..." where the device cannot give what deep palpation takes on a patient;
  /// empty: it can.
  std::string forceNote() const;
};

}  // namespace palpa::cli

#pragma once

#include <optional>
#include <vector>

#include "anatomy/base/json_file.h"
#include "anatomy/geometry/pose.h"
#include "apps/station/station_file.h"
#include "ar/cameras/camera.h"
#include "haptics/sensors/force_sensor.h"
#include "haptics/sensors/tool_load.h"

/// Lists in a station's section "twin" of what shall go wrong on the simulated bench, and when:
/// {"kind", "from_s", "to_s", ...}; session time.
namespace palpa::twin {

/// `entryOf(entry, from, to)` makes a fault of each entry of "twin/<field>"; none without
/// the field. Throws UsageError for invalid spans.
template <class Fault, class EntryOf>
std::vector<Fault> readFaults(const JsonFile& file, const char* field, const EntryOf& entryOf) {
  constexpr double kLongestSession = 86'400;  // s
  const std::string place = std::string("twin/") + field;
  std::vector<Fault> faults;
  if (!file.has(place)) return faults;
  const nlohmann::json& list = file.json().at("twin").at(field);
  if (!list.is_array()) file.refuse(place, "must be a list");
  for (const nlohmann::json& item : list) {
    const JsonFile entry(item, file.name() + ", \"" + place + "\"");
    const double from = entry.number("from_s", 0, kLongestSession),
                 to = entry.number("to_s", 0, kLongestSession);
    if (to <= from) entry.refuse("to_s", "must be later than from_s");
    faults.push_back(entryOf(entry, from, to));
  }
  return faults;
}

/// The kind that "kind" names. `names`: {name, kind} each.
template <class Kind, class Names>
Kind faultKind(const JsonFile& entry, const Names& names) {
  const std::string said = entry.text("kind");
  std::string known;
  for (const auto& [name, kind] : names) {
    if (said == name) return kind;
    known += (known.empty() ? "" : ", ") + std::string(name);
  }
  entry.refuse("kind", "is \"" + said + "\"; known are " + known);
}

/// A push that a board on the table gets: "twin/board_moves" of a station's file, a list of
/// {"board", "from_s", "by_mm"}; session time.
struct BoardMove {
  std::size_t board = 0;   ///< of the station's other boards
  double from = 0;         ///< s
  Vec3 by = Vec3::Zero();  ///< m, in W
};

/// Throws UsageError for a board that the station has not, or that belongs nowhere.
std::vector<BoardMove> readBoardMoves(const station::Station& station);

/// Where the station's boards that belong somewhere truly are at a time, in W, each with its index.
std::vector<std::pair<std::size_t, Pose>> boardsAt(const station::Station& station,
                                                   const std::vector<BoardMove>& moves, double t);

/// What goes wrong with a camera: see CameraFault.
enum class CameraFaultKind { hidden, black, frozen, wrong_size, gone, ended };

/// What shall go wrong with the virtual camera, and when: "twin/camera_faults" of a station's file,
/// a list of {"kind", "from_s", "to_s"}; session time.
///   hidden       something lies over the board
///   black        the lens is covered
///   frozen       the same picture over and over
///   wrong_size   pictures of half the size
///   gone         the driver reports an error
///   ended        no more pictures, also afterwards
struct CameraFault {
  CameraFaultKind kind = CameraFaultKind::black;
  double from = 0, to = 0;  ///< s
};

/// Throws UsageError for a kind that is not known and for invalid spans.
std::vector<CameraFault> readCameraFaults(const JsonFile& file);

/// The one that holds at a time; nullptr: none.
const CameraFault* faultAt(const std::vector<CameraFault>& faults, double t);

/// The picture as the fault leaves it. Throws Error where the camera is gone.
std::optional<ar::Frame> spoilt(ar::Frame frame, const CameraFault& fault);

/// What goes wrong with a force sensor: see SensorFault.
enum class SensorFaultKind { unplugged, saturated, drifting, reversed, wrong_scale };

/// What shall go wrong with the virtual force sensor, and when: "twin/sensor_faults" of a station's
/// file, a list of {"kind", "from_s", "to_s"}; session time.
///   unplugged     no samples
///   saturated     it says that its gauges are
///   drifting      its zero wanders by "rate_N_per_s"
///   reversed      every sign is the other one
///   wrong_scale   forces and torques times "factor"
struct SensorFault {
  SensorFaultKind kind = SensorFaultKind::unplugged;
  double from = 0, to = 0;  ///< s
  double amount = 0;        ///< N/s; of the true force
};

/// Throws UsageError for a kind that is not known and for invalid spans.
std::vector<SensorFault> readSensorFaults(const JsonFile& file);

/// The sample as the faults of time `t`, s, leave it; false: there is none. `zero`: what the
/// station takes off as bias.
bool spoil(const std::vector<SensorFault>& faults, double t, const haptics::Wrench& zero,
           haptics::WrenchSample* sample);

}  // namespace palpa::twin

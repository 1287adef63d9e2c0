#include "apps/record/force_columns.h"

#include <algorithm>
#include <functional>
#include <string_view>

#include "anatomy/base/whole_file.h"

namespace palpa::record {
namespace {

using haptics::FlightRecord;

const char* word(haptics::NeedlePhase phase) {
  static constexpr const char* kWords[] = {"outside", "indenting", "inserted"};
  const auto index = static_cast<std::size_t>(phase);
  return index < std::size(kWords) ? kWords[index] : "?";
}

const char* word(haptics::SafetyCause cause) {
  static constexpr const char* kWords[haptics::kSafetyCauseCount] = {"none",
                                                                     "not_finite",
                                                                     "clamp",
                                                                     "slew",
                                                                     "energy",
                                                                     "silent_device",
                                                                     "stale_geometry",
                                                                     "emergency_stop",
                                                                     "watchdog",
                                                                     "not_ready",
                                                                     "jump",
                                                                     "clock",
                                                                     "corrupt_geometry",
                                                                     "deadman",
                                                                     "duty",
                                                                     "no_sensor"};
  const auto index = static_cast<std::size_t>(cause);
  return index < std::size(kWords) ? kWords[index] : "?";
}

std::string word(Organ organ) { return static_cast<int>(organ) < kOrganCount ? name(organ) : "?"; }
std::string word(Tissue tissue) {
  return static_cast<int>(tissue) < kTissueCount ? name(tissue) : "?";
}

std::string eventWords(std::uint32_t events) {
  static constexpr std::pair<std::uint32_t, const char*> kWords[] = {
      {haptics::kSkinPunctured, "skin_punctured"},
      {haptics::kWithdrawn, "withdrawn"},
      {haptics::kWallPunctured, "wall_punctured"},
      {haptics::kBoneTouched, "bone_touched"},
      {haptics::kBoneLeft, "bone_left"},
      {haptics::kSnapshotAdopted, "snapshot_adopted"},
      {haptics::kSafetyTripped, "safety_tripped"},
      {haptics::kSafetyCleared, "safety_cleared"},
      {haptics::kSnapshotRefused, "snapshot_refused"}};
  std::string words;
  for (const auto& [bit, text] : kWords) {
    if (events & bit) words += (words.empty() ? "" : "+") + std::string(text);
  }
  return words;
}

struct ExportColumn {
  TickColumn description;
  std::function<std::string(const FlightRecord&)> value;
};

/// Three or four components of a recorded array under one name: name_x_m, name_y_m, ...
template <typename Array>
void addVector(std::vector<ExportColumn>& columns, const std::string& prefix,
               const std::string& unit, const std::string& meaning, Array FlightRecord::*member) {
  for (int i = 0; i < 3; ++i) {
    columns.push_back({{prefix + '_' + "xyz"[i] + '_' + unit, meaning},
                       [=](const FlightRecord& r) { return shortest((r.*member)[i]); }});
  }
}

void addScalar(std::vector<ExportColumn>& columns, const char* name, const char* meaning,
               double FlightRecord::*member) {
  columns.push_back({{name, meaning}, [=](const FlightRecord& r) { return shortest(r.*member); }});
}

void addClock(std::vector<ExportColumn>& columns) {
  columns.push_back({{"tick", "number of the tick in the session"},
                     [](const FlightRecord& r) { return std::to_string(r.tick); }});
  columns.push_back({{"tool", "which of two devices, from 0"},
                     [](const FlightRecord& r) { return std::to_string(r.tool); }});
  columns.push_back({{"t_ns", "session time of the tick"},
                     [](const FlightRecord& r) { return std::to_string(r.t_ns); }});
  columns.push_back({{"late_ns", "of the tick behind its due time; 0 in virtual time"},
                     [](const FlightRecord& r) { return std::to_string(r.late_ns); }});
  columns.push_back({{"trial", "number of the trial; 0: none"},
                     [](const FlightRecord& r) { return std::to_string(r.commands.trial); }});
}

void addReading(std::vector<ExportColumn>& columns) {
  columns.push_back({{"reading_t_ns", "session time of the device's reading"},
                     [](const FlightRecord& r) { return std::to_string(r.reading.t_ns); }});
  columns.push_back(
      {{"reading_sequence", "number of the reading; stands still when the device is silent"},
       [](const FlightRecord& r) { return std::to_string(r.reading.sequence); }});
  for (int i = 0; i < 3; ++i) {
    columns.push_back({{std::string("p_DE_") + "xyz"[i] + "_m",
                        "position of the end effector in the device base"},
                       [=](const FlightRecord& r) { return shortest(r.reading.p_DE[i]); }});
  }
  for (int i = 0; i < 4; ++i) {
    columns.push_back({{std::string("q_DE_") + "wxyz"[i],
                        "orientation of the end effector in the device base, unit quaternion"},
                       [=](const FlightRecord& r) { return shortest(r.reading.q_DE[i]); }});
  }
  columns.push_back({{"plunger", "drawn fraction of the syringe, 0 to 1"},
                     [](const FlightRecord& r) { return shortest(r.reading.plunger); }});
  columns.push_back({{"buttons", "bits of the device's buttons"},
                     [](const FlightRecord& r) { return std::to_string(r.reading.buttons); }});
  columns.push_back({{"homed", "1: positions are absolute"},
                     [](const FlightRecord& r) { return std::to_string(r.reading.homed); }});
  for (int i = 0; i < 3; ++i)
    columns.push_back({{std::string("f_hand_D_") + "xyz"[i] + "_N",
                        "force of the hand on the tool, by an instrumented handle"},
                       [=](const FlightRecord& r) {
                         return shortest(r.reading.f_hand_D[static_cast<std::size_t>(i)]);
                       }});
  for (int i = 0; i < 3; ++i)
    columns.push_back({{std::string("f_device_D_") + "xyz"[i] + "_N",
                        "force of the device on the tool, drives and friction, by a force cell"},
                       [=](const FlightRecord& r) {
                         return shortest(r.reading.f_device_D[static_cast<std::size_t>(i)]);
                       }});
  columns.push_back(
      {{"instrumented", "1: hand and device are measured so (simulated devices only)"},
       [](const FlightRecord& r) { return std::to_string(r.reading.instrumented); }});
}

void addCommands(std::vector<ExportColumn>& columns) {
  columns.push_back({{"puncture_force_N", "force at which the skin gives way in this trial"},
                     [](const FlightRecord& r) { return shortest(r.commands.puncture_force_N); }});
  columns.push_back({{"force_feedback", "1: forces are rendered"}, [](const FlightRecord& r) {
                       return std::to_string(r.commands.force_feedback);
                     }});
  columns.push_back({{"emergency_stop", "1: pressed"}, [](const FlightRecord& r) {
                       return std::to_string(r.commands.emergency_stop);
                     }});
  columns.push_back({{"armed", "0: no force (not homed, between trials)"},
                     [](const FlightRecord& r) { return std::to_string(r.commands.armed); }});
  columns.push_back({{"subtask", "part of the task that was on, as the task counts them"},
                     [](const FlightRecord& r) { return std::to_string(r.commands.subtask); }});
  columns.push_back({{"lumps", "virtual lumps in this trial"}, [](const FlightRecord& r) {
                       return std::to_string(
                           std::count_if(r.commands.lumps.begin(), r.commands.lumps.end(),
                                         [](const auto& lump) { return lump.kind > 0; }));
                     }});
  columns.push_back(
      {{"squeeze_stiffness", "times as hard as what is held is"}, [](const FlightRecord& r) {
         return shortest(static_cast<double>(r.commands.squeeze_stiffness));
       }});
  columns.push_back(
      {{"squeeze_weight", "times as heavy as what is held is"}, [](const FlightRecord& r) {
         return shortest(static_cast<double>(r.commands.squeeze_weight));
       }});
  columns.push_back(
      {{"friction", "times as rough as the touched surface is; 1 where friction is not changed"},
       [](const FlightRecord& r) { return shortest(static_cast<double>(r.commands.friction)); }});
  columns.push_back(
      {{"vessel", "of the pulse under the tool, as laws.json numbers them; 0: none"},
       [](const FlightRecord& r) { return std::to_string(r.commands.artery.vessel); }});
  for (std::size_t i = 0; i < haptics::kMostBeats; ++i) {
    const std::string beat = "beat_" + std::to_string(i + 1);
    columns.push_back(
        {{beat + "_ns", "session time at which its wave begins"}, [i](const FlightRecord& r) {
           return std::to_string(r.commands.artery.beats[i].start_ns);
         }});
    columns.push_back(
        {{beat + "_strength", "in ordinary beats; 0: there is none"},
         [i](const FlightRecord& r) { return shortest(r.commands.artery.beats[i].strength); }});
  }
  columns.push_back({{"floor", "number of the floor that is searched; 0: none"},
                     [](const FlightRecord& r) { return std::to_string(r.commands.floor); }});
  columns.push_back({{"degraded", "1: the floor with the lesser gains"},
                     [](const FlightRecord& r) { return std::to_string(r.commands.degraded); }});
  columns.push_back({{"held", "1: the handle is held where an episode starts"},
                     [](const FlightRecord& r) { return std::to_string(r.commands.held); }});
  columns.push_back({{"augmented", "1: the session's augmentations may add force"},
                     [](const FlightRecord& r) { return std::to_string(r.commands.augmented); }});
  columns.push_back(
      {{"snapshot", "number of the newest geometry snapshot used, or refused in this tick"},
       [](const FlightRecord& r) { return std::to_string(r.snapshot); }});
}

Vec3 tip(const PackedPose& X_ET, const FlightRecord& r) {
  return unpack(r.reading.p_DE) + unpack(r.reading.q_DE).normalized() * unpack(X_ET.p);
}

/// Tip and proxy: where the tip is, and where it would be on what cannot be entered, f = K_c (proxy
/// - tip).
void addTip(std::vector<ExportColumn>& columns, const haptics::TickConfig& config) {
  const PackedPose X_ET = config.X_ET;
  const double K_c = config.coupling.stiffness;
  for (int i = 0; i < 3; ++i)
    columns.push_back(
        {{std::string("p_DT_") + "xyz"[i] + "_m", "position of the tip in the device base"},
         [=](const FlightRecord& r) { return shortest(tip(X_ET, r)[i]); }});
  for (int i = 0; i < 3; ++i)
    columns.push_back(
        {{std::string("proxy_D_") + "xyz"[i] + "_m",
          "tip + contact force / coupling stiffness: where the coupling would have the tip"},
         [=](const FlightRecord& r) {
           return shortest(tip(X_ET, r)[i] + r.f_contact_D[static_cast<std::size_t>(i)] / K_c);
         }});
}

void addSensed(std::vector<ExportColumn>& columns) {
  for (int i = 0; i < 3; ++i)
    columns.push_back(
        {{std::string("f_sensed_D_") + "xyz"[i] + "_N",
          "force sensor: of a real object on the tool, device base; where `sensor` says "
          "estimated, no sensor's but told from the other tool's"},
         [=](const FlightRecord& r) {
           return shortest(r.sensed.f_D[static_cast<std::size_t>(i)]);
         }});
  for (int i = 0; i < 3; ++i)
    columns.push_back(
        {{std::string("p_sensed_D_") + "xyz"[i] + "_m",
          "where the tip (a round one's middle) was, as late as the force sensor's word"},
         [=](const FlightRecord& r) {
           return shortest(r.sensed.p_DK[static_cast<std::size_t>(i)]);
         }});
  columns.push_back(
      {{"sensor", "none, valid, unusable or estimated"}, [](const FlightRecord& r) {
         static constexpr const char* kWords[] = {"none", "valid", "unusable", "estimated"};
         const auto index = static_cast<std::size_t>(r.sensed.state);
         return std::string(index < std::size(kWords) ? kWords[index] : "?");
       }});
}

/// ": 1 scan, 2 shape, 4 identify".
std::string bitsOf(const std::vector<NamedForExport>& names) {
  std::string words;
  for (std::size_t i = 0; i < names.size(); ++i)
    words += (i == 0 ? ": " : ", ") + std::to_string(1u << i) + ' ' + names[i].name;
  return words;
}

/// What was added to it all, by which of the task's augmentations, in which of its parts.
void addCues(std::vector<ExportColumn>& columns, const TaskNames& names) {
  addVector(columns, "f_augmentation_D", "N",
            "of all augmentations and the pulse together, device base",
            &FlightRecord::f_augmentation_D);
  columns.push_back({{"parts", "bits of the task's parts that are on" + bitsOf(names.parts)},
                     [](const FlightRecord& r) { return std::to_string(r.subtasks); }});
  columns.push_back(
      {{"cues", "bits of the task's augmentations that add force" + bitsOf(names.cues)},
       [](const FlightRecord& r) { return std::to_string(r.augmenting); }});
  columns.push_back({{"cues_begun", "of these, those that were triggered in this tick"},
                     [](const FlightRecord& r) { return std::to_string(r.began); }});
  columns.push_back(
      {{"place", "on a floor, bits: element + 1 (1, 2), 4 texture, 8 pit, 16 touching"},
       [](const FlightRecord& r) { return std::to_string(r.place); }});
}

void addContact(std::vector<ExportColumn>& columns) {
  addVector(columns, "f_contact_D", "N", "computed contact force on the tool, device base",
            &FlightRecord::f_contact_D);
  addVector(columns, "f_wanted_D", "N",
            "force after fading and passivity control, before the safety limiter",
            &FlightRecord::f_wanted_D);
  addVector(columns, "f_command_D", "N", "force that left the safety limiter, device base",
            &FlightRecord::f_command_D);
  addVector(columns, "tau_missing_D", "Nm", "torque about the end effector the device cannot give",
            &FlightRecord::tau_missing_D);
  addScalar(columns, "indentation_m", "of the skin before puncture", &FlightRecord::indentation);
  addScalar(columns, "depth_m", "of the tip below the skin along the needle", &FlightRecord::depth);
  addScalar(columns, "v_axial_m_per_s", "of the tip along the needle, inward positive",
            &FlightRecord::v_axial);
  addScalar(columns, "skin_force_N", "normal force on the skin before puncture",
            &FlightRecord::skin_force);
  addScalar(columns, "bone_force_N", "largest bone contact force", &FlightRecord::bone_force);
  addScalar(columns, "wall_force_N", "on the wall being deformed", &FlightRecord::wall_force);
}

void addStates(std::vector<ExportColumn>& columns) {
  columns.push_back({{"events", "what happened in this tick, joined by +"},
                     [](const FlightRecord& r) { return eventWords(r.events); }});
  columns.push_back({{"phase", "outside, indenting or inserted"},
                     [](const FlightRecord& r) { return std::string(word(r.phase)); }});
  columns.push_back(
      {{"tissue", "at the tip"}, [](const FlightRecord& r) { return word(r.tissue); }});
  columns.push_back({{"wall", "organ whose wall the tip deforms or punctured"},
                     [](const FlightRecord& r) { return word(r.wall); }});
  columns.push_back({{"wall_leaving", "1: the back wall"},
                     [](const FlightRecord& r) { return std::to_string(r.wall_leaving); }});
  columns.push_back(
      {{"bone", "bone in contact"}, [](const FlightRecord& r) { return word(r.bone); }});
  columns.push_back({{"safety", "what the safety limiter changed, and why"},
                     [](const FlightRecord& r) { return std::string(word(r.safety)); }});
  columns.push_back({{"damped", "1: passivity control added damping"},
                     [](const FlightRecord& r) { return std::to_string(r.damped); }});
  columns.push_back({{"skin_punctures", "in this trial so far"},
                     [](const FlightRecord& r) { return std::to_string(r.skin_punctures); }});
}

std::vector<ExportColumn> recordColumns(const SessionInfo& info) {
  std::vector<ExportColumn> columns;
  addClock(columns);
  addReading(columns);
  addTip(columns, info.tick_config);
  addCommands(columns);
  addContact(columns);
  addSensed(columns);
  addCues(columns, namesIn(info));
  addStates(columns);
  return columns;
}

}  // namespace

std::vector<TickColumn> tickColumns(const SessionInfo& info) {
  std::vector<TickColumn> descriptions;
  for (const ExportColumn& column : recordColumns(info)) descriptions.push_back(column.description);
  for (const ForceColumn& column : forceColumns(info)) descriptions.push_back(column.description);
  return descriptions;
}

void exportTicks(const SessionReader& reader, const TickSource& ticks,
                 const std::filesystem::path& file) {
  const std::vector<ExportColumn> columns = recordColumns(reader.info());
  const std::vector<ForceColumn> forces = forceColumns(reader.info());
  WholeFile out(file);
  std::string line;
  for (const TickColumn& column : tickColumns(reader.info()))
    line += (line.empty() ? "" : ",") + column.name;
  out.write(line + '\n');
  ticks([&](const FlightRecord& record, const haptics::TickForces* known) {
    line.clear();
    for (const ExportColumn& column : columns) {
      if (!line.empty()) line += ',';
      line += column.value(record);
    }
    for (const ForceColumn& column : forces)
      line += ',' + (known ? column.value(record, *known) : "");
    out.write(line + '\n');
  });
  out.finish();
}

}  // namespace palpa::record

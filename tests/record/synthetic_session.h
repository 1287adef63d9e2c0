#pragma once

#include <cmath>
#include <cstdint>
#include <cstring>
#include <string>
#include <vector>

#include "anatomy/base/error.h"
#include "anatomy/base/random.h"
#include "apps/record/session_file.h"
#include "tests/support/files.h"

/// Sessions that look like real ones, for the tests of the record: smooth motion with sensor noise
/// in the last bits, forces, events. Everything follows from the tick number.
namespace palpa::record::test {

inline double noise(std::uint64_t counter) {  // uniform in +-1
  return static_cast<double>(splitMix64(counter) >> 11) * 0x1p-52 - 1;
}

/// A record whose padding is zero, so that whole records can be compared bit by bit.
template <typename Record>
Record zeroed() {
  Record record;
  std::memset(static_cast<void*>(&record), 0, sizeof(record));
  return record;
}

inline haptics::FlightRecord syntheticTick(std::int64_t tick) {
  auto r = zeroed<haptics::FlightRecord>();
  const double t = 1e-3 * static_cast<double>(tick);
  const auto seed = static_cast<std::uint64_t>(tick) * 16;
  r.tick = tick;
  r.t_ns = tick * 1'000'000;
  r.reading.t_ns = r.t_ns - 200'000;
  r.reading.sequence = static_cast<std::uint64_t>(tick + 1);
  for (int i = 0; i < 3; ++i) {
    r.reading.p_DE[i] = 0.02 * std::sin(t + i) + 1e-5 * noise(seed + i);
    r.f_contact_D[i] = 1.5 * std::sin(2 * t + i) + 1e-3 * noise(seed + 3 + i);
    r.f_command_D[i] = 0.9 * r.f_contact_D[i];
  }
  r.reading.q_DE = {std::cos(0.2 * t), std::sin(0.2 * t), 0, 0};
  r.reading.plunger = 0.5 + 0.5 * std::sin(t);
  r.commands.trial = 1;
  r.commands.force_feedback = r.commands.armed = 1;
  r.snapshot = static_cast<std::uint64_t>(tick / 16 + 1);
  r.depth = 0.03 * std::fabs(std::sin(0.3 * t));
  r.v_axial = 0.01 * std::cos(0.3 * t) + 1e-4 * noise(seed + 6);
  r.phase = tick < 300 ? haptics::NeedlePhase::indenting : haptics::NeedlePhase::inserted;
  r.tissue = tick % 1000 < 500 ? Tissue::fat : Tissue::muscle;
  r.events = tick % 16 == 0 ? haptics::kSnapshotAdopted : 0u;
  r.skin_punctures = tick < 300 ? 0 : 1;
  return r;
}

inline LocalGeometry syntheticSnapshot(std::uint64_t number) {
  auto g = zeroed<LocalGeometry>();
  g.number = number;
  g.t_ns = static_cast<std::int64_t>(number) * 16'000'000;
  g.skin.n = {0, 0, 1};
  g.bone_count = 2;
  g.boundary_count = 5;
  for (int i = 0; i < 2; ++i) {
    g.bones[i].b = {0.1, 0.01 * i, noise(number)};
    g.bones[i].radius = 0.006;
    g.bones[i].organ = i ? Organ::rib : Organ::clavicle;
  }
  for (int i = 0; i < 5; ++i) {
    g.boundaries[i].p = {0, 0, -0.01 * i + 1e-4 * noise(number + i)};
    g.boundaries[i].n = {0, 0, 1};
    g.boundaries[i].leaving = i == 4;
  }
  return g;
}

inline haptics::TickState syntheticState(std::int64_t tick) {
  auto state = zeroed<haptics::TickState>();
  state.tick = tick;
  state.now = syntheticSnapshot(static_cast<std::uint64_t>(tick / 16 + 1));
  state.old = syntheticSnapshot(static_cast<std::uint64_t>(tick / 16));
  state.contact.motion.p_D = {0.1, noise(static_cast<std::uint64_t>(tick)), 0.3};
  return state;
}

inline SessionInfo syntheticInfo() {
  SessionInfo info;
  info.uuid = "0b4f6f0e-6b0a-4c3e-9d5e-2f8f5c1d7a11";
  info.started_utc = "2024-05-06T07:08:09Z";
  info.software = "palpa 0.1.0";
  info.command = "paracentesis --fast";
  info.session_json = R"({"seed": 7, "operator": "expert"})";
  info.station_json = R"({"device": "virtual"})";
  info.task_json = R"({"engine": "needle"})";
  info.patient_glb = std::string("glTF\0\1\2", 7) + std::string(5000, '\x7f');
  info.expert_path_json = "{}";
  info.tick_config.materials.skin.m = 2100;
  info.tick_config.X_ET.p = {0, 0, 0.12};
  return info;
}

/// Hands the writer ticks [from, to) with the snapshots and keyframes that belong to them.
inline void writeTicks(SessionWriter& writer, std::int64_t from, std::int64_t to) {
  for (std::int64_t tick = from; tick < to; ++tick) {
    if (tick % 16 == 0)
      writer.snapshot(syntheticSnapshot(static_cast<std::uint64_t>(tick / 16 + 1)));
    if (tick % 200 == 0) writer.keyframe(tick, syntheticState(tick));
    writer.tick(syntheticTick(tick));
    if (tick % 200 == 199) writer.commit();
  }
}

/// One trial with events.
inline void writeTrial(SessionWriter& writer, std::int64_t tick_count) {
  writer.beginTrial({1, 0, 0xfedcba9876543210u, "scored", true, 1.7});
  writer.event({300'000'000, 1, "puncture", "The skin was punctured", 1.7});
  writeTicks(writer, 0, tick_count);
  writer.event({tick_count * 1'000'000, 1, "success", "Blood was aspirated — good", -0.5});
  writer.endTrial({1, tick_count * 1'000'000, "success", "", R"({"TOTAL": 12.5})"});
}

using palpa::test::slurp;
inline std::filesystem::path freshFolder(const std::string& name) {
  return palpa::test::freshFolder("record", name);
}

template <typename Record>
std::string bits(const Record& record) {
  return {reinterpret_cast<const char*>(&record), sizeof(record)};
}

/// Everything a reader gives, as one string: equal strings, equal evidence.
inline std::string everything(const SessionReader& reader) {
  const SessionInfo& i = reader.info();
  std::string all = i.uuid + i.started_utc + i.software + i.command + i.session_json +
                    i.station_json + i.task_json + i.patient_glb + i.expert_path_json +
                    bits(i.tick_config);
  for (const auto& [header, end, ended] : reader.trials()) {
    all += std::to_string(header.trial) + ' ' + std::to_string(header.t_ns) + ' ' +
           std::to_string(header.seed) + header.role + (header.force_feedback ? "+" : "-") +
           bits(header.puncture_force_N) + (ended ? "ended" : "open") + std::to_string(end.trial) +
           std::to_string(end.t_ns) + end.outcome + end.reason + end.scores_json;
  }
  for (const auto& e : reader.events()) {
    all += std::to_string(e.t_ns) + ' ' + std::to_string(e.trial) + e.kind + e.text + bits(e.value);
  }
  reader.ticks([&](const haptics::FlightRecord& r) { all += bits(r); });
  reader.snapshots([&](const LocalGeometry& g) { all += bits(g); });
  reader.keyframes([&](std::int64_t tick, const haptics::TickState& state) {
    all += std::to_string(tick) + bits(state);
  });
  return all;
}

}  // namespace palpa::record::test

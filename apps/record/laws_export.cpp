#include <map>
#include <vector>

#include <nlohmann/json.hpp>

#include "anatomy/base/error.h"
#include "apps/record/force_columns.h"

namespace palpa::record {
namespace {

using nlohmann::json;

json jsonOf(const haptics::HuntCrossley& law) { return {{"k", law.k}, {"b", law.b}, {"m", law.m}}; }
json jsonOf(const haptics::Dahl& law) {
  return {{"mu", law.mu}, {"sigma_N_per_m", law.sigma}, {"B_Ns_per_m", law.B}};
}
json jsonOf(const PackedPose& X) { return {{"p_m", X.p}, {"q_wxyz", X.q}}; }

/// Of haptics/materials/texture.h: rows of forces, in them nodes of rising speed.
json textureOf(const haptics::TextureLaw& law) {
  if (law.speeds > law.ln_speed.size() || law.forces > law.ln_force.size() ||
      law.order > haptics::kMostTextureOrder)
    throw Error("has a texture that cannot be", "session", "Restore the file from a backup");
  json nodes = json::array();
  for (std::size_t f = 0; f < law.forces; ++f) {
    json row = json::array();
    for (std::size_t v = 0; v < law.speeds; ++v) {
      const haptics::TextureNode& node = law.nodes[f][v];
      const auto end = node.reflection.begin() + law.order;
      row.push_back({{"ln_rms_N", node.ln_rms},
                     {"reflection", std::vector<double>(node.reflection.begin(), end)}});
    }
    nodes.push_back(row);
  }
  const auto first = [](const auto& row, std::size_t count) {
    return std::vector<double>(row.begin(), row.begin() + static_cast<std::ptrdiff_t>(count));
  };
  return {{"ln_speed_m_per_s", first(law.ln_speed, law.speeds)},
          {"ln_force_N", first(law.ln_force, law.forces)},
          {"nodes", nodes},
          {"leak", haptics::kTextureLeak},
          {"still_m_per_s", haptics::kTextureStill},
          {"largest_N", law.largest}};
}

json surfaceOf(const haptics::TouchAugmentation& touch) {
  const haptics::StiffnessModulation& contact = touch.surface.contact;
  json surface{{"H", jsonOf(contact.real)},
               {"x0_m", contact.x0},
               {"friction", jsonOf(contact.friction)},
               {"factor", contact.target.factor},
               {"constant_N_per_m", contact.target.constant},
               {"least_contact_N", contact.least_contact}};
  if (touch.other_friction) surface["wanted_friction"] = jsonOf(touch.surface.wanted);
  if (touch.texture.speeds > 0) surface["texture"] = textureOf(touch.texture);
  return surface;
}

/// By how much the object differs from its one law from place to place.
json mapOf(const haptics::LearntMap& map) {
  const auto nodes = static_cast<std::ptrdiff_t>(map.columns) * map.rows;
  const auto listed = [nodes](const auto& all) {
    return std::vector<float>(all.begin(), all.begin() + nodes);
  };
  return {{"about",
           "k and b of H times stiffness, mu times friction, bilinear between the nodes of a grid "
           "across P, row by row from the lowest y; faded to 1 within one step beyond the rim"},
          {"columns", map.columns},
          {"rows", map.rows},
          {"low_m", {map.low_x, map.low_y}},
          {"step_m", {map.step_x, map.step_y}},
          {"stiffness", listed(map.stiffness)},
          {"friction", listed(map.friction)}};
}

json kindsOf(const haptics::TouchAugmentation& touch) {
  json kinds = json::array();
  for (const haptics::VirtualInclusion& kind : touch.kinds) {
    if (!(kind.l0 > 0)) continue;
    kinds.push_back({{"l0_m", kind.l0},
                     {"H_T", jsonOf(kind.H_T)},
                     {"G", {jsonOf(kind.G[0]), jsonOf(kind.G[1]), jsonOf(kind.G[2])}}});
  }
  return kinds;
}

json pulseOf(const haptics::PulseLaw& law) {
  json waves = json::array();
  for (const haptics::PulseWave& wave : law.waves) {
    json bumps = json::array();
    for (const haptics::PulseBump& bump : wave.bumps)
      bumps.push_back({{"start_s", bump.start_s},
                       {"peak_s", bump.peak_s},
                       {"end_s", bump.end_s},
                       {"height", bump.height}});
    waves.push_back(bumps);
  }
  return {{"waves", waves},
          {"contact_radius_m", law.contact_radius},
          {"closed_at", law.closed_at},
          {"light_N", law.light_N},
          {"press_tau_s", law.press_tau},
          {"largest_N", law.largest_N}};
}

json jsonOf(const haptics::PulsingArtery& artery) {
  return {{"vessel", artery.vessel}, {"p_P_m", artery.p_P},
          {"a_P", artery.a_P},       {"half_length_m", artery.half_length},
          {"depth_m", artery.depth}, {"strength_N", artery.strength_N},
          {"best_N", artery.best_N}};
}

/// Of each trial that has one, as its first tick has it.
json arteriesOf(const SessionReader& reader) {
  std::map<std::uint32_t, haptics::PulsingArtery> trials;
  reader.ticks([&](const haptics::FlightRecord& record) {
    trials.emplace(record.commands.trial, record.commands.artery);
  });
  json all = json::object();
  for (const auto& [trial, artery] : trials)
    if (trial > 0 && artery.vessel > 0) all[std::to_string(trial)] = jsonOf(artery);
  return all;
}

/// Of each trial as its first tick has them.
json lumpsOf(const SessionReader& reader) {
  std::map<std::uint32_t, haptics::PlacedLumps> trials;
  reader.ticks([&](const haptics::FlightRecord& record) {
    trials.emplace(record.commands.trial, record.commands.lumps);
  });
  json all = json::object();
  for (const auto& [trial, lumps] : trials) {
    json placed = json::array();
    for (const haptics::PlacedLump& lump : lumps) {
      if (lump.kind == 0) continue;
      placed.push_back({{"kind", lump.kind}, {"p_P_m", lump.p_T0}});
      if (lump.n != haptics::PlacedLump{}.n) placed.back()["normal"] = lump.n;
      if (lump.taken > 0) placed.back()["taken"] = lump.taken;  // a real one, taken off
    }
    if (trial > 0) all[std::to_string(trial)] = placed;
  }
  return all;
}

/// How the second tool's force is told that has no sensor.
json estimateOf(const haptics::PairConfig& pair) {
  const haptics::TickConfig& tool = pair.tools[1];
  return {{"about",
           "The second tool has no force sensor: what it presses with is estimated from the first "
           "one's reaction, both places and H. p_EM: the middle of its tip in E"},
          {"face", pair.opposed ? "opposed" : "beside"},
          {"thickness_m", static_cast<double>(pair.thickness)},
          {"p_EM_m", pack(Vec3(unpack(tool.X_ET) * Vec3(0, 0, -tool.touch.tip_radius)))},
          {"smooth_s", haptics::kEstimateSmooth_s},
          {"placed_within_m", haptics::kFacePlacedWithin},
          {"force_doubt_N", haptics::kEstimateForceDoubt},
          {"depth_doubt", haptics::kEstimateDepthDoubt}};
}

}  // namespace

std::string lawsJson(const SessionReader& reader) {
  const haptics::TickConfig& config = reader.info().tick_config;
  json laws = cueLaws(reader);
  laws["about"] =
      "Laws of the session's forces; SI units. adds_up: which columns of the ticks a force is made "
      "of: f_contact and f_augmentation of theirs alone, f_wanted of both of these times rendered "
      "and its own, f_command of f_wanted and its own";
  if (config.contact_mode != haptics::ContactMode::sensed_object) return laws.dump(1);
  const std::optional<haptics::PairConfig>& pair = reader.info().pair_config;
  laws.update({{"about_the_real",
                "What is added to a real thing, frame P of which the lumps' places are. H, H_T, G: "
                "f = x^m max(k + b x', k / 10). mu and B of wanted_friction: times the ticks' "
                "friction. Equations: Jeon, Choi and Harders, Haptic augmented reality (2015), "
                "10.4 to 10.21"},
               {"tip_radius_m", config.touch.tip_radius},
               {"X_DP", json::array({jsonOf(config.X_DP)})},
               {"surface", surfaceOf(config.touch)},
               {"kinds", kindsOf(config.touch)},
               {"lumps", lumpsOf(reader)}});
  if (config.touch.map.columns > 0) laws["map"] = mapOf(config.touch.map);
  if (json arteries = arteriesOf(reader); !arteries.empty()) {
    laws["pulse"] = pulseOf(config.pulse);
    laws["arteries"] = std::move(arteries);
  }
  if (pair) laws["X_DP"].push_back(jsonOf(pair->tools[1].X_DP));
  if (pair && pair->squeezing)
    laws["squeeze"] = {{"H", jsonOf(pair->squeeze.real)},
                       {"x0_m", pair->squeeze.x0},
                       {"least_contact_N", pair->squeeze.least_contact}};
  if (pair && pair->estimated) laws["estimated"] = estimateOf(*pair);
  return laws.dump(1);
}

}  // namespace palpa::record

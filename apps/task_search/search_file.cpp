#include "apps/task_search/search_file.h"

#include <algorithm>
#include <cmath>

#include "anatomy/base/error.h"
#include "anatomy/base/file_schema.h"
#include "apps/station/task_sections.h"
#include "apps/training/engine.h"

namespace palpa::task_search {
namespace {

// Bumps of a texture, and places that are looked through for the bump under a finger, 1,000 times
// a second.
constexpr double kMostBumps = 100'000, kMostNear = 2'500;
constexpr int kMostEpisodes = 10'000;

double square(double x) { return x * x; }

/// Refused before the floor is made: it would take minutes, or all memory.
void needFewBumps(const JsonFile& file, const std::string& at, const haptics::BumpSpec& bumps) {
  const double all = square(2 * bumps.outer / bumps.spacing),
               near = square(2 * (bumps.radius + bumps.jitter) / bumps.spacing);
  if (all > kMostBumps)
    file.refuse(at + "/spacing_U",
                "makes " + std::to_string(std::llround(all)) + " bumps on a disc; at most " +
                    std::to_string(std::llround(kMostBumps)) + " can be felt in time");
  if (near > kMostNear)
    file.refuse(at + "/jitter_U",
                "or the radius is too large for the spacing: too many bumps lie in one place");
}

haptics::BumpSpec bumpsIn(const JsonFile& file, const std::string& which,
                          const haptics::SearchSpec& spec) {
  const std::string at = "stimulus/" + which;
  haptics::BumpSpec bumps;
  bumps.radius = file.number(at + "/radius_U", 0.1, 20);
  bumps.spacing = file.number(at + "/spacing_U", 0.2, 100);
  bumps.jitter = file.number(at + "/jitter_U", 0, 100);
  bumps.inner = spec.pit;
  bumps.outer = spec.disc;
  needFewBumps(file, at, bumps);
  return bumps;
}

haptics::SearchSpec specIn(const JsonFile& file) {
  haptics::SearchSpec spec;
  spec.side = file.number("stimulus/side_U", 50, 2000);
  spec.circle = file.number("stimulus/circle_U", 5, 1000);
  spec.disc = file.number("stimulus/disc_U", 5, 200);
  spec.groove = file.number("stimulus/groove_U", 5, 300);
  spec.groove_half_width = 0.5 * file.number("stimulus/groove_width_U", 0.5, 100);
  spec.groove_depth = file.number("stimulus/groove_depth_U", 0.1, 50);
  spec.pit = file.number("stimulus/pit_U", 0.5, 100);
  spec.pit_depth = file.number("stimulus/pit_depth_U", 0.1, 50);
  spec.bottom_radius = file.number("stimulus/bottom_radius_U", 0.1, 50);
  spec.lip_radius = file.number("stimulus/lip_radius_U", 0.1, 50);
  spec.target = bumpsIn(file, "target", spec);
  spec.distractor = bumpsIn(file, "distractor", spec);
  return spec;
}

std::vector<SearchBlock> blocksIn(const JsonFile& file) {
  std::vector<SearchBlock> blocks;
  for (const JsonFile& block : file.entries("blocks"))
    blocks.push_back({block.text("name"), block.integer("episodes", 1, 1000),
                      block.integer("training", 0, 1) == 1});
  int episodes = 0;
  for (const SearchBlock& block : blocks)
    if ((episodes += block.episodes) > kMostEpisodes)
      file.refuse("blocks", "hold more than " + std::to_string(kMostEpisodes) + " episodes");
  return blocks;
}

/// Refused now, not at the first episode.
void needFloor(const JsonFile& file, const haptics::SearchSpec& spec) {
  try {
    haptics::SearchSurface(spec, {}, [] { return 0.5; });
  } catch (const Error& e) {
    file.refuse("stimulus", std::string("is not a floor: ") + e.what());
  }
}

}  // namespace

SearchSettings readSearch(const JsonFile& file) {
  file.needVersion(1);
  training::needEngine(file, training::Engine::search);
  SearchSettings s;
  s.id = file.text("id");
  s.title = file.text("title");
  s.brief = station::briefOf(file);
  s.spec = specIn(file);
  needFloor(file, s.spec);
  s.rendering.real = {file.number("interaction/stiffness_N_per_m", 10, 1e5),
                      file.number("interaction/damping_Ns_per_m", 0, 500)};
  s.rendering.degraded.damping = file.number("interaction/degraded_damping_Ns_per_m", 0, 500);
  s.degraded_share = file.number("interaction/degraded_share", 0.01, 1);
  s.rendering.start_height = file.number("interaction/start_height_U", 0, 1000);
  s.rendering.hold_stiffness = file.number("interaction/hold_stiffness_N_per_m", 0, 2000);
  s.rendering.hold_force_N = file.number("interaction/hold_force_N", 0, 5);
  s.hold_s = file.number("interaction/hold_s", 0, 10);
  s.dwell_s = file.number("interaction/dwell_s", 0.05, 10);
  s.map_px = file.integer("rises/map_px", 64, 1024);
  if (s.map_px % haptics::GaborTable::kTile != 0)
    file.refuse("rises/map_px", "must be a multiple of 8");
  s.rise_share = file.number("rises/threshold_share", 0.01, 1);
  s.augmentations = station::readPlan(file);
  s.time_limit_s = file.number("end/time_limit_s", 5, 3600);
  s.shown_per_U = 1e-3 * file.number("shown_mm_per_U", 0.05, 5);
  s.blocks = blocksIn(file);
  s.taxonomy = station::taxonomyOf(file);
  s.source = file.json().dump();
  return s;
}

SearchSettings readSearch(const std::filesystem::path& path) {
  const JsonFile file = station::readTaskFile(path);
  training::needEngine(file, training::Engine::search);
  needKind(file, "task_search", 1);
  return readSearch(file);
}

haptics::FloorRendering renderingOn(const SearchSettings& task, const station::Station& station) {
  if (!station.floor)
    throw UsageError("has no \"floor\"", station.file.name(),
                     "Say where the floor lies and how large its unit is in the hand: floor/X_WF, "
                     "floor/unit_mm, floor/handle_weight_N");
  haptics::FloorRendering r = task.rendering;
  r.unit = station.floor->unit;
  r.weight_N = station.floor->handle_weight_N;
  const double held = std::min(1.0, station.coupling.stiffness / r.real.stiffness);
  r.real.stiffness *= held;
  r.real.damping *= held;
  r.degraded.stiffness = task.degraded_share * r.real.stiffness;
  r.degraded.damping *= held;
  return r;
}

}  // namespace palpa::task_search

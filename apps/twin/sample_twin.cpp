#include "apps/twin/sample_twin.h"

#include <algorithm>

#include "anatomy/geometry/error.h"
#include "apps/station/assets.h"
#include "apps/twin/bench_truth.h"
#include "apps/twin/phantom/phantom_file.h"

namespace palpa::twin {

SampleTwin::SampleTwin(const station::Station& station, const std::string& name,
                       std::uint64_t seed) {
  if (!station.sample)
    throw UsageError("has no \"sample\"", station.file.name(),
                     "Say where it lies: sample/X_WP, sample/tip_radius_mm");
  X_WP_ = trueSample(station, seed);
  radius_ = station.sample->tip_radius;
  const std::string file = "phantoms/" + station.file.text("twin/samples");
  const std::vector<Phantom> samples =
      readSolved(station::assetFile(file + ".json"), station::assetFile(file + ".tables.json"));
  const auto one = name.empty() ? samples.begin()
                                : std::find_if(samples.begin(), samples.end(),
                                               [&](const Phantom& p) { return p.name == name; });
  if (one == samples.end()) {
    std::string known;
    for (const Phantom& p : samples) known += (known.empty() ? "" : ", ") + p.name;
    throw UsageError("is none of the simulated samples", "\"" + name + "\"", "Known are " + known);
  }
  if (std::abs(one->table.tool_radius - radius_) > 1e-6)
    station.file.refuse("sample/tip_radius_mm", "is not that of the simulated samples");
  has_lump_ = one->block.lump.has_value();
  phantom_.emplace(one->table, SiliconeLaw{});
}

SampleTwin::Touch SampleTwin::step(const Pose& X_WT, double dt) {
  const Vec3 middle_P = X_WP_.inverse() * (X_WT * Vec3(0, 0, -radius_)),
             lowest_P = middle_P - radius_ * Vec3::UnitZ();
  const PhantomTouch touch = phantom_->step(lowest_P, dt);
  Touch told;
  told.f_W = X_WP_.linear() * touch.f;
  told.p_W = X_WP_ * lowest_P;
  if (has_lump_) told.lump_W = X_WP_.linear() * touch.lump;
  return told;
}

}  // namespace palpa::twin

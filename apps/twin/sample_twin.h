#pragma once

#include <optional>
#include <string>

#include "apps/station/station_file.h"
#include "apps/twin/phantom/phantom_twin.h"

namespace palpa::twin {

/// The soft sample on the virtual bench's table, and a round tip on it. W: the world.
class SampleTwin {
 public:
  /// One of the station's simulated samples ("twin/samples": a file of assets/phantoms without its
  /// ending); "" is the first. Throws UsageError for a station without samples, or a name that is
  /// none of theirs.
  SampleTwin(const station::Station& station, const std::string& name, std::uint64_t seed);

  /// The tool (z along it, T on its end) is there after another `dt`. Told in W: the force on it,
  /// and where that acts.
  struct Touch {
    Vec3 f_W = Vec3::Zero(), p_W = Vec3::Zero();
    std::optional<Vec3> lump_W;  ///< m, how far its lump has moved; none without one
  };
  Touch step(const Pose& X_WT, double dt);

 private:
  Pose X_WP_;
  double radius_ = 0;
  bool has_lump_ = false;
  std::optional<PhantomTwin> phantom_;
};

}  // namespace palpa::twin

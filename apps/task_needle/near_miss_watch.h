#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "anatomy/patient.h"
#include "anatomy/query/surface_query.h"

namespace palpa::task_needle {

/// Nearer than this to pleura or artery is a near miss, m.
inline constexpr double kNearMiss = 5e-3;

/// Tells near misses while they happen: how far an inserted tip is from pleura or artery, once
/// below kNearMiss and again at every whole millimetre nearer, until the needle is out or the next
/// trial begins. Contact itself is another's to tell. For whoever looks on; scores take the exact
/// distances of the whole trial. One thread.
class NearMissWatch {
 public:
  NearMissWatch(const anatomy::Patient& patient, const anatomy::SurfaceQuery& query);
  /// In words ("2.8 mm from the pleura"); empty: nothing new.
  std::string look(const Vec3& tip_A, bool inserted, std::uint32_t trial);

 private:
  struct Watched {
    int surface;
    const char* words;
    double reported;  ///< whole millimetres that were told last
  };
  const anatomy::SurfaceQuery& query_;
  std::vector<Watched> watched_;
  std::uint32_t trial_ = 0;
};

}  // namespace palpa::task_needle

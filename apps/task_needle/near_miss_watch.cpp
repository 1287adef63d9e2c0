#include "apps/task_needle/near_miss_watch.h"

#include <cmath>
#include <cstdio>

namespace palpa::task_needle {
namespace {

constexpr double kNear_mm = 1e3 * kNearMiss, kNothingReported = 1e9;

}  // namespace

NearMissWatch::NearMissWatch(const anatomy::Patient& patient, const anatomy::SurfaceQuery& query)
    : query_(query) {
  for (std::size_t i = 0; i < patient.organs.size(); ++i) {
    const Organ organ = patient.organs[i].organ;
    if (organ == Organ::lung || organ == Organ::artery)
      watched_.push_back({static_cast<int>(i), organ == Organ::lung ? "the pleura" : "an artery",
                          kNothingReported});
  }
}

std::string NearMissWatch::look(const Vec3& tip_A, bool inserted, std::uint32_t trial) {
  if (!inserted || trial != trial_)
    for (Watched& one : watched_) one.reported = kNothingReported;
  trial_ = trial;
  if (!inserted) return "";
  const Watched* nearest = nullptr;
  double least_mm = kNear_mm;
  for (Watched& one : watched_) {
    const double distance_mm = 1e3 * query_.closest(one.surface, tip_A).distance;
    if (!(distance_mm > 0 && distance_mm < kNear_mm) || std::ceil(distance_mm) >= one.reported)
      continue;
    one.reported = std::ceil(distance_mm);
    if (distance_mm < least_mm) {
      least_mm = distance_mm;
      nearest = &one;
    }
  }
  if (!nearest) return "";
  char words[64];
  std::snprintf(words, sizeof words, "%.1f mm from %s", least_mm, nearest->words);
  return words;
}

}  // namespace palpa::task_needle

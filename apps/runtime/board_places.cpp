#include "apps/runtime/board_places.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

namespace palpa::runtime {
namespace {

constexpr double kEdge = 0.1;  // m
constexpr double kBack = 0.7;

}  // namespace

std::optional<Displaced> displacedBoard(const CameraView& view,
                                        const std::vector<BoardPlace>& places,
                                        std::optional<std::size_t> was) {
  if (!view.X_CW) return std::nullopt;
  for (std::size_t i = 0; i < std::min(places.size(), view.others.size()); ++i) {
    const BoardPlace& place = places[i];
    if (!place.X_WB || !view.others[i]) continue;
    const Pose off = place.X_WB->inverse() * view.X_CW->inverse() * *view.others[i];
    const double moved = off.translation().norm(), turned = Eigen::AngleAxisd(off.linear()).angle();
    const double most = was == i ? kBack * place.tolerance : place.tolerance;
    if (moved <= most && turned * kEdge <= most) continue;
    char words[160];
    if (moved > most)
      std::snprintf(words, sizeof words, " has moved by %.0f mm: put it back, or calibrate anew",
                    1e3 * moved);
    else
      std::snprintf(words, sizeof words,
                    " is turned by %.1f degrees: turn it back, or calibrate anew",
                    turned * 57.29578);
    return Displaced{i, "the " + place.name + words};
  }
  return std::nullopt;
}

}  // namespace palpa::runtime

#include "apps/assess/palpation/normal_anatomy.h"

#include <algorithm>
#include <limits>

namespace palpa::assess {

double fromLine(const NormalAnatomy& anatomy, const Vec3& p_P) {
  double nearest = std::numeric_limits<double>::infinity();
  const Eigen::Vector2d p = p_P.head<2>();
  for (std::size_t i = 0; i < anatomy.line_P.size(); ++i) {
    const Eigen::Vector2d from = anatomy.line_P[i].head<2>(),
                          along =
                              anatomy.line_P[std::min(i + 1, anatomy.line_P.size() - 1)].head<2>() -
                              from;
    const double length2 = along.squaredNorm(),
                 part = length2 > 0 ? std::clamp((p - from).dot(along) / length2, 0.0, 1.0) : 0;
    nearest = std::min(nearest, (p - from - part * along).norm());
  }
  return nearest;
}

const NormalAnatomy* anatomyAt(const std::vector<NormalAnatomy>& all, const Vec3& p_P,
                               double reach) {
  const auto on = [&](const NormalAnatomy& one) {
    return fromLine(one, p_P) <= one.width / 2 + reach;
  };
  const auto found = std::find_if(all.begin(), all.end(), on);
  return found == all.end() ? nullptr : &*found;
}

}  // namespace palpa::assess

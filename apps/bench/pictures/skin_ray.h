#pragma once

#include <optional>

#include "anatomy/patient.h"
#include "anatomy/query/triangle_tree.h"

namespace palpa::bench {

/// Where a straight line meets a patient's skin.
class SkinRay {
 public:
  explicit SkinRay(const anatomy::Patient& patient);

  /// How far along this way (unit) the skin is first met, m; none within `length`.
  std::optional<double> along(const Vec3& from_A, const Vec3& way, double length) const;

 private:
  anatomy::TriangleTree skin_;
};

}  // namespace palpa::bench

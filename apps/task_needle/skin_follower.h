#pragma once

#include <cstdint>
#include <optional>

#include "anatomy/skin_dimple.h"
#include "anatomy/surface_query.h"
#include "apps/runtime/bus.h"

namespace palpa::task_needle {

/// How the needle moves the skin that is shown.
///   before puncture    the skin is where the tip is: pushed from the tip's nearest point on it,
///   straight to the tip inserted           at the entry: what the shaft's friction drags, axial
///   force / stiffness, at most 3 mm; inward while the
///                      needle goes in, outward (a tent) while it is drawn out
///   after puncture and after withdrawal   what is left goes exponentially to that, tau = 0.15 s
/// Only what is drawn; no force and no score knows of it.
class SkinFollower {
 public:
  SkinFollower(const anatomy::SurfaceQuery& query, int skin) : query_(query), skin_(skin) {}

  std::optional<anatomy::SkinPush> follow(const runtime::ToolState& tool, const Pose& X_AD,
                                          std::int64_t now_ns);

 private:
  anatomy::SkinPush pushed(const Pose& X_AT) const;
  double dragged(const runtime::ToolState& tool, const Vec3& axis_A, const Pose& X_AD) const;

  const anatomy::SurfaceQuery& query_;
  int skin_;
  std::optional<anatomy::SkinPush> push_;
  std::int64_t last_ns_ = 0;
};

}  // namespace palpa::task_needle

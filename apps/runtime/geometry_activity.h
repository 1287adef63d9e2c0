#pragma once

#include "anatomy/local_geometry_builder.h"
#include "apps/runtime/activity.h"
#include "apps/runtime/bus.h"

namespace palpa::runtime {

/// GEOMETRY, 60 Hz: exact mesh queries around the predicted tool -> LocalGeometry snapshot.
class GeometryActivity final : public Activity {
 public:
  /// `latency_ns`: in virtual time a snapshot becomes visible this long after its step.
  GeometryActivity(Bus& bus, const anatomy::LocalGeometryBuilder& builder, const Pose& X_DA,
                   std::int64_t latency_ns = 2'000'000)
      : bus_(bus), builder_(builder), X_DA_(X_DA), X_AD_(X_DA.inverse()), latency_ns_(latency_ns) {}
  const char* name() const override { return "geometry"; }
  std::int64_t step(std::int64_t now_ns) override;

 private:
  Bus& bus_;
  const anatomy::LocalGeometryBuilder& builder_;
  Pose X_DA_, X_AD_;
  std::int64_t latency_ns_;
  std::uint64_t number_ = 0;
};

}  // namespace palpa::runtime

#pragma once

#include "anatomy/query/local_geometry_builder.h"
#include "apps/runtime/activity.h"
#include "apps/runtime/bus.h"
#include "haptics/loop/tick_config.h"

namespace palpa::runtime {

/// GEOMETRY, 60 Hz: exact mesh queries around the predicted tool -> LocalGeometry snapshot.
class GeometryActivity final : public Activity {
 public:
  struct Settings {
    std::int64_t period_ns = 16'666'667;
    /// in virtual time a snapshot becomes visible this long after its step
    std::int64_t latency_ns = 2'000'000;
    std::int64_t blend_ns = haptics::TickConfig{}.blend_ns;  ///< of the tick that uses it
  };
  GeometryActivity(Bus& bus, const anatomy::LocalGeometryBuilder& builder, const Pose& X_DA)
      : GeometryActivity(bus, builder, X_DA, Settings()) {}
  GeometryActivity(Bus& bus, const anatomy::LocalGeometryBuilder& builder, const Pose& X_DA,
                   const Settings& settings)
      : bus_(bus), builder_(builder), X_DA_(X_DA), X_AD_(X_DA.inverse()), settings_(settings) {}
  const char* name() const override { return "geometry"; }
  std::int64_t step(std::int64_t now_ns) override;
  /// The snapshot for this tool, told to the recorder. `step` publishes the one for where the tool
  /// will be.
  LocalGeometry make(const ToolState& tool, std::int64_t now_ns);

 private:
  Bus& bus_;
  const anatomy::LocalGeometryBuilder& builder_;
  Pose X_DA_, X_AD_;
  Settings settings_;
  std::uint64_t number_ = 0;
};

}  // namespace palpa::runtime

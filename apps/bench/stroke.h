#pragma once

#include <vector>

#include "anatomy/query/local_geometry_builder.h"
#include "apps/runtime/bus.h"
#include "apps/runtime/device_adapters.h"
#include "haptics/loop/tick_config.h"

namespace palpa::bench {

/// A probe led over the torso: x = 40 mm sin(2 pi f t), y = 25 mm sin(2 pi 0.31 f t + 0.5), its
/// point `depth` under the surface along the normal.
struct StrokeSettings {
  double stroke_Hz = 0.2;
  double geometry_Hz = 60;
  double seconds = 10;
  double depth = 0.001;
  double stiffness = 500;  ///< of the tissue, N/m
  double coupling = 1000;  ///< K_c, N/m
};

Vec3 strokePoint(const StrokeSettings& settings, double t_s);
haptics::TickConfig strokeConfig(const StrokeSettings& settings);

/// What came out of a stroke in virtual time: the real activities HAPTIC and GEOMETRY on a device
/// that is moved.
struct StrokeResult {
  std::vector<haptics::FlightRecord> records;
  std::vector<LocalGeometry> snapshots;  ///< in order; snapshot number n is at n - 1
};
StrokeResult runStroke(const StrokeSettings& settings,
                       const anatomy::LocalGeometryBuilder& builder);

/// A device that is led along a stroke: its reading at `now_ns`.
class LedDevice {
 public:
  LedDevice(const StrokeSettings& stroke, runtime::ChannelDevice& device)
      : stroke_(stroke), device_(device) {}
  haptics::DeviceReading lead(std::int64_t now_ns);

 private:
  StrokeSettings stroke_;
  runtime::ChannelDevice& device_;
  std::uint64_t sequence_ = 0;
};

/// Lets the haptic loop render: what a task would say when a trial runs.
void arm(runtime::Bus& bus);

/// Takes off the bus what recorder and task would; records and snapshots go to `result` where there
/// is one. Returns how many of the ticks felt a contact.
std::uint64_t drain(runtime::Bus& bus, StrokeResult* result);

struct TickTiming {
  double median_us = 0, p99_us = 0;
};

/// The recorded stroke run through the tick again, as fast as it goes: mean of 16 ticks at a time.
TickTiming timeHot(const StrokeSettings& settings, const StrokeResult& stroke, int ticks);
/// The same, one tick a millisecond, each timed alone: caches have cooled in between.
TickTiming timePaced(const StrokeSettings& settings, const StrokeResult& stroke, double seconds);

}  // namespace palpa::bench

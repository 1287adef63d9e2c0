#include "apps/bench/stop_rig.h"

#include <gtest/gtest.h>

#include <set>
#include <string>

#include "apps/bench/bench_patients.h"

/// How long a stop takes is the machine's affair; that every one is obeyed, whatever hangs, is
/// ours.
namespace palpa::bench {
namespace {

TEST(StopRig, EveryStopIsObeyedWhateverHangs) {
  const anatomy::Patient patient = torsoPatient(1000);
  const anatomy::SurfaceQuery query(patient);
  const anatomy::LocalGeometryBuilder builder(patient, query);
  for (const StopSource source : kStopSources)
    for (const HungPart hung : kHungParts) {
      const std::vector<double> times = timeStops(builder, source, hung, 3);
      EXPECT_EQ(times.size(), 3u) << nameOf(source) << ", " << nameOf(hung);
      for (const double time_ms : times) EXPECT_GT(time_ms, 0);
    }
}

TEST(StopRig, EachLineHasAName) {
  std::set<std::string> names;
  for (const StopSource source : kStopSources) names.insert(nameOf(source));
  for (const HungPart hung : kHungParts) names.insert(nameOf(hung));
  EXPECT_EQ(names, (std::set<std::string>{"key", "signal", "console", "none", "scene", "task",
                                          "recorder", "camera"}));
}

}  // namespace
}  // namespace palpa::bench

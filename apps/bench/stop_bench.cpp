#include <algorithm>
#include <cstdio>

#include "anatomy/base/quantile.h"
#include "apps/bench/bench.h"
#include "apps/bench/bench_patients.h"
#include "apps/bench/stop_rig.h"
#include "apps/bench/timing.h"

namespace palpa::bench {
namespace {

constexpr int kSkinTriangles = 10'000;

void printStops(StopSource source, HungPart hung, const std::vector<double>& times_ms) {
  print(std::string("stop.") + nameOf(source) + "." + nameOf(hung), quantile(times_ms, 0.99), "ms",
        {{"quantile", 0.99},
         {"median_ms", quantile(times_ms, 0.5)},
         {"max_ms", *std::max_element(times_ms.begin(), times_ms.end())},
         {"presses", times_ms.size()},
         {"pressed_by", nameOf(source)},
         {"hangs", nameOf(hung)},
         {"noise", "none"}});
  std::fflush(stdout);
}

}  // namespace

void benchStop(const StopBenchOptions& options) {
  const anatomy::Patient patient = torsoPatient(kSkinTriangles);
  const anatomy::SurfaceQuery query(patient);
  const anatomy::LocalGeometryBuilder builder(patient, query);
  for (const StopSource source : kStopSources)
    for (const HungPart hung : kHungParts)
      printStops(source, hung, timeStops(builder, source, hung, options.presses));
}

}  // namespace palpa::bench

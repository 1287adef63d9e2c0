#include "anatomy/base/quantile.h"
#include "apps/bench/bench.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <limits>

#include "anatomy/base/error.h"
#include "apps/bench/bench_patients.h"
#include "apps/bench/loop_segment.h"
#include "apps/bench/stop_rig.h"
#include "apps/bench/timing.h"

namespace palpa::bench {
namespace {

constexpr int kBlocks = 10, kResamples = 2000;
constexpr std::uint64_t kBootstrapSeed = 1;
constexpr int kTorsoTriangles = 100'000;

struct Measured {
  LoopTimes ours, bare;
  std::vector<double> ratios;            // of the 99 % quantiles, one a block
  std::vector<double> costs, costs_p99;  // us, of our steps, one a segment
  std::uint64_t contacts = 0;
};

void add(LoopTimes& all, const LoopTimes& more) {
  all.late.add(more.late);
  all.missed += more.missed;
  all.scheduling = more.scheduling;
}

Measured measure(const LoopSurroundings& around, std::int64_t segment_ns) {
  Measured all;
  std::array<LoopTimes, 2> block;
  int segment = 0;
  for (const Turn turn : abbaOrder(kBlocks)) {
    LoopTimes& times = block[static_cast<std::size_t>(turn)];
    if (turn == Turn::a) {
      const OurTimes ours = runOurSegment(around, segment_ns);
      add(times, ours.times);
      all.costs.push_back(ours.cost.median_us);
      all.costs_p99.push_back(ours.cost.p99_us);
      all.contacts += ours.contacts;
    } else {
      add(times, runBareSegment(around, segment_ns));
    }
    if (++segment % 4) continue;
    const double bare = block[1].late.quantile(0.99);
    all.ratios.push_back(bare > 0 ? block[0].late.quantile(0.99) / bare
                                  : std::numeric_limits<double>::quiet_NaN());
    add(all.ours, block[0]);
    add(all.bare, block[1]);
    block = {};
  }
  return all;
}

void printLoop(const char* loop, const LoopTimes& times, nlohmann::json params) {
  params["loop"] = loop;
  params["scheduling"] = times.scheduling;
  params["ticks"] = times.late.count();
  const runtime::TimeSpread late = runtime::spreadOf(times.late);
  print("lateness_median", late.median_us, "us", params);
  print("lateness_p99", late.p99_us, "us", params);
  print("lateness_p999", late.p999_us, "us", params);
  print("lateness_max", late.max_us, "us", params);
  print("missed_ticks", static_cast<double>(times.missed), "1", params);
}

void printRatio(const Measured& all, nlohmann::json params) {
  params["blocks"] = kBlocks;
  params["order"] = "ABBA";
  params["ratios"] = all.ratios;
  params["interval"] = "95 % bootstrap of the median";
  params["resamples"] = kResamples;
  const ConfidenceInterval interval = bootstrapMedian(all.ratios, kResamples, kBootstrapSeed);
  print("lateness_ratio_p99", median(all.ratios), "1", params);
  print("lateness_ratio_p99_low", interval.low, "1", params);
  print("lateness_ratio_p99_high", interval.high, "1", params);
}

void report(const LoopSurroundings& around, const LoopBenchOptions& options,
            nlohmann::json params) {
  const int before = around.scene ? around.scene->frames() : 0;
  const Measured all = measure(around, std::llround(1e9 * options.seconds / (4 * kBlocks)));
  if (around.scene) params["frames"] = around.scene->frames() - before;
  printLoop("ours", all.ours, params);
  printLoop("bare", all.bare, params);
  printRatio(all, params);
  params["loop"] = "ours";
  params["ticks_in_contact"] = all.contacts;
  print("step_cost_median", median(all.costs), "us", params);
  print("step_cost_p99", median(all.costs_p99), "us", params);
}

}  // namespace

void benchLoop(const LoopBenchOptions& options) {
  const anatomy::Patient patient = torsoPatient(kTorsoTriangles);
  const anatomy::SurfaceQuery query(patient);
  const anatomy::LocalGeometryBuilder builder(patient, query);
  std::unique_ptr<SceneLoad> scene;
  std::string drawn;
  try {
    scene = std::make_unique<SceneLoad>();
    drawn = "up to 30 Hz, " + scene->drawnOn();
  } catch (const palpa::Error& e) {
    drawn = std::string("none: ") + e.what();
  }
  const LoopSurroundings around{
      {}, builder, scene.get(), std::llround(1e9 / options.rate_Hz), options.cpu};
  const nlohmann::json params{{"rate_hz", options.rate_Hz},
                              {"seconds", options.seconds},
                              {"scene", drawn},
                              {"geometry_hz", 60},
                              {"noise", "none"}};
  report(around, options, params);
  if (options.pages == 0) return;
  if (!scene)
    throw palpa::Error("there is no picture to show (" + drawn + ")", "--pages", "Leave it out");
  Onlookers onlookers(options.pages);
  scene->showTo(&onlookers);
  nlohmann::json watched = params;
  watched["pages"] = options.pages;
  report(around, options, watched);
  scene->showTo(nullptr);
  print("pictures_to_each_page",
        static_cast<double>(onlookers.pictures()) / options.pages / options.seconds, "1/s",
        watched);
}

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

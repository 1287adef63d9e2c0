#include "apps/bench/floor_bench.h"

#include <thread>

#include "apps/bench/floor_timing.h"
#include "apps/bench/metric.h"
#include "apps/bench/subtask_study.h"

namespace palpa::bench {
namespace {

constexpr int kSmallMap = 256;  // px, where it has to be quick
constexpr double kResolutions[] = {2e-6, 5e-6,
                                   40e-6};  // m: magnetic levitation, a fine linkage, a Falcon
constexpr double kOff = 0.15;               // of the threshold: steady motion above and below it

nlohmann::json floorParams(const SearchFloor& floor) {
  return {{"task", floor.task.id}, {"map_px", floor.task.map_px}};
}

void printMaking(const SearchFloor& floor) {
  nlohmann::json params = floorParams(floor);
  params["processors"] = std::thread::hardware_concurrency();
  print("gabor_precompute_s", floor.made_in_s, "s", params);
  print("gabor_table_mib", static_cast<double>(floor.made->rises->bytes()) / (1 << 20), "MiB",
        floorParams(floor));
}

void printLookUps(const SearchFloor& floor, bool quick) {
  const int blocks = quick ? 20 : 200;
  for (const LookUp& look : timeLookUps(floor, blocks)) {
    nlohmann::json params = floorParams(floor);
    params["places"] = look.places;
    print(look.name, look.median_us, "us", params);
  }
}

void printFloorTick(const SearchFloor& floor, bool quick) {
  const FloorTickTiming timing = timeFloorTick(floor, quick ? 20'000 : 200'000, quick ? 3 : 11);
  nlohmann::json params = floorParams(floor);
  params["augmentations"] = timing.pushing;
  params["parts"] = timing.parts;
  params["press_N"] = timing.press_N;
  print("floor_tick_median", timing.augmented.median_us, "us", params);
  print("floor_tick_p99", timing.augmented.p99_us, "us", params);
  print("floor_tick_pushed", timing.pushed, "1", params);
  print("floor_tick_plain_median", timing.plain.median_us, "us", params);
  print("floor_tick_plain_p99", timing.plain.p99_us, "us", params);
  print("floor_tick_ratio", timing.ratio.median, "1", params);
  print("floor_tick_ratio_low", timing.ratio.interval.low, "1", params);
  print("floor_tick_ratio_high", timing.ratio.interval.high, "1", params);
}

void printSubtasks(const SearchFloor& floor, bool quick) {
  const SpeedPart part = speedPart(floor, "scan");
  for (const double resolution : kResolutions) {
    nlohmann::json params{{"subtask", "scan"},
                          {"threshold_mm_per_s", 1e3 * part.threshold},
                          {"resolution_um", 1e6 * resolution}};
    for (const double share : {1 + kOff, 1 - kOff}) {
      params["speed_share"] = share;
      print("subtask_switches_per_s", switchesPerSecond(part, share, resolution, quick ? 8 : 64),
            "1/s", params);
    }
    params.erase("speed_share");
    for (const double acceleration : {0.2, 0.5, 2.0, 0.0}) {
      if (acceleration > 0)
        params["acceleration_m_per_s2"] = acceleration;
      else
        params["acceleration_m_per_s2"] = "at once";
      const Latency latency = subtaskLatency(part, acceleration, resolution, quick ? 40 : 400);
      print("subtask_latency_ms", latency.largest_ms, "ms", params);
      print("subtask_latency_median_ms", latency.median_ms, "ms", params);
    }
  }
}

}  // namespace

void benchFloor(bool quick) {
  const SearchFloor floor = searchFloor(quick ? kSmallMap : 0);
  printMaking(floor);
  printLookUps(floor, quick);
  printFloorTick(floor, quick);
  printSubtasks(floor, quick);
}

}  // namespace palpa::bench

#include <cmath>
#include <thread>

#include "anatomy/base/quantile.h"
#include "apps/bench/bench.h"
#include "apps/bench/bench_patients.h"
#include "apps/bench/search_floor.h"
#include "apps/bench/stroke.h"
#include "apps/bench/timing.h"
#include "apps/runtime/clock.h"

namespace palpa::bench {
namespace {

constexpr int kSmallMap = 256;  // px, where it has to be quick
constexpr double kResolutions[] = {2e-6, 5e-6,
                                   40e-6};  // m: magnetic levitation, a fine linkage, a coarse one
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

namespace {

constexpr double kWarmUp = 0.2;    // s: the first snapshot has to come
constexpr double kTouching = 0.1;  // N: ratios of smaller forces say nothing
constexpr double kBoneStiffness = 3000;

struct BenchWorld {
  int triangles;
  anatomy::Patient patient;
  anatomy::SurfaceQuery query;
  anatomy::LocalGeometryBuilder builder;
  explicit BenchWorld(int n)
      : triangles(n), patient(torsoPatient(n)), query(patient), builder(patient, query) {}
};

/// The force that the true surface would give.
Vec3 trueForce(const StrokeSettings& settings, const Vec3& p) {
  const TorsoPoint q = nearestOnTorso(p);
  return settings.stiffness * std::max((q.p - p).dot(q.n), 0.0) * q.n;
}

/// A frictionless proxy on the whole mesh: slow, exact for the mesh as it is, facets and all.
Vec3 proxyForce(const StrokeSettings& settings, const anatomy::SurfaceQuery& query, const Vec3& p) {
  const anatomy::SurfacePoint s = query.closest(0, p);
  return s.distance < 0 ? Vec3(settings.stiffness * (s.p_A - p)) : Vec3(Vec3::Zero());
}

struct ForceError {
  double rel_rms = 0, ratio_max = 0;
};

template <class Reference>
ForceError compare(const StrokeResult& stroke, Reference reference) {
  double difference2 = 0, size2 = 0, most = 0;
  for (const haptics::FlightRecord& r : stroke.records) {
    if (static_cast<double>(r.t_ns) * 1e-9 < kWarmUp) continue;
    const Vec3 f = unpack(r.f_contact_D), f_ref = reference(unpack(r.reading.p_DE));
    difference2 += (f - f_ref).squaredNorm();
    size2 += f_ref.squaredNorm();
    if (f_ref.norm() >= kTouching) most = std::max(most, f.norm() / f_ref.norm());
  }
  return {std::sqrt(difference2 / size2), most};
}

struct Jump {
  double blended = 0, unblended = 0;
};

/// How much, from tick to tick, the force leaves the one that the old snapshot would have given.
Jump refreshJump(const StrokeSettings& settings, const StrokeResult& stroke) {
  const haptics::TickConfig config = strokeConfig(settings);
  const auto on = [&](std::uint64_t snapshot, const haptics::FlightRecord& r) {
    haptics::ProbeState fresh;
    return haptics::probeContact(config.probe, config.coupling, stroke.snapshots[snapshot - 1],
                                 unpack(r.reading.p_DE), 1e-3, fresh)
        .f_D;
  };
  Jump jump;
  const auto& records = stroke.records;
  for (std::size_t i = 1; i < records.size(); ++i) {
    const std::uint64_t old = records[i - 1].snapshot;
    if (old == 0 || records[i].snapshot == old) continue;
    jump.unblended = std::max(jump.unblended,
                              (on(records[i].snapshot, records[i]) - on(old, records[i])).norm());
    Vec3 left = Vec3::Zero();
    for (std::size_t k = i; k < records.size() && records[k].snapshot == records[i].snapshot; ++k) {
      const Vec3 now = unpack(records[k].f_contact_D) - on(old, records[k]);
      jump.blended = std::max(jump.blended, (now - left).norm());
      left = now;
      if (records[k].t_ns - records[i].t_ns >= config.blend_ns) break;
    }
  }
  return jump;
}

double proxyCost(const StrokeSettings& settings, const BenchWorld& world,
                 const StrokeResult& stroke) {
  const runtime::SteadyClock clock;
  std::vector<double> each;
  for (std::size_t i = 0; i < stroke.records.size(); i += 7) {
    const std::int64_t start = clock.now();
    const Vec3 f = proxyForce(settings, world.query, unpack(stroke.records[i].reading.p_DE));
    const double took_us = 1e-3 * double(clock.now() - start);
    if (f.allFinite()) each.push_back(took_us);
  }
  return quantile(each, 0.5);
}

nlohmann::json paramsOf(const BenchWorld& world, const StrokeSettings& s) {
  return {{"triangles", world.triangles},
          {"stroke_hz", s.stroke_Hz},
          {"geometry_hz", s.geometry_Hz},
          {"stiffness_N_per_m", s.stiffness},
          {"noise", "none"}};
}

void printFidelity(const BenchWorld& world, const StrokeSettings& s, const StrokeResult& stroke) {
  nlohmann::json params = paramsOf(world, s);
  const ForceError truth = compare(stroke, [&](const Vec3& p) { return trueForce(s, p); });
  params["reference"] = "analytic surface";
  print("force_error_rel_rms", truth.rel_rms, "1", params);
  print("force_ratio_max", truth.ratio_max, "1", params);
  const ForceError mesh =
      compare(stroke, [&](const Vec3& p) { return proxyForce(s, world.query, p); });
  params["reference"] = "facets of the mesh";
  print("force_error_rel_rms_to_facets", mesh.rel_rms, "1", params);
}

void printJumps(const BenchWorld& world, StrokeSettings s) {
  s.geometry_Hz = 30;
  struct Case {
    const char* name;
    double stiffness, coupling;  // N/m
  };
  for (const Case& c :
       {Case{"tissue", s.stiffness, s.coupling}, Case{"bone", kBoneStiffness, kBoneStiffness}}) {
    s.stiffness = c.stiffness;
    s.coupling = c.coupling;
    const StrokeResult stroke = runStroke(s, world.builder);
    const Jump jump = refreshJump(s, stroke);
    nlohmann::json params = paramsOf(world, s);
    params["case"] = c.name;
    print("refresh_jump_max", jump.blended, "N", params);
    print("refresh_jump_unblended_max", jump.unblended, "N", params);
  }
}

void printCost(const BenchWorld& world, const StrokeSettings& s, const StrokeResult& stroke,
               bool quick) {
  const nlohmann::json params = paramsOf(world, s);
  const TickTiming hot = timeHot(s, stroke, quick ? 40'000 : 400'000);
  print("tick_hot_median", hot.median_us, "us", params);
  print("tick_hot_p99", hot.p99_us, "us", params);
  print("tick_paced_median", timePaced(s, stroke, quick ? 0.5 : 3).median_us, "us", params);
  print("reference_tick_median", proxyCost(s, world, stroke), "us", params);
}

}  // namespace

void benchHaptics(const HapticsBenchOptions& options) {
  for (const int triangles : {1'000, 10'000, 100'000, 1'000'000}) {
    if (triangles > options.most_triangles || (options.quick && triangles > 10'000)) continue;
    const BenchWorld world(triangles);
    StrokeSettings settings;
    settings.seconds = options.quick ? 3 : 20;
    for (const double stroke_Hz : {0.2, 1.0}) {
      settings.stroke_Hz = stroke_Hz;
      const StrokeResult stroke = runStroke(settings, world.builder);
      printFidelity(world, settings, stroke);
      printJumps(world, settings);
      if (stroke_Hz == 0.2) printCost(world, settings, stroke, options.quick);
    }
  }
  benchFloor(options.quick);
}

}  // namespace palpa::bench

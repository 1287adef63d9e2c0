#include "apps/bench/bench.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "anatomy/base/random.h"
#include "anatomy/parametric/parametric_patient.h"
#include "anatomy/query/skin_dimple.h"
#include "anatomy/query/surface_query.h"
#include "apps/bench/bench_patients.h"
#include "apps/bench/point_locators.h"
#include "apps/bench/timing.h"
#include "apps/runtime/clock.h"
#include "apps/station/assets.h"

namespace palpa::bench {
namespace {

using Points = std::vector<Vec3>;

struct Where {
  const char* name;
  Points points;
};

/// A tool's way over the skin, 1 mm a millisecond, up to 2 mm in it and 5 mm above it.
Points alongAWay(int count) {
  Points points;
  for (int i = 0; i < count; ++i) {
    const double t = 1e-3 * i;
    const TorsoPoint at = torsoAt(0.08 * std::sin(11 * t), 0.06 * std::sin(7 * t + 1));
    points.push_back(at.p + (0.0015 + 0.0035 * std::sin(5 * t)) * at.n);
  }
  return points;
}

/// Anywhere over the skin, `low` to `high` from it.
Points anywhere(int count, double low, double high, const char* stream) {
  RandomStream random(1, stream);
  Points points;
  for (int i = 0; i < count; ++i) {
    const TorsoPoint at = torsoAt(random.uniform(-0.1, 0.1), random.uniform(-0.08, 0.08));
    points.push_back(at.p + random.uniform(low, high) * at.n);
  }
  return points;
}

double disagreement(PointLocator& ours, PointLocator& other, const Points& points) {
  double most = 0;
  for (const Vec3& p : points)
    most = std::max(most, std::abs((ours.closest(p) - p).norm() - (other.closest(p) - p).norm()));
  return most;
}

std::function<void(int)> asking(PointLocator& locator, const Points& points) {
  return [&](int i) {
    volatile double sink = locator.closest(points[i]).x();
    static_cast<void>(sink);
  };
}

void printRatio(PointLocator& ours, PointLocator& other, const Where& where,
                const nlohmann::json& at, bool quick) {
  nlohmann::json params = at;
  params["other"] = other.name();
  const int count = std::min<int>(static_cast<int>(where.points.size()), quick ? 200 : 1000);
  const Ratio ratio = compareQueries(quick ? 3 : 11, count, asking(ours, where.points),
                                     asking(other, where.points));
  print("closest_point_ratio", ratio.median, "1", params);
  print("closest_point_ratio_low", ratio.interval.low, "1", params);
  print("closest_point_ratio_high", ratio.interval.high, "1", params);
  const Points some(where.points.begin(), where.points.begin() + count);
  print("closest_point_disagreement", disagreement(ours, other, some), "m", params);
}

void benchClosest(bool quick) {
  const int triangles = quick ? 10'000 : 100'000, count = quick ? 2000 : 20'000;
  const anatomy::Patient patient = torsoPatient(triangles);
  const anatomy::TriangleMesh& mesh = patient.organs[0].mesh;
  const std::unique_ptr<PointLocator> ours = ourLocator(mesh);
  std::vector<std::unique_ptr<PointLocator>> others;
  others.push_back(vtkLocator(mesh));
  if (embreeIsThere()) others.push_back(embreeLocator(mesh));
  const std::array<Where, 3> places{
      {{"along a way, within 5 mm", alongAWay(count)},
       {"anywhere, within 20 mm", anywhere(count, -0.02, 0.02, "near")},
       {"anywhere, 100 to 300 mm away", anywhere(count, 0.1, 0.3, "far")}}};
  for (const Where& where : places) {
    nlohmann::json params{
        {"triangles", mesh.triangles.size()}, {"queries", where.name}, {"noise", "none"}};
    const QueryTiming hot = timeQueries(count, asking(*ours, where.points));
    print("closest_point_median", hot.median_us, "us", params);
    print("closest_point_p99", hot.p99_us, "us", params);
    print("closest_point_cold_median",
          timeCold(quick ? 20 : 200, asking(*ours, where.points)).median_us, "us", params);
    for (const auto& other : others) printRatio(*ours, *other, where, params, quick);
  }
}

/// Needles near the taught line: entry within 10 mm, direction within 15 degrees, tip up to 60 mm
/// deep.
struct NeedlePlace {
  Vec3 back, tip;
};
std::vector<NeedlePlace> needles(const anatomy::Patient& patient, int count) {
  RandomStream random(1, "needles");
  const Vec3 entry = patient.landmark(anatomy::landmark::kEntry);
  const Vec3 way = (patient.landmark(anatomy::landmark::kVeinTarget) - entry).normalized();
  std::vector<NeedlePlace> places;
  for (int i = 0; i < count; ++i) {
    const auto about = [&](double spread) {
      return Vec3(random.uniform(-spread, spread), random.uniform(-spread, spread),
                  random.uniform(-spread, spread));
    };
    const Vec3 direction = (way + about(0.15)).normalized(), from = entry + about(0.006);
    const double depth = random.uniform(0, 0.06);
    places.push_back({from + (depth - 0.07) * direction, from + depth * direction});
  }
  return places;
}

void benchNeedle(const anatomy::Patient& patient, bool quick) {
  const anatomy::SurfaceQuery query(patient);
  std::size_t triangles = 0;
  for (const auto& organ : patient.organs) triangles += organ.mesh.triangles.size();
  const int count = quick ? 500 : 8000;
  const std::vector<NeedlePlace> places = needles(patient, count);
  const nlohmann::json params{
      {"triangles", triangles}, {"organs", patient.organs.size()}, {"noise", "none"}};
  anatomy::NeedlePasses passes;
  const auto needle = [&](int i) { query.needle(places[i].back, places[i].tip, &passes); };
  std::vector<anatomy::NearMiss> misses(patient.organs.size());
  const auto near = [&](int i) { query.nearMisses(places[i].tip, places[i].back, misses); };
  const int cold = quick ? 20 : 200;
  const QueryTiming needle_hot = timeQueries(count, needle), near_hot = timeQueries(count, near);
  print("needle_all_organs_median", needle_hot.median_us, "us", params);
  print("needle_all_organs_p99", needle_hot.p99_us, "us", params);
  print("needle_all_organs_cold_median", timeCold(cold, needle).median_us, "us", params);
  print("near_miss_all_organs_median", near_hot.median_us, "us", params);
  print("near_miss_all_organs_p99", near_hot.p99_us, "us", params);
  print("near_miss_all_organs_cold_median", timeCold(cold, near).median_us, "us", params);
}

/// A contact that moves over the skin, deeper and shallower, and leans: every update is another
/// load.
void benchSkin(const anatomy::Patient& patient, bool quick) {
  anatomy::SkinDeflection::Settings settings;
  settings.per_ring = 84;
  const runtime::SteadyClock clock;
  const std::int64_t start = clock.now();
  anatomy::SkinDeflection skin(settings);
  const double factorised_us = 1e-3 * static_cast<double>(clock.now() - start);
  const int count = quick ? 160 : 1600;
  const auto update = [&](int i) {
    skin.update(0.003 * std::sin(0.1 * i), {0.9 * std::cos(0.07 * i), 0.3});
  };
  const nlohmann::json params{{"nodes", skin.disc().nodes.size()}, {"noise", "none"}};
  const QueryTiming timing = timeQueries(count, update);
  print("skin_deflection_set_up", factorised_us, "us", params);
  print("skin_deflection_update", timing.median_us, "us", params);
  print("skin_deflection_update_p99", timing.p99_us, "us", params);

  const anatomy::TriangleMesh& mesh = patient.organ(Organ::skin).mesh;
  anatomy::SkinDimple dimple(mesh, settings);
  const Vec3 entry = patient.landmark(anatomy::landmark::kEntry);
  std::size_t moved = 0;
  const auto press = [&](int i) {
    const Vec3 p = entry + 0.005 * Vec3(std::sin(0.01 * i), 0, std::cos(0.013 * i));
    moved = dimple.press({p, -Vec3::UnitY(), 0.003, Vec3::UnitX()}).size();
  };
  const QueryTiming whole = timeQueries(count, press);
  print("skin_deflection_frame", whole.median_us, "us",
        {{"nodes", skin.disc().nodes.size()},
         {"vertices", mesh.points.size()},
         {"vertices_moved", moved},
         {"noise", "none"}});
}

}  // namespace

void benchAnatomy(const AnatomyBenchOptions& options) {
  benchClosest(options.quick);
  const anatomy::Patient patient = anatomy::buildPatient(anatomy::drawParameters(
      anatomy::readPopulation(station::assetFile("patients/reference.json").string()),
      anatomy::Side::right, 0));
  benchNeedle(patient, options.quick);
  benchSkin(patient, options.quick);
}

}  // namespace palpa::bench

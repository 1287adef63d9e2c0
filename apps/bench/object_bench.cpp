#include <algorithm>
#include <cmath>

#include "anatomy/base/random.h"
#include "apps/bench/bench.h"
#include "apps/bench/timing.h"
#include "apps/calibrate/learnt_object.h"
#include "apps/station/assets.h"
#include "apps/station/station_file.h"
#include "apps/twin/phantom/layered_phantom.h"
#include "apps/twin/setup_bench.h"

namespace palpa::bench {
namespace {

using calibration::MappedArea;
using calibration::ObjectMap;
using Eigen::Vector2d;

constexpr int kPlacesAcross = 5, kPlacesAlong = 4;

class SilentGuide final : public calibrate::Guide {
 public:
  void ask(const std::string&) override {}
  void progress(const std::string&, int, int, const std::string&) override {}
};

/// What the elements say: force by depth at 3 mm.
double trueStiffness(const twin::LayeredPhantom& object, const Vector2d& p) {
  return object.table.at(p, calibrate::kLearntDepth).z() / calibrate::kLearntDepth;
}

/// What rubs by what presses, sliding fast under half a newton, as the touches do.
double trueFriction(const twin::LayeredPhantom& object, const Vector2d& p) {
  constexpr double kUnder_N = 0.5;
  const twin::SiliconeLaw law;
  return object.rubs.at(p.x()) * law.mu * std::pow(kUnder_N, law.load_power);
}

/// Twenty places, each somewhere in a field of its own of 20 x 25 mm: farther apart, mostly, than
/// what is felt at one place reaches.
std::vector<Vector2d> placesApart(const MappedArea& area, std::uint64_t seed) {
  constexpr double kOfItsField = 0.5;  // it lies in the middle half
  RandomStream random(seed, "object_bench.places");
  const Vector2d field =
      (area.high - area.low).cwiseQuotient(Vector2d(kPlacesAcross, kPlacesAlong));
  std::vector<Vector2d> places;
  for (int j = 0; j < kPlacesAlong; ++j)
    for (int i = 0; i < kPlacesAcross; ++i) {
      const Vector2d in(0.5 + kOfItsField * (random.uniform() - 0.5),
                        0.5 + kOfItsField * (random.uniform() - 0.5));
      places.push_back(area.low + field.cwiseProduct(Vector2d(i, j) + in));
    }
  return places;
}

}  // namespace

std::vector<std::string> mappedObjects() {
  std::vector<std::string> names;
  for (const twin::LayeredPhantom& object :
       twin::readLayered(station::assetFile("phantoms/layered.json")).phantoms)
    names.push_back(object.name);
  return names;
}

ObjectFigures objectFigures(const std::string& name, std::uint64_t seed) {
  const station::Station station =
      station::readStation(station::assetFile("stations/palpation_bench.json"));
  const std::vector<twin::LayeredPhantom> objects =
      twin::readSolvedLayered(station::assetFile("phantoms/layered.json"),
                              station::assetFile("phantoms/layered.tables.json"));
  const auto object = std::find_if(objects.begin(), objects.end(),
                                   [&](const auto& one) { return one.name == name; });
  const MappedArea area = calibrate::objectArea();
  twin::SetupBench rig(station, seed);
  SilentGuide guide;
  const calibrate::ObjectTouches touched =
      calibrate::collectObject({station, rig, guide}, name, area);
  const calibrate::LearntObject learnt = calibrate::learnObject(touched.touches);
  ObjectFigures figures;
  figures.touches = learnt.used;
  figures.seconds = touched.seconds;
  const std::vector<Vector2d> all = placesOf(area), some = placesApart(area, seed);
  for (const Vector2d& p : all) {
    const double truth = trueStiffness(*object, p);
    figures.within_10 += std::abs(learnt.stiffness.at(p).value / truth - 1) <= 0.1;
    figures.friction_within_10 +=
        std::abs(learnt.friction.at(p).value / trueFriction(*object, p) - 1) <= 0.1;
  }
  figures.within_10 /= static_cast<double>(all.size());
  figures.friction_within_10 /= static_cast<double>(all.size());
  for (const Vector2d& p : some) {
    const calibration::MapValue v = learnt.stiffness.at(p);
    const double truth = trueStiffness(*object, p);
    figures.covered += v.low <= truth && truth <= v.high;
  }
  figures.covered /= static_cast<double>(some.size());
  return figures;
}

void benchObject(const ObjectBenchOptions& options) {
  const std::vector<std::string> objects = mappedObjects();
  double covered = 0;
  for (const std::string& name : objects) {
    ObjectFigures sum, worst;
    worst.within_10 = 1;
    for (int i = 1; i <= options.seeds; ++i) {
      const ObjectFigures one = objectFigures(name, static_cast<std::uint64_t>(i));
      sum.covered += one.covered / options.seeds;
      sum.within_10 += one.within_10 / options.seeds;
      sum.friction_within_10 += one.friction_within_10 / options.seeds;
      sum.touches += one.touches;
      sum.seconds += one.seconds / options.seeds;
      worst.within_10 = std::min(worst.within_10, one.within_10);
    }
    const nlohmann::json params{{"object", name}, {"seeds", options.seeds}, {"data", "simulated"}};
    print("object_within_10_percent", sum.within_10, "1", params);
    print("object_within_10_percent_worst", worst.within_10, "1", params);
    print("object_friction_within_10_percent", sum.friction_within_10, "1", params);
    print("object_coverage95", sum.covered, "1", params);
    print("object_touches", sum.touches / options.seeds, "1", params);
    print("object_seconds", sum.seconds, "s", params);
    covered += sum.covered / static_cast<double>(objects.size());
  }
  print("object_coverage95_all", covered, "1",
        {{"seeds", options.seeds * static_cast<int>(objects.size())}, {"data", "simulated"}});
}

}  // namespace palpa::bench

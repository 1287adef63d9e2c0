#include <algorithm>
#include <cmath>

#include "anatomy/base/random.h"
#include "apps/bench/bench.h"
#include "apps/bench/contact_study.h"
#include "apps/bench/timing.h"
#include "apps/calibrate/learnt_object.h"
#include "apps/station/assets.h"
#include "apps/station/material_files.h"
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

/// Where the object is to feel as hard as its one law says, half as much again [chosen], wherever
/// it is pressed: the hand's force at each place against that, through a sensor and a Kalman
/// filter.
double renderedOff(const twin::LayeredPhantom& object, const haptics::TouchAugmentation& law,
                   const std::vector<Vector2d>& places, std::uint64_t seed) {
  constexpr double kPressed = 4e-3, kDown_s = 0.5, kHeld_s = 0.3, kLeast_N = 0.1;
  const double wanted = law.surface.contact.target.constant;
  RelativeRms error;
  for (const Vector2d& p : places) {
    const Vec3 place(p.x(), p.y(), 0);
    twin::LayeredPhantomTwin phantom(object, {});
    TouchRecorder recorder(Noise::kalman, ++seed);
    twin::LedTip tip(place + 2e-3 * Vec3::UnitZ());
    tip.press(place, kPressed, kDown_s, kHeld_s);
    haptics::TouchAugmentationState state;
    for (double t = 0; t < tip.duration(); t += kPhantomTick) {
      const Vec3 true_tip = tip.at(t);
      const PhantomTick tick = recorder.record(true_tip, phantom.step(true_tip, kPhantomTick));
      const haptics::AugmentedTouch added =
          augmentTouch(law, {}, {{{true, tick.tip + law.tip_radius * Vec3::UnitZ(), tick.f_r}, {}}},
                       kPhantomTick, &state);
      if (tick.truth.f_n < kLeast_N) continue;
      const Vec3 target(0, 0, wanted * tick.truth.x);
      error.add((tick.truth.f_n + added.f_d[0].z() - target.z()) * Vec3::UnitZ(), target);
    }
  }
  return error.value();
}

/// The one law of the object, as `palpa calibrate material` finds it in its middle.
haptics::TouchAugmentation lawInTheMiddle(const calibrate::Scene& scene, const std::string& name) {
  constexpr double kPress_s = 20, kHarder = 1.5, kLeastFelt = 0.05;
  const calibration::SoftContact middle = calibration::identifySoftContact(
      calibrate::pressesOf(calibrate::collectPresses(scene, name, {}, kPress_s)));
  haptics::TouchAugmentation law;
  law.surface.contact.real = middle.law;
  law.surface.contact.x0 = middle.x0;
  law.surface.contact.friction =
      station::readLumps(station::assetFile("materials/lumps.json")).friction;
  law.surface.contact.least_contact = kLeastFelt;
  const double depth = calibrate::kLearntDepth;
  law.surface.contact.target.constant =
      kHarder * haptics::forceOf(middle.law, depth - middle.x0, 0) / depth;
  law.tip_radius = scene.station.sample->tip_radius;
  return law;
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
  haptics::TouchAugmentation law = lawInTheMiddle({station, rig, guide}, name);
  figures.rendered_off_unmapped = renderedOff(*object, law, some, seed);
  law.map = station::learntMap(calibrate::mappedObjectOf(learnt, area), law.surface.contact);
  figures.rendered_off = renderedOff(*object, law, some, seed);
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
      sum.rendered_off += one.rendered_off / options.seeds;
      sum.rendered_off_unmapped += one.rendered_off_unmapped / options.seeds;
      sum.touches += one.touches;
      sum.seconds += one.seconds / options.seeds;
      worst.within_10 = std::min(worst.within_10, one.within_10);
    }
    const nlohmann::json params{{"object", name}, {"seeds", options.seeds}, {"data", "simulated"}};
    print("object_within_10_percent", sum.within_10, "1", params);
    print("object_within_10_percent_worst", worst.within_10, "1", params);
    print("object_friction_within_10_percent", sum.friction_within_10, "1", params);
    print("object_coverage95", sum.covered, "1", params);
    nlohmann::json rendered = params;
    for (const bool mapped : {true, false}) {
      rendered["map"] = mapped;
      print("object_stiffness_rel_error", mapped ? sum.rendered_off : sum.rendered_off_unmapped,
            "1", rendered);
    }
    print("object_touches", sum.touches / options.seeds, "1", params);
    print("object_seconds", sum.seconds, "s", params);
    covered += sum.covered / static_cast<double>(objects.size());
  }
  print("object_coverage95_all", covered, "1",
        {{"seeds", options.seeds * static_cast<int>(objects.size())}, {"data", "simulated"}});
}

}  // namespace palpa::bench

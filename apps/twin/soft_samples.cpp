#include "apps/twin/soft_samples.h"

#include <algorithm>

#include "anatomy/base/error.h"
#include "anatomy/base/nearest_word.h"
#include "anatomy/base/units.h"
#include "apps/station/assets.h"
#include "apps/twin/bench_truth.h"
#include "apps/twin/phantom/phantom_file.h"

namespace palpa::twin {
namespace {

/// What a key of the station's section "twin" names: phantoms, and their tables beside them.
struct PhantomFiles {
  std::filesystem::path phantoms, tables;
  PhantomFiles(const station::Station& station, const char* key) {
    const std::string file = "phantoms/" + station.file.text(std::string("twin/") + key);
    phantoms = station::assetFile(file + ".json");
    tables = station::assetFile(file + ".tables.json");
  }
};

std::vector<Phantom> samplesOf(const station::Station& station) {
  const PhantomFiles files(station, "samples");
  return readSolved(files.phantoms, files.tables);
}

std::vector<LayeredPhantom> objectsOf(const station::Station& station) {
  if (!station.file.has("twin/objects")) return {};
  const PhantomFiles files(station, "objects");
  return readSolvedLayered(files.phantoms, files.tables);
}

template <class Phantoms>
auto namedIn(const Phantoms& phantoms, const std::string& name) {
  return std::find_if(phantoms.begin(), phantoms.end(),
                      [&](const auto& phantom) { return phantom.name == name; });
}

[[noreturn]] void refuseName(const std::string& name, const std::vector<std::string>& known) {
  std::string all;
  for (const std::string& one : known) all += (all.empty() ? "" : ", ") + one;
  throw UsageError("is not one of the simulated samples" + didYouMean(name, known),
                   "\"" + name + "\"", "Known are " + all);
}

template <class Named>
void addNames(const std::vector<Named>& named, std::vector<std::string>* all) {
  for (const Named& one : named) all->push_back(one.name);
}

}  // namespace

SampleTwin::SampleTwin(const station::Station& station, const std::string& name, std::uint64_t seed,
                       const TopShape& top) {
  if (!station.sample)
    throw UsageError("has no \"sample\"", station.file.name(),
                     "Say where it lies: sample/X_WP, sample/tip_radius_mm");
  X_WP_ = trueSample(station, seed);
  radius_ = station.sample->tip_radius;
  if (std::abs(putDown(station, name, top) - radius_) > 1e-6)
    station.file.refuse("sample/tip_radius_mm", "is not that of the simulated samples");
  if (!top.flat() && (has_lump_ || !std::holds_alternative<CurvedPhantomTwin>(phantom_)))
    throw UsageError("is cast in flat blocks only", "\"" + name + "\"", "Choose the first sample");
}

/// Returns the radius of the tool that it was solved for, m.
double SampleTwin::putDown(const station::Station& station, const std::string& name,
                           const TopShape& top) {
  const std::vector<Phantom> samples = samplesOf(station);
  const auto fingers = [&](const Phantom& sample, const SiliconeLaw& law) {
    has_lump_ = sample.block.lump.has_value();
    if (top.flat())
      phantom_.emplace<PhantomFingersTwin>(sample.table, sample.both, law);
    else
      phantom_.emplace<CurvedPhantomTwin>(sample.table, law, top);
    return sample.table.tool_radius;
  };
  if (name.empty()) return fingers(samples.front(), SiliconeLaw{});
  if (const auto one = namedIn(samples, name); one != samples.end())
    return fingers(*one, SiliconeLaw{});
  const std::vector<LayeredPhantom> objects = objectsOf(station);
  if (const auto one = namedIn(objects, name); one != objects.end()) {
    phantom_.emplace<LayeredPhantomTwin>(*one, SiliconeLaw{});
    return one->table.tool_radius;
  }
  const std::vector<SoftSurface> surfaces =
      readSoftSurfaces(station::assetFile("materials/surfaces.json"));
  if (const auto one = namedIn(surfaces, name); one != surfaces.end())
    return fingers(one->madeOf(samples.front()), one->law);
  std::vector<std::string> known;
  addNames(samples, &known);
  addNames(objects, &known);
  addNames(surfaces, &known);
  refuseName(name, known);
}

Vec3 SampleTwin::middleIn(const Pose& X_WT) const {
  return X_WP_.inverse() * (X_WT * Vec3(0, 0, -radius_));
}

Vec3 SampleTwin::lowestIn(const Pose& X_WT) const {
  return middleIn(X_WT) - radius_ * Vec3::UnitZ();
}

SampleTouch SampleTwin::step(const Pose& X_WT, double dt) {
  if (auto* curved = std::get_if<CurvedPhantomTwin>(&phantom_)) {
    const PhantomTouch touch = curved->step(middleIn(X_WT), dt);
    return told(touch, middleIn(X_WT) - radius_ * touch.n);
  }
  const Vec3 lowest_P = lowestIn(X_WT);
  if (auto* object = std::get_if<LayeredPhantomTwin>(&phantom_))
    return told(object->step(lowest_P, dt), lowest_P);
  return told(std::get<PhantomFingersTwin>(phantom_).step(lowest_P, dt), lowest_P);
}

std::array<SampleTouch, 2> SampleTwin::step(const std::array<Pose, 2>& X_WT, double dt) {
  const std::array<Vec3, 2> lowest_P{lowestIn(X_WT[0]), lowestIn(X_WT[1])};
  auto* const sample = std::get_if<PhantomFingersTwin>(&phantom_);
  if (!sample)
    throw Error("cannot be felt with two tools", "the simulated object",
                "Choose a sample with a flat top");
  const std::array<PhantomTouch, 2> touches = sample->step(lowest_P, dt);
  return {told(touches[0], lowest_P[0]), told(touches[1], lowest_P[1])};
}

SampleTouch SampleTwin::told(const PhantomTouch& touch, const Vec3& lowest_P) const {
  SampleTouch told;
  told.f_W = X_WP_.linear() * touch.f;
  told.p_W = X_WP_ * lowest_P;
  if (has_lump_) told.lump_W = X_WP_.linear() * touch.lump;
  return told;
}

namespace {

constexpr double kStand = 2000, kStandDamping = 6,
                 // N/m, N s/m; m: so deep it sits in the stand [chosen: it rests within 0.1 mm, and
                 // does not bounce]
    kNest = 1e-3;

Vec3 mirrored(const Vec3& p) { return {-p.x(), p.y(), p.z()}; }

}  // namespace

/// Pushes up what comes down on it, and toward its middle what still sits in it.
Vec3 HeldObject::onStand() const {
  Vec3 f = Vec3::Zero();
  if (p_.z() < 0) f.z() = std::max(-kStand * p_.z() - kStandDamping * v_.z(), 0.0);
  if (p_.z() < kNest) f.head<2>() = -kStand * p_.head<2>() - kStandDamping * v_.head<2>();
  return f;
}

std::array<Vec3, 2> HeldObject::step(const std::array<Vec3, 2>& p_O, double dt, bool held) {
  std::array<Vec3, 2> f;
  Vec3 on_object(0, 0, -shape_.mass * kGravity);
  for (std::size_t t = 0; t < 2; ++t) {
    const Vec3 from = p_O[t] - p_,
               out = t == 0 ? from : mirrored(from);  // in the side's frame its outward normal is z
    const Vec3 touch = sides_[t].step({-out.z(), out.y(), out.x() - shape_.half}, dt).f;
    const Vec3 on_tool(touch.z(), touch.y(), -touch.x());
    f[t] = t == 0 ? on_tool : mirrored(on_tool);
    on_object -= f[t];
  }
  if (held) return f;
  v_ += (on_object + onStand()) / shape_.mass * dt;
  p_ += v_ * dt;
  return f;
}

HeldObjectTwin::HeldObjectTwin(const station::Station& station, const HeldObject::Shape& shape,
                               const Pose& X_WO, std::uint64_t seed)
    : X_WO_(trueSample(station, seed) * station.sample->X_WP.inverse() * X_WO),
      radius_(station.sample->tip_radius),
      object_(shape, samplesOf(station).front().table, SiliconeLaw{}) {}

std::array<SampleTouch, 2> HeldObjectTwin::step(const std::array<Pose, 2>& X_WT, double dt) {
  const double r = radius_;
  std::array<Vec3, 2> p_O;
  for (std::size_t t = 0; t < 2; ++t)
    p_O[t] = X_WO_.inverse() * (X_WT[t] * Vec3(0, 0, -r)) - (t == 0 ? r : -r) * Vec3::UnitX();
  const std::array<Vec3, 2> f_O = object_.step(p_O, dt);
  std::array<SampleTouch, 2> touches;
  for (std::size_t t = 0; t < 2; ++t) {
    touches[t].f_W = X_WO_.linear() * f_O[t];
    touches[t].p_W = X_WO_ * p_O[t];
  }
  return touches;
}

}  // namespace palpa::twin

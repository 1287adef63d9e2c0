#include "anatomy/volume/ct_landmarks.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>
#include <numbers>

#include "anatomy/geometry/error.h"
#include "anatomy/surface_query.h"

namespace palpa::anatomy {
namespace {

constexpr double kMeanLength = 0.1494, kShortestWhole = 0.130;  // clavicle, model sheet 5: 149.4 +- 10.3 mm
constexpr double kBelow = 0.010, kSternalRegion = 0.012;
constexpr double kSteepest = 30 * std::numbers::pi / 180, kLeastClearance = 1e-3, kNeedle = 0.060, kLeastMedial = 0.15;

Vec3 along(const std::vector<Vec3>& line, double s) {
  for (std::size_t i = 1; i < line.size(); ++i) {
    const double step = (line[i] - line[i - 1]).norm();
    if (s <= step) return line[i - 1] + (line[i] - line[i - 1]) * (s / step);
    s -= step;
  }
  return line.back();
}

class Marker {
 public:
  Marker(const Clavicle3& clavicle, const Vein& vein, const Seeds& seeds, CtPatient* ct)
      : clavicle_(clavicle), vein_(vein), seeds_(seeds), patient_(ct->patient), ct_(*ct), query_(ct->patient) {}

  void run() {
    markBone();
    set(landmark::kNotch, [&] { return notch(); });
    set(landmark::kEntry, [&] { return entry(); });
    const SurfacePoint on_skin = query_.closest(surface(Organ::skin), patient_.landmarks[landmark::kEntry]);
    patient_.landmarks[landmark::kEntry] = on_skin.p_A;
    set(landmark::kVeinTarget, [&] { return target(); });
  }

 private:
  template <class Propose>
  void set(const char* key, Propose propose) {
    const auto given = seeds_.find(key);
    patient_.landmarks[key] = given == seeds_.end() ? propose() : given->second;
  }

  void remark(const std::string& words) { ct_.remarks.push_back(words); }

  int surface(Organ organ) const {
    for (std::size_t i = 0; i < patient_.organs.size(); ++i)
      if (patient_.organs[i].organ == organ) return static_cast<int>(i);
    return -1;
  }

  void markBone() {
    double whole = clavicle_.length;
    char words[160];
    if (clavicle_.leaves_volume) {
      std::snprintf(words, sizeof words, "The clavicle's acromial end leaves the volume: %.0f mm of it are inside", 1e3 * clavicle_.length);
      remark(words);
      if (whole < kShortestWhole) {
        whole = kMeanLength;
        remark("Its thirds are estimated for a bone of 149 mm, the adult mean");
      }
    }
    patient_.landmarks[landmark::kSternalEnd] = clavicle_.axis_S.front();
    patient_.landmarks[landmark::kAcromialEnd] = clavicle_.axis_S.back();
    patient_.landmarks[landmark::kMedialThird] = along(clavicle_.axis_S, whole / 3);
    patient_.landmarks[landmark::kLateralThird] = along(clavicle_.axis_S, 2 * whole / 3);
    Vec3 angle = clavicle_.axis_S.front();
    double most = -1e9;
    for (const Vec3& p : patient_.organs[static_cast<std::size_t>(surface(Organ::clavicle))].mesh.points)
      if ((p - clavicle_.axis_S.front()).norm() < kSternalRegion && p.y() + p.z() > most) most = p.y() + p.z(), angle = p;
    patient_.landmarks[landmark::kSternalEndPosteriorSuperior] = angle;
  }

  /// First skin met on the way from in front to the back.
  Vec3 skinInFrontOf(const Vec3& p) const {
    const int skin = surface(Organ::skin);
    for (const RayHit& hit : query_.cast(p - 0.3 * Vec3::UnitY(), Vec3::UnitY(), 0.6))
      if (hit.surface == skin && hit.entering) return p + (hit.s - 0.3) * Vec3::UnitY();
    return query_.closest(skin, p).p_A;
  }

  Vec3 notch() const {
    const Vec3 other = ct_.seeds.count("midline") ? ct_.seeds.at("midline") : clavicle_.axis_S.front();
    Vec3 top(other.x(), clavicle_.axis_S.front().y(), -1e9);
    for (const OrganSurface& organ : patient_.organs)
      if (organ.organ == Organ::sternum)
        for (const Vec3& p : organ.mesh.points)
          if (std::abs(p.x() - other.x()) < 0.010 && p.z() > top.z()) top = {other.x(), p.y(), p.z()};
    if (top.z() < -1e8) top.z() = clavicle_.axis_S.front().z();
    return skinInFrontOf(top);
  }

  Vec3 entry() const {
    const Vec3 third = patient_.landmarks.at(landmark::kMedialThird);
    double lower = third.z();
    for (const Vec3& p : patient_.organs[static_cast<std::size_t>(surface(Organ::clavicle))].mesh.points)
      if (std::abs(p.x() - third.x()) < 3e-3 && p.y() < third.y()) lower = std::min(lower, p.z());
    return skinInFrontOf({third.x(), third.y(), lower - kBelow});
  }

  double clearance(int bone, const Vec3& from, const Vec3& to) const {
    double least = std::numeric_limits<double>::infinity();
    for (int i = 0; i <= 60; ++i) least = std::min(least, query_.closest(bone, from + (to - from) * i / 60).distance);
    return least;
  }

  /// Nothing but skin, muscle and the vein on the way.
  bool meetsVeinFirst(const Vec3& from, const Vec3& to) const {
    const Vec3 direction = (to - from).normalized();
    for (const RayHit& hit : query_.cast(from, direction, (to - from).norm()))
      if (hit.organ != Organ::skin && hit.organ != Organ::muscle) return hit.organ == Organ::vein;
    return true;
  }

  /// The vein's line, and places half a radius off it.
  std::vector<Vec3> candidates() const {
    std::vector<Vec3> places;
    for (std::size_t i = 0; i < vein_.line_S.size(); ++i)
      for (const Vec3& off : {Vec3(0, 0, 0), Vec3(0, 0, 0.5), Vec3(0, -0.5, 0), Vec3(0, -0.35, 0.35)}) places.push_back(vein_.line_S[i] + vein_.radius[i] * off);
    return places;
  }

  Vec3 target() {
    const Vec3 entry = patient_.landmarks.at(landmark::kEntry), normal = query_.closest(surface(Organ::skin), entry).n_A;
    const double medially = patient_.side == Side::right ? 1 : -1;
    const Vec3 aim = (patient_.landmarks.at(landmark::kSternalEndPosteriorSuperior) - entry).normalized();
    const int bone = surface(Organ::clavicle);
    double best = 1e9;
    Vec3 found = vein_.line_S[vein_.line_S.size() / 2];
    bool free = false, shallow = false;
    for (const Vec3& p : candidates()) {
      const Vec3 way = p - entry;
      const double angle = std::asin(std::clamp(-way.normalized().dot(normal), -1.0, 1.0));
      const bool clear = clearance(bone, entry, p) >= kLeastClearance && meetsVeinFirst(entry, p);
      const double worth = std::acos(std::clamp(way.normalized().dot(aim), -1.0, 1.0)) + 4 * std::max(0.0, angle - kSteepest) + (clear ? 0 : 3) +
                           20 * std::max(0.0, way.norm() - kNeedle) + (way.z() < 0 ? 0.2 : 0) +
                           (medially * way.x() < kLeastMedial * way.norm() ? 2 : 0);
      if (worth < best) best = worth, found = p, free = clear, shallow = angle <= kSteepest;
    }
    if (!free) remark("No straight way from the entry to the vein is free of bone and lung: move entry_point or vein_target by --seed-point");
    if (!shallow) remark("The line to the vein meets the skin at more than 30 degrees");
    return found;
  }

  const Clavicle3& clavicle_;
  const Vein& vein_;
  const Seeds& seeds_;
  Patient& patient_;
  CtPatient& ct_;
  SurfaceQuery query_;
};

}  // namespace

void markLandmarks(const Clavicle3& clavicle, const Vein& vein, const Seeds& seeds, CtPatient* ct) { Marker(clavicle, vein, seeds, ct).run(); }

}  // namespace palpa::anatomy

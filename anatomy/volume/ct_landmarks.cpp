#include "anatomy/volume/ct_patient.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>
#include <numbers>

#include "anatomy/base/error.h"
#include "anatomy/query/surface_query.h"
#include "anatomy/volume/seed_file.h"

namespace palpa::anatomy {
namespace {

// m, of a clavicle: 149.4 +- 10.3 mm (`clavicle_length` in assets/patients/reference.json); what is
// shorter by 1.9 of these spreads is taken for cut off.
constexpr double kMeanLength = 0.1494, kShortestWhole = 0.130;
constexpr double kSuggestStep = 0.008;
constexpr double kBelow = 0.010, kSternalRegion = 0.012;
constexpr double kSteepest = 30 * std::numbers::pi / 180, kLeastClearance = 1e-3, kNeedle = 0.060,
                 kLeastMedial = 0.15;

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
      : clavicle_(clavicle),
        vein_(vein),
        seeds_(seeds),
        patient_(ct->patient),
        ct_(*ct),
        query_(ct->patient) {}

  void run() {
    markBone();
    set(landmark::kNotch, [&] { return notch(); });
    set(landmark::kEntry, [&] { return entry(); });
    const SurfacePoint on_skin =
        query_.closest(surface(Organ::skin), patient_.landmarks[landmark::kEntry]);
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
      std::snprintf(words, sizeof words,
                    "The clavicle's acromial end leaves the volume: %.0f mm of it are inside",
                    1e3 * clavicle_.length);
      remark(words);
      if (whole < kShortestWhole)
        whole = kMeanLength,
        remark("Its thirds are estimated for a bone of 149 mm, the adult mean");
      else
        remark("Its thirds are taken of what is inside");
    }
    patient_.landmarks[landmark::kSternalEnd] = clavicle_.axis_S.front();
    patient_.landmarks[landmark::kAcromialEnd] = clavicle_.axis_S.back();
    patient_.landmarks[landmark::kMedialThird] = along(clavicle_.axis_S, whole / 3);
    patient_.landmarks[landmark::kLateralThird] = along(clavicle_.axis_S, 2 * whole / 3);
    Vec3 angle = clavicle_.axis_S.front();
    double most = -1e9;
    for (const Vec3& p :
         patient_.organs[static_cast<std::size_t>(surface(Organ::clavicle))].mesh.points)
      if ((p - clavicle_.axis_S.front()).norm() < kSternalRegion && p.y() + p.z() > most)
        most = p.y() + p.z(), angle = p;
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
    const Vec3 other =
        ct_.seeds.count("midline") ? ct_.seeds.at("midline") : clavicle_.axis_S.front();
    Vec3 top(other.x(), clavicle_.axis_S.front().y(), -1e9);
    for (const OrganSurface& organ : patient_.organs)
      if (organ.organ == Organ::sternum)
        for (const Vec3& p : organ.mesh.points)
          if (std::abs(p.x() - other.x()) < 0.010 && p.z() > top.z())
            top = {other.x(), p.y(), p.z()};
    if (top.z() < -1e8) top.z() = clavicle_.axis_S.front().z();
    return skinInFrontOf(top);
  }

  Vec3 entry() const {
    const Vec3 third = patient_.landmarks.at(landmark::kMedialThird);
    double lower = third.z();
    for (const Vec3& p :
         patient_.organs[static_cast<std::size_t>(surface(Organ::clavicle))].mesh.points)
      if (std::abs(p.x() - third.x()) < 3e-3 && p.y() < third.y()) lower = std::min(lower, p.z());
    return skinInFrontOf({third.x(), third.y(), lower - kBelow});
  }

  /// Least distance from the way to bone, exact.
  double clearance(const Vec3& from, const Vec3& to) const {
    double least = std::numeric_limits<double>::infinity();
    for (std::size_t i = 0; i < patient_.organs.size(); ++i) {
      const Organ organ = patient_.organs[i].organ;
      if (organ == Organ::clavicle || organ == Organ::rib || organ == Organ::sternum)
        least = std::min(least, query_.nearSegment(static_cast<int>(i), from, to).distance);
    }
    return least;
  }

  /// Nothing but skin, muscle and the vein on the way.
  bool meetsVeinFirst(const Vec3& from, const Vec3& to) const {
    const Vec3 direction = (to - from).normalized();
    for (const RayHit& hit : query_.cast(from, direction, (to - from).norm()))
      if (hit.organ != Organ::skin && hit.organ != Organ::muscle) return hit.organ == Organ::vein;
    return true;
  }

  /// A straight way from the entry to a place in the vein.
  struct NeedleWay {
    Vec3 to = Vec3::Zero();
    double angle = 0, clearance = 0, length = 0;  // rad to the skin's tangent plane, m
    bool free = false,
         taught = false;  // of bone and lung; medially, cephalad, within the needle's reach
    bool usable() const { return free && taught; }
  };

  NeedleWay wayTo(const Vec3& p, const Vec3& entry, const Vec3& normal) const {
    const Vec3 d = (p - entry).normalized();
    const double medially = patient_.side == Side::right ? d.x() : -d.x();
    NeedleWay way{p, std::asin(std::clamp(-d.dot(normal), -1.0, 1.0)), clearance(entry, p),
                  (p - entry).norm()};
    way.free = way.clearance >= kLeastClearance && meetsVeinFirst(entry, p);
    way.taught = way.length <= kNeedle && medially > kLeastMedial && d.z() > 0;
    return way;
  }

  /// Along the vein's line from lateral to medial: of the ways that are free of bone the one that
  /// lies flattest on the skin.
  NeedleWay flattest(const Vec3& entry) const {
    const Vec3 normal = query_.closest(surface(Organ::skin), entry).n_A;
    NeedleWay best;
    double least = std::numeric_limits<double>::infinity();
    for (const Vec3& p : vein_.line_S) {
      const NeedleWay way = wayTo(p, entry, normal);
      const double worth =
          way.angle + (way.free ? 0 : 3 + std::max(0.0, kLeastClearance - way.clearance) / 1e-3) +
          (way.taught ? 0 : 1 + std::max(0.0, way.length - kNeedle) / 1e-3);
      if (worth < least) least = worth, best = way;
    }
    return best;
  }

  Vec3 target() {
    const Vec3 entry = patient_.landmarks.at(landmark::kEntry);
    const NeedleWay way = flattest(entry);
    report(way);
    if (way.angle > kSteepest || !way.usable()) suggest(entry);
    return way.to;
  }

  /// An entry more lateral or lower from which the way lies flatter, the nearest that is flat
  /// enough.
  void suggest(const Vec3& entry) {
    const double laterally = patient_.side == Side::right ? -1 : 1;
    NeedleWay best;
    Vec3 from = entry;
    double least = std::numeric_limits<double>::infinity();
    for (int row = -1; row <= 4; ++row)
      for (int column = 0; column <= 8; ++column) {
        const Vec3 p =
            skinInFrontOf(entry + Vec3(laterally * kSuggestStep * column, 0, -kSuggestStep * row));
        const NeedleWay way = flattest(p);
        const double worth = std::max(way.angle, kSteepest) + (p - entry).norm();
        if (way.usable() && worth < least) least = worth, best = way, from = p;
      }
    if (!std::isfinite(least) || from == entry) return;
    char words[200];
    std::snprintf(words, sizeof words,
                  "From an entry %.0f mm away the way would meet the skin at %.0f degrees: %s",
                  1e3 * (from - entry).norm(), best.angle * 180 / std::numbers::pi,
                  seedOption(landmark::kEntry, from).c_str());
    remark(words);
  }

  void report(const NeedleWay& way) {
    char words[260];
    const double degrees = way.angle * 180 / std::numbers::pi;
    std::snprintf(words, sizeof words,
                  "The way from the entry to the vein is %.0f mm long, passes bone at %.1f mm and "
                  "meets the skin at %.0f degrees; the vein lies %.0f mm deep there",
                  1e3 * way.length, 1e3 * way.clearance, degrees,
                  -1e3 * query_.closest(surface(Organ::skin), way.to).distance);
    remark(words);
    if (!way.usable())
      return remark(
          "No straight way from the entry to the vein is free of bone and lung: move entry_point "
          "or vein_target by --seed-point");
    if (way.angle <= kSteepest) return;
    std::snprintf(words, sizeof words,
                  "At most 30 degrees are taught: from this entry no way to the vein that is free "
                  "of bone lies flatter than %.0f",
                  degrees);
    remark(words);
  }

  const Clavicle3& clavicle_;
  const Vein& vein_;
  const Seeds& seeds_;
  Patient& patient_;
  CtPatient& ct_;
  SurfaceQuery query_;
};

}  // namespace

void markLandmarks(const Clavicle3& clavicle, const Vein& vein, const Seeds& seeds, CtPatient* ct) {
  Marker(clavicle, vein, seeds, ct).run();
}

}  // namespace palpa::anatomy

#include "anatomy/patient/patient_check.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>
#include <numbers>

#include "anatomy/base/error.h"
#include "anatomy/base/pinned_math.h"
#include "anatomy/query/surface_query.h"
#include "anatomy/shapes/mesh_tools.h"

namespace palpa::anatomy {
namespace {

constexpr double kNear = 0.008;    // m: organs farther apart need no line
constexpr double kArmAtRest = 40;  // degrees
constexpr double kNone = std::numeric_limits<double>::infinity();

class Checker {
 public:
  Checker(const Patient& patient, const SurfaceQuery& query)
      : patient_(patient),
        query_(query),
        entry_(patient.landmark(landmark::kEntry)),
        target_(patient.landmark(landmark::kVeinTarget)),
        skin_(surface(Organ::skin)),
        vein_(surface(Organ::vein)) {}

  std::vector<PatientFinding> run() {
    checkLine();
    checkFirstMet();
    checkArm();
    checkVein();
    checkGaps();
    checkMeshes();
    return std::move(findings_);
  }

  /// What decides whether a score can be given.
  std::vector<PatientFinding> line() {
    checkLine();
    checkFirstMet();
    checkArm();
    checkTarget();
    return std::move(findings_);
  }

 private:
  int surface(Organ organ) const {
    patient_.organ(organ);  // throws when absent
    for (std::size_t i = 0; i < patient_.organs.size(); ++i)
      if (patient_.organs[i].organ == organ) return static_cast<int>(i);
    return -1;
  }

  void report(const std::string& what, double value, const char* unit, bool ok,
              const char* wanted) {
    findings_.push_back({what, value, unit, ok, wanted});
  }

  double distanceToLine(int index) const {
    return query_.nearSegment(index, entry_, target_).distance;
  }

  void checkLine() {
    const Vec3 way = target_ - entry_, direction = way.normalized();
    const SurfacePoint skin = query_.closest(skin_, entry_);
    report("entry point off the skin", 1e3 * std::abs(skin.distance), "mm",
           std::abs(skin.distance) < 1e-3, "below 1");
    const double angle = pinned::asin(-direction.dot(skin.n_A)) * 180 / std::numbers::pi;
    report("needle to skin", angle, "deg", angle > 10 && angle <= 30, "10 to 30");
    report("entry to vein target", 1e3 * way.norm(), "mm", way.norm() <= 0.060, "at most 60");
    const double medial = patient_.side == Side::right ? direction.x() : -direction.x();
    report("medial part of the direction", medial, "", medial > 0.5, "above 0.5");
    report("posterior part of the direction", direction.y(), "", direction.y() > 0, "above 0");
    report("cephalad part of the direction", direction.z(), "", direction.z() > 0, "above 0");
    const double clearance = 1e3 * distanceToLine(surface(Organ::clavicle));
    // Beside a wide vein close under the bone the axis cannot pass closer.
    const double highest = std::max(4.0, 500 * lumenDiameter() + 2);
    report("needle axis to clavicle", clearance, "mm", clearance >= 1 && clearance <= highest,
           "1 to 4, or to the vein's radius and 2");
  }

  /// A raised arm takes the clavicle's outer end along, and with it what is taught by the clavicle.
  void checkArm() {
    const Vec3 chord =
        patient_.landmark(landmark::kAcromialEnd) - patient_.landmark(landmark::kSternalEnd);
    const double rise = pinned::asin(chord.normalized().z()) * 180 / std::numbers::pi;
    report("clavicle's rise toward the shoulder", rise, "deg", std::abs(rise) <= kArmAtRest,
           "-40 to 40");
  }

  // Structures that must not be met before the vein on the line, nor 10 mm along the skin's normal.
  static bool vital(Organ organ) { return organ != Organ::skin && organ != Organ::muscle; }

  void checkFirstMet() {
    const Vec3 direction = (target_ - entry_).normalized();
    const auto hits = query_.cast(entry_ - 5e-3 * direction, direction, 0.070);
    const auto first =
        std::find_if(hits.begin(), hits.end(), [](auto& h) { return vital(h.organ); });
    const bool vein_first = first != hits.end() && first->organ == Organ::vein;
    const std::string met = first == hits.end() ? "nothing" : palpa::name(first->organ);
    report("way to what the needle meets first (" + met + ")",
           first == hits.end() ? 0 : 1e3 * (first->s - 5e-3), "mm", vein_first, "the vein");
    const Vec3 inward = -query_.closest(skin_, entry_).n_A;
    const auto down = query_.cast(entry_ + 1e-4 * inward, inward, 0.060);
    const auto deep =
        std::find_if(down.begin(), down.end(), [](auto& h) { return vital(h.organ); });
    const double free = deep == down.end() ? 60 : 1e3 * deep->s;
    report("free depth under the entry along the normal", free, "mm", free > 10, "above 10");
  }

  void checkTarget() {
    const double inside = -1e3 * query_.closest(vein_, target_).distance;
    report("target inside the vein", inside, "mm", inside > 0, "above 0");
  }

  void checkVein() {
    const auto window = patient_.landmarks.find(landmark::kWindow),
               over = patient_.landmarks.find(landmark::kWindowSkin);
    const bool marked = window != patient_.landmarks.end() && over != patient_.landmarks.end();
    const Vec3 skin = marked ? over->second : query_.closest(skin_, target_).p_A;
    const Vec3 inward = ((marked ? window->second : target_) - skin).normalized();
    double depth = 0;
    for (const RayHit& hit : query_.cast(skin, inward, 0.080))
      if (hit.surface == vein_ && hit.entering) {
        depth = hit.s;
        break;
      }
    report("vein depth under the skin", 1e3 * depth, "mm", depth >= 0.0045 && depth <= 0.036,
           "4.5 to 36");
    const double diameter = lumenDiameter();
    report("vein diameter", 1e3 * diameter, "mm", diameter >= 0.0037 && diameter <= 0.015,
           "3.7 to 15");
    checkTarget();
    const double pleura = query_.closest(surface(Organ::lung), target_).distance - diameter / 2;
    report("vein to pleura", 1e3 * pleura, "mm", pleura >= 0.001 && pleura <= 0.012, "1 to 12");
  }

  // Mean chord through the target across the vein's axis.
  double lumenDiameter() const {
    SurfaceQuery::Tube tube;
    if (!query_.fitTube(vein_, target_, 0.010, &tube)) return 0;
    const Mat3 R = rotationWithZ((tube.b_A - tube.a_A).normalized());
    constexpr int kChords = 12;
    double sum = 0;
    for (int i = 0; i < kChords; ++i) {
      const double angle = std::numbers::pi * i / kChords;
      const Vec3 across = R * Vec3(pinned::cos(angle), pinned::sin(angle), 0);
      for (const double sign : {-1.0, 1.0})
        for (const RayHit& hit : query_.cast(target_, sign * across, 0.030))
          if (hit.surface == vein_) {
            sum += hit.s;
            break;
          }
    }
    return sum / kChords;
  }

  // Least signed distance of one surface's vertices to another: negative where they overlap. Only
  // vertices in or near the other's box can be that near.
  double gap(int a, int b) const {
    double least = kNone;
    const Eigen::AlignedBox3d box = grown(boxes_[b]);
    for (const Vec3& p : patient_.organs[a].mesh.points)
      if (box.contains(p)) least = std::min(least, query_.closest(b, p).distance);
    return least;
  }

  static Eigen::AlignedBox3d grown(Eigen::AlignedBox3d box) {
    box.extend(Vec3(box.min().array() - kNear));
    box.extend(Vec3(box.max().array() + kNear));
    return box;
  }

  void checkGaps() {
    for (const OrganSurface& o : patient_.organs) {
      boxes_.emplace_back();
      for (const Vec3& p : o.mesh.points) boxes_.back().extend(p);
    }
    const int count = static_cast<int>(patient_.organs.size());
    for (int a = 0; a < count; ++a)
      for (int b = 0; b < a; ++b) checkGap(a, b);
    for (int a = 0; a < count; ++a) {
      if (a == skin_) continue;
      double shallowest = kNone;
      for (const Vec3& p : patient_.organs[a].mesh.points)
        shallowest = std::min(shallowest, -query_.closest(skin_, p).distance);
      report("depth of " + patient_.organs[a].id, 1e3 * shallowest, "mm", shallowest > 1e-3,
             "above 1");
    }
  }

  // Two organs that are nowhere near each other are not worth a line.
  void checkGap(int a, int b) {
    const auto& organs = patient_.organs;
    if (!vital(organs[a].organ) || !vital(organs[b].organ) ||
        !grown(boxes_[a]).intersects(boxes_[b]))
      return;
    const double found = std::min(gap(a, b), gap(b, a));
    if (found < kNear)
      report("gap " + organs[b].id + " - " + organs[a].id, 1e3 * found, "mm", found > 0.3e-3,
             "above 0.3");
  }

  void checkMeshes() {
    std::size_t triangles = 0;
    int open = 0;
    for (const OrganSurface& o : patient_.organs) {
      triangles += o.mesh.triangles.size();
      if (!isClosed(o.mesh) || signedVolume(o.mesh) <= 0) ++open;
    }
    report("surfaces open or inside out", open, "", open == 0, "0");
    report("triangles", static_cast<double>(triangles), "", triangles <= 300'000, "at most 300000");
  }

  const Patient& patient_;
  const SurfaceQuery& query_;
  Vec3 entry_, target_;
  int skin_, vein_;
  std::vector<Eigen::AlignedBox3d> boxes_;  ///< by surface
  std::vector<PatientFinding> findings_;
};

}  // namespace

std::vector<std::string> missingForNeedle(const Patient& patient) {
  std::vector<std::string> missing;
  for (const Organ needed : {Organ::skin, Organ::clavicle, Organ::vein, Organ::lung})
    if (std::none_of(patient.organs.begin(), patient.organs.end(),
                     [&](const auto& o) { return o.organ == needed; }))
      missing.push_back(std::string("the organ ") + palpa::name(needed));
  for (const char* needed :
       {landmark::kNotch, landmark::kSternalEnd, landmark::kAcromialEnd, landmark::kMedialThird,
        landmark::kEntry, landmark::kSternalEndPosteriorSuperior, landmark::kVeinTarget})
    if (!patient.landmarks.count(needed)) missing.push_back(std::string("the landmark ") + needed);
  return missing;
}

void requireForNeedle(const Patient& patient, const std::string& where) {
  std::string list;
  for (const std::string& one : missingForNeedle(patient)) list += (list.empty() ? "" : ", ") + one;
  if (!list.empty())
    throw Error("this patient is to be looked at, not to be punctured: it lacks " + list, where,
                "Add what is missing, or take another patient (palpa patient build)");
}

std::string whyNotScored(const Patient& patient, const SurfaceQuery& query) {
  for (const PatientFinding& finding : Checker(patient, query).line()) {
    if (finding.ok) continue;
    char value[32];
    std::snprintf(value, sizeof value, "%.1f", finding.value);
    return "this patient's taught line is out of the range that can be scored: " + finding.name +
           " " + value + (finding.unit.empty() ? "" : " " + finding.unit) + ", wanted " +
           finding.wanted;
  }
  return "";
}

std::vector<PatientFinding> checkPatient(const Patient& patient) {
  const SurfaceQuery query(patient);
  return Checker(patient, query).run();
}

}  // namespace palpa::anatomy

#include "apps/assess/needle/needle_views.h"

#include <algorithm>
#include <cmath>
#include <set>

#include "apps/assess/needle/phases.h"

namespace palpa::assess {
namespace {

using anatomy::SectionLine;
using anatomy::SectionPlane;
using Eigen::Vector2d;

constexpr double kAround = 0.025;  // m shown about an entry, about a vein
constexpr double kOutside = 0.018, kBehind = 0.030, kBeyond = 0.028;  // m, beside the way

bool reachesInto(const SectionLine& line, const Vector2d& low, const Vector2d& high) {
  Vector2d from = line.points.front(), to = from;
  for (const Vector2d& p : line.points) {
    from = from.cwiseMin(p);
    to = to.cwiseMax(p);
  }
  return (from.array() <= high.array()).all() && (to.array() >= low.array()).all();
}

/// Even-odd: a ray to the right of `p` meets the line an odd number of times.
bool encloses(const SectionLine& line, const Vector2d& p) {
  bool inside = false;
  const std::size_t n = line.points.size();
  for (std::size_t i = 0, j = n - 1; i < n; j = i++) {
    const Vector2d &a = line.points[i], &b = line.points[j];
    if ((a.y() > p.y()) != (b.y() > p.y()) &&
        p.x() < (b.x() - a.x()) * (p.y() - a.y()) / (b.y() - a.y()) + a.x())
      inside = !inside;
  }
  return inside;
}

/// How far a point is from the line's corners and from the edges of what is shown.
double roomAt(const SectionLine& line, const NeedleView& view, const Vector2d& p) {
  double room = std::min((p - view.low).minCoeff(), (view.high - p).minCoeff());
  for (const Vector2d& corner : line.points) room = std::min(room, (p - corner).norm());
  return room;
}

constexpr double kSmall = 0.014;     // m: what is smaller has its name below
constexpr double kLetters = 0.0035;  // m from a name's middle to where the next begins

OrganName nameOf(const SectionLine& line, const NeedleView& view) {
  constexpr int kParts = 24;
  Vector2d low = line.points.front().cwiseMax(view.low).cwiseMin(view.high), high = low;
  for (const Vector2d& p : line.points) {
    const Vector2d seen = p.cwiseMax(view.low).cwiseMin(view.high);
    low = low.cwiseMin(seen);
    high = high.cwiseMax(seen);
  }
  OrganName name{line.organ, {(low.x() + high.x()) / 2, low.y() - kLetters}};
  double most = (high - low).maxCoeff() < kSmall ? kSmall : 0;
  for (int i = 1; i < kParts; ++i) {
    for (int j = 1; j < kParts; ++j) {
      const Vector2d p = low + (high - low).cwiseProduct(Vector2d(i, j) / kParts);
      const double room = encloses(line, p) ? roomAt(line, view, p) : 0;
      if (room <= most) continue;
      most = room;
      name.at = p;
    }
  }
  const Vector2d rim = Vector2d::Constant(kLetters);
  name.at = name.at.cwiseMax(view.low + rim).cwiseMin(view.high - rim);
  return name;
}

void nameOrgans(NeedleView* view) {
  std::set<Organ> named{Organ::skin};
  for (const SectionLine& line : view->cut)
    if (named.insert(line.organ).second) view->names.push_back(nameOf(line, *view));
}

void cut(const anatomy::Patient& patient, const SectionPlane& plane, bool (*shown)(Organ),
         NeedleView* view) {
  for (const anatomy::OrganSurface& organ : patient.organs) {
    if (!shown(organ.organ)) continue;
    for (SectionLine& line : anatomy::sectionOf(organ, plane))
      if (reachesInto(line, view->low, view->high)) view->cut.push_back(std::move(line));
  }
  nameOrgans(view);
}

bool isAnything(Organ) { return true; }

void name(NeedleView* view, const char* title, const char* across, const char* up) {
  view->title = title;
  view->across = across;
  view->up = up;
}

/// `v` without what it has along the unit vector `n`.
Vec3 across(const Vec3& v, const Vec3& n) { return (v - v.dot(n) * n).normalized(); }

}  // namespace

NeedleViews needleViewsOf(const anatomy::Patient& patient, const calibration::TaughtPath& path) {
  const anatomy::LandmarkFrame frame(patient);
  NeedleViews views;
  views.entry_A = frame.pointToA(path.entry_L);
  views.target_A = patient.landmark(anatomy::landmark::kVeinTarget);
  views.entry_acceptable = path.entry_acceptable;
  const Vec3 medial = frame.vectorToA(Vec3::UnitX()), out = -frame.vectorToA(Vec3::UnitY()),
             cephalad = frame.vectorToA(Vec3::UnitZ()),
             way = (frame.pointToA(path.line_to_L) - views.entry_A).normalized();
  const Vector2d corner(kAround, kAround);

  // A picture's normal points to who looks at it: from in front; and for the vein from the needle.
  const Vec3 right = cephalad.cross(out).normalized();
  name(&views.skin, "Entry, from in front", right.dot(medial) > 0 ? "middle" : "shoulder", "head");
  views.skin.plane = {views.entry_A, right, out.cross(right)};
  views.skin.low = -corner;
  views.skin.high = corner;
  SectionPlane bones = views.skin.plane;
  bones.origin_A +=
      (patient.landmark(anatomy::landmark::kMedialThird) - bones.origin_A).dot(out) * out;
  cut(patient, bones, isBone, &views.skin);

  name(&views.way, "The way, in section", "along the way", "front");
  views.way.plane = {views.entry_A, across(way, out), out};
  const Vector2d end = views.way.plane.at(views.target_A);
  views.way.low = Vector2d(-kBehind, std::min(end.y(), 0.0) - kBeyond);
  views.way.high = Vector2d(end.x() + kBeyond, kOutside);
  cut(patient, views.way.plane, isAnything, &views.way);

  const Vec3 direction = frame.vectorToA(path.direction_L).normalized(),
             up = across(out, direction), rightward = direction.cross(up);
  name(&views.vein, "The vein, as the needle sees it",
       rightward.dot(cephalad) > 0 ? "head" : "feet", "front");
  views.vein.plane = {views.target_A, rightward, up};
  views.vein.low = -corner;
  views.vein.high = corner;
  cut(patient, views.vein.plane, isAnything, &views.vein);
  return views;
}

std::vector<NeedleTrack> needleTracks(const std::vector<TrialSample>& samples) {
  std::vector<NeedleTrack> tracks;
  for (const Pass& pass : detectPhases(samples).passes) {
    NeedleTrack track{pass.puncture.tip_A, {}, samples[pass.first]};
    for (std::size_t i = pass.first; i <= pass.last; ++i) {
      track.tips_A.push_back(samples[i].tip_A);
      if (samples[i].depth > track.deepest.depth) track.deepest = samples[i];
    }
    tracks.push_back(std::move(track));
  }
  return tracks;
}

std::optional<Vector2d> aimOf(const TrialSample& needle, const SectionPlane& plane) {
  constexpr double kAlong = 0.17365, kFarthest = 0.05;  // sin 10 degrees; m
  const double toward = needle.axis_A.dot(plane.normal_A());
  if (std::abs(toward) < kAlong) return std::nullopt;
  const double ahead = -plane.offset(needle.tip_A) / toward;
  if (std::abs(ahead) > kFarthest) return std::nullopt;
  return plane.at(needle.tip_A + ahead * needle.axis_A);
}

}  // namespace palpa::assess

#include "anatomy/query/local_geometry_builder.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "anatomy/base/error.h"
#include "anatomy/query/surface_query.h"

namespace palpa::anatomy {
namespace {

// A bone so near may be touched before the next snapshot (0.25 m/s: 4 mm): its bend counts
constexpr double kBendReach = 0.015;
constexpr double kFitAhead =
    0.060;  // bones so near to the entry are fitted at once, others when the tool comes near them
constexpr double kBoneReach = 0.040;  // bones further from tip and shaft are left out
constexpr double kSurfaceReach =
    0.008;  // of the skin round the tool: a fast hand's way until the next snapshot
constexpr double kAhead = 0.060;      // boundaries are looked for this far beyond the tip
constexpr double kTowardSkin = 0.02;  // sine of the least angle at which the axis counts as inward

// Walks along the axis and keeps what is on either side consistent.
class BoundaryList {
 public:
  BoundaryList(const Vec3& tip, const Vec3& direction, LocalGeometry* geometry)
      : tip_(tip), direction_(direction), geometry_(geometry) {}

  void layer(double s, const Vec3& n, Tissue to, Organ wall) {
    if (inside_ < 0) add(s, n, background_, to, wall, false);
    background_ = to;
  }

  void crossing(const RayHit& hit, double s) {
    const Organ wall = isBone(hit.organ) ? Organ::none : hit.organ;
    if (hit.entering && inside_ < 0) {
      add(s, hit.n_A, background_, tissueInside(hit.organ), wall, false);
      inside_ = hit.surface;
    } else if (!hit.entering && inside_ == hit.surface) {
      add(s, hit.n_A, tissueInside(hit.organ), background_, wall, true);
      inside_ = -1;
    }
  }

 private:
  void add(double s, Vec3 n, Tissue from, Tissue to, Organ wall, bool leaving) {
    if (geometry_->boundary_count == LocalGeometry::kMaxBoundaries) return;  // the nearest are in
    if (n.dot(direction_) > 0) n = -n;
    geometry_->boundaries[geometry_->boundary_count++] = {
        pack(Vec3(tip_ + s * direction_)), pack(n), from, to, wall, leaving};
  }

  Vec3 tip_, direction_;
  LocalGeometry* geometry_;
  Tissue background_ = Tissue::air;
  int inside_ = -1;  // surface whose inside the axis is in
};

void expressInD(const Pose& X_DA, LocalGeometry* geometry) {
  const auto point = [&](Packed3* p) { *p = pack(Vec3(X_DA * unpack(*p))); };
  const auto vector = [&](Packed3* v) { *v = pack(Vec3(X_DA.linear() * unpack(*v))); };
  point(&geometry->skin.p);
  vector(&geometry->skin.n);
  vector(&geometry->skin.x);
  for (int i = 0; i < geometry->bone_count; ++i) {
    point(&geometry->bones[i].a);
    point(&geometry->bones[i].b);
  }
  for (int i = 0; i < geometry->boundary_count; ++i) {
    point(&geometry->boundaries[i].p);
    vector(&geometry->boundaries[i].n);
  }
}

}  // namespace

LocalGeometryBuilder::LocalGeometryBuilder(const Patient& patient, const SurfaceQuery& query)
    : patient_(patient), query_(query), skin_(-1) {
  patient.organ(Organ::skin);  // throws without a skin
  for (std::size_t i = 0; i < patient.organs.size(); ++i) {
    const OrganSurface& surface = patient.organs[i];
    if (surface.organ == Organ::skin && skin_ < 0) skin_ = static_cast<int>(i);
    if (!isBone(surface.organ)) continue;
    Bone bone{static_cast<int>(i),
              surface.organ,
              {},
              std::make_unique<BoneCapsulesOnDemand>(surface.mesh)};
    for (const Vec3& p : surface.mesh.points) bone.box.extend(p);
    bones_.push_back(std::move(bone));
  }
  const auto entry = patient.landmarks.find(landmark::kEntry);
  if (entry == patient.landmarks.end()) return;
  for (const Bone& bone : bones_)
    if (bone.box.exteriorDistance(entry->second) <= kFitAhead) bone.capsules->get();
}

std::vector<LocalGeometryBuilder::NearBone> LocalGeometryBuilder::bonesNear(
    const ToolPlacement& tool, const NeedleAxis& axis) const {
  const bool inserted = tool.punctured && axis.s_skin < 0;
  const Vec3 other = inserted ? Vec3(axis.tip + axis.s_skin * axis.direction) : axis.tip;
  std::vector<NearBone> near;
  for (const Bone& bone : bones_) {
    // From the middle outward no point of the needle can be nearer than this.
    const Vec3 middle = (axis.tip + other) / 2;
    const double outer = kBoneReach + (other - axis.tip).norm() / 2;
    if (bone.box.exteriorDistance(middle) > outer ||
        query_.closest(bone.surface, middle).distance > outer)
      continue;
    const SurfacePoint nearest = nearestToSegment(query_, bone.surface, axis.tip, other);
    if (nearest.distance > kBoneReach) continue;
    const int most = nearest.distance <= kBendReach ? LocalGeometry::kMaxBones : 1;
    std::vector<Capsule> capsules = bone.capsules->get().near(nearest, most);
    if (!capsules.empty()) near.push_back({&bone, nearest.distance, std::move(capsules), 0});
  }
  std::stable_sort(near.begin(), near.end(),
                   [](const NearBone& a, const NearBone& b) { return a.distance < b.distance; });
  return near;
}

void LocalGeometryBuilder::addBones(const ToolPlacement& tool, const NeedleAxis& axis,
                                    LocalGeometry* geometry) const {
  std::vector<NearBone> near = bonesNear(tool, axis);
  int places = LocalGeometry::kMaxBones;
  for (bool any = true; any && places > 0;) {
    any = false;
    for (NearBone& n : near) {
      if (places == 0 || n.taken == n.capsules.size()) continue;
      ++n.taken;
      --places;
      any = true;
    }
  }
  for (const NearBone& n : near)
    for (std::size_t k = 0; k < n.taken; ++k) {
      Capsule capsule = n.capsules[k];
      capsule.organ = n.bone->organ;
      capsule.bone = static_cast<std::uint8_t>(n.bone->surface);
      geometry->bones[geometry->bone_count++] = capsule;
    }
}

void LocalGeometryBuilder::addBoundaries(const NeedleAxis& axis, LocalGeometry* geometry) const {
  const double inward = -axis.direction.dot(axis.skin_n);
  if (inward < kTowardSkin || std::abs(axis.s_skin) > 1) return;
  const SoftLayers& layers = patient_.layers;
  struct Layer {
    double depth;
    Tissue to;
    Organ wall;
  };
  const Layer planes[] = {
      {0, Tissue::skin, Organ::skin},
      {layers.skin, Tissue::fat, Organ::none},
      {layers.skin + layers.fat, Tissue::muscle, Organ::fascia},
      {layers.skin + layers.fat + layers.muscle, Tissue::connective, Organ::none}};
  constexpr std::size_t kConnective = 3;  // the plane under the muscle
  const double length = std::max(-axis.s_skin, 0.0) + kAhead;
  const std::vector<RayHit> hits =
      query_.cast(axis.tip + axis.s_skin * axis.direction, axis.direction, length);

  BoundaryList list(axis.tip, axis.direction, geometry);
  std::size_t next = 0;
  const auto layersUpTo = [&](double s) {
    for (; next < std::size(planes) && planes[next].depth / inward <= s; ++next)
      list.layer(axis.s_skin + planes[next].depth / inward, axis.skin_n, planes[next].to,
                 planes[next].wall);
  };
  for (const RayHit& hit : hits) {
    if (hit.organ == Organ::skin || hit.organ == Organ::airway)
      continue;  // layers stand for the skin; no needle here has a law for the airway
    layersUpTo(hit.s);
    if (hit.organ != Organ::muscle) {
      list.crossing(hit, axis.s_skin + hit.s);
    } else if (!hit.entering && next == kConnective) {
      // The muscle ends at its border before the axis is as deep as it is thick.
      list.layer(axis.s_skin + hit.s, hit.n_A, Tissue::connective, Organ::none);
      ++next;
    }
  }
  layersUpTo(length);
}

LocalGeometry LocalGeometryBuilder::build(std::uint64_t number, std::int64_t t_ns,
                                          const ToolPlacement& tool, const Pose& X_DA) const {
  LocalGeometry geometry;
  geometry.number = number;
  geometry.t_ns = t_ns;
  const Vec3 tip = tool.X_AT.translation(), direction = tool.X_AT.linear().col(2);
  // A needle in the tissue meets layers, no longer the skin's surface: its plane at the entry will
  // do.
  geometry.skin = tool.punctured ? fitSurfacePatch(query_, skin_, tool.entry_A, 0)
                                 : fitSurfacePatch(query_, skin_, tip, kSurfaceReach);
  const Vec3 skin_p = unpack(geometry.skin.p), skin_n = unpack(geometry.skin.n);

  const double inward = -direction.dot(skin_n);
  const double height = (tip - skin_p).dot(skin_n);
  const NeedleAxis axis{tip, direction, skin_p, skin_n,
                        std::abs(inward) > kTowardSkin ? height / inward : 0};
  addBones(tool, axis, &geometry);
  addBoundaries(axis, &geometry);
  expressInD(X_DA, &geometry);
  return geometry;
}

}  // namespace palpa::anatomy

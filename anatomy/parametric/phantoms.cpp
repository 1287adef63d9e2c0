#include "anatomy/parametric/phantoms.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <map>
#include <numbers>

#include "anatomy/base/error.h"
#include "anatomy/query/surface_query.h"
#include "anatomy/query/triangle_tree.h"
#include "anatomy/shapes/implicit_surface.h"
#include "anatomy/shapes/root.h"

namespace palpa::anatomy {
namespace {

constexpr double kShortestSide = 0.010, kLongestSide = 2;  // m
constexpr double kBlockStep = 0.0025;                      // m: fine enough to give way under a tip
constexpr int kMostSteps = 120, kArcSteps = 3;  // along a side; along an eighth of a circle
constexpr std::array<float, 4> kBlockColour{0.93F, 0.79F, 0.71F, 1};

using Lattice = std::array<std::uint32_t, 3>;

/// Where lattice planes cut an axis, from -half to half: even along the flat part, and by even
/// angles where edges are round.
std::vector<double> cutsAlong(double side) {
  const double flat = side / 2 - kBlockEdge;
  const int steps = std::clamp(static_cast<int>(std::lround(2 * flat / kBlockStep)), 1, kMostSteps);
  std::vector<double> cuts;
  for (int i = kArcSteps; i > 0; --i)
    cuts.push_back(-flat - kBlockEdge * std::tan(std::numbers::pi / 4 * i / kArcSteps));
  for (int i = 0; i <= steps; ++i) cuts.push_back(flat * (2.0 * i / steps - 1));
  for (int i = 1; i <= kArcSteps; ++i)
    cuts.push_back(flat + kBlockEdge * std::tan(std::numbers::pi / 4 * i / kArcSteps));
  return cuts;
}

/// The surface of a box's lattice, pushed onto the box with round edges: every point shared, so the
/// mesh is closed.
class BlockSurface {
 public:
  explicit BlockSurface(const Vec3& size) : flat_(size / 2 - Vec3::Constant(kBlockEdge)) {
    for (int axis = 0; axis < 3; ++axis)
      cuts_[static_cast<std::size_t>(axis)] = cutsAlong(size[axis]);
    for (std::size_t axis = 0; axis < 3; ++axis) {
      addFace(axis, false);
      addFace(axis, true);
    }
  }
  TriangleMesh mesh;

 private:
  std::uint32_t last(std::size_t axis) const {
    return static_cast<std::uint32_t>(cuts_[axis].size()) - 1;
  }

  std::uint32_t pointAt(const Lattice& at) {
    const auto [entry, is_new] =
        index_.try_emplace(at, static_cast<std::uint32_t>(mesh.points.size()));
    if (!is_new) return entry->second;
    const Vec3 q(cuts_[0][at[0]], cuts_[1][at[1]], cuts_[2][at[2]]);
    const Vec3 inner = q.cwiseMax(-flat_).cwiseMin(flat_), normal = (q - inner).normalized();
    mesh.points.push_back(inner + kBlockEdge * normal);
    mesh.normals.push_back(normal);
    return entry->second;
  }

  void addFace(std::size_t axis, bool high) {
    const std::size_t u = (axis + 1) % 3, v = (axis + 2) % 3;
    for (std::uint32_t i = 0; i < last(u); ++i) {
      for (std::uint32_t j = 0; j < last(v); ++j) {
        const auto corner = [&](std::uint32_t du, std::uint32_t dv) {
          Lattice at{};
          at[axis] = high ? last(axis) : 0;
          at[u] = i + du;
          at[v] = j + dv;
          return pointAt(at);
        };
        const std::uint32_t a = corner(0, 0), b = corner(1, 0), c = corner(1, 1), d = corner(0, 1);
        mesh.triangles.push_back(high ? std::array{a, b, c} : std::array{a, c, b});
        mesh.triangles.push_back(high ? std::array{a, c, d} : std::array{a, d, c});
      }
    }
  }

  Vec3 flat_;
  std::array<std::vector<double>, 3> cuts_;
  std::map<Lattice, std::uint32_t> index_;
};

constexpr double kLeastHeight = 0.005;  // m, of a block with a curved top

/// z' = z + share h(x, y), share: of the height over the base. Normals by the inverse transpose of
/// that map's derivative, I + z w'.
void drawTop(const TopShape& top, double high, TriangleMesh* mesh) {
  for (std::size_t i = 0; i < mesh->points.size(); ++i) {
    Vec3 &p = mesh->points[i], &n = mesh->normals[i];
    const TopHeight h = heightOf(top, p.x(), p.y());
    if (!(high + h.z >= kLeastHeight))
      throw Error("its top comes within 5 mm of its base", "phantom/shape",
                  "Make the phantom higher or its top flatter");
    const double share = 1 + p.z() / high;
    const Vec3 w(share * h.zx, share * h.zy, h.z / high);
    n = (n - n.z() / (1 + w.z()) * w).normalized();
    p.z() += share * h.z;
  }
}

TriangleMesh blockMesh(const Vec3& size, const TopShape& top) {
  TriangleMesh mesh = BlockSurface(size).mesh;
  for (Vec3& p : mesh.points) p -= Vec3(0, 0, size.z() / 2);
  if (!top.flat()) drawTop(top, size.z(), &mesh);
  for (Vec3& p : mesh.points) p = X_AP() * p;
  for (Vec3& n : mesh.normals) n = X_AP().linear() * n;
  return mesh;
}

}  // namespace

Pose X_AP() {
  Mat3 R;
  R << 1, 0, 0,  //
      0, 0, -1,  //
      0, 1, 0;
  return makePose(R, Vec3::Zero());
}

Patient phantomBlock(const Vec3& size, const std::string& name, const TopShape& top) {
  if (!(size.minCoeff() >= kShortestSide && size.maxCoeff() <= kLongestSide) || !size.allFinite())
    throw Error("no block is " + std::to_string(1e3 * size.x()) + " x " +
                    std::to_string(1e3 * size.y()) + " x " + std::to_string(1e3 * size.z()) + " mm",
                "phantom", "Give sides from 10 mm to 2 m");
  Patient patient;
  patient.name = name;
  patient.layers = {0.002, 0, 0};
  patient.organs.push_back({"skin", Organ::skin, blockMesh(size, top), kBlockColour});
  patient.landmarks[landmark::kEntry] = X_AP() * Vec3::Zero();
  patient.landmarks[landmark::kNearEdge] =
      X_AP() * Vec3(0, -size.y() / 2, heightOf(top, 0, -size.y() / 2).z - kBlockEdge);
  return patient;
}

namespace {

constexpr double kLeastSilicone = 0.002, kMeshError = 0.0005;  // m
constexpr double kLeastDiameter = 0.002;
constexpr std::array<float, 4> kSiliconeColour{0.93f, 0.77f, 0.69f, 0.45f},
    kInclusionColour{0.90f, 0.62f, 0.20f, 1};

double dent(double square, double wide) { return std::exp(-0.5 * square / (wide * wide)); }

// Half an ellipsoid; its edge at the base is a little rounded.
double breastField(const Vec3& p) {
  const Vec3 radii(0.060, 0.045, 0.060);
  const double dome = (p.cwiseQuotient(radii).norm() - 1) * radii.minCoeff();
  return smoothMax(dome, p.y(), 0.003);
}

// Height of the belly's front over the base, with its umbilicus.
double bellyHeight(double x, double z) {
  const double across = x / 0.130, along = z / 0.100;
  const double dome = 0.060 + 0.020 * (1 - across * across) * (1 - 0.6 * along * along);
  const double r = std::hypot(x, z + 0.025);
  return dome - 0.008 * dent(r * r, 0.006) + 0.0015 * dent((r - 0.014) * (r - 0.014), 0.005);
}

double abdomenField(const Vec3& p) {
  constexpr double kCorner = 0.030;
  const double dx = std::max(std::abs(p.x()) - (0.130 - kCorner), 0.0),
               dz = std::max(std::abs(p.z()) - (0.100 - kCorner), 0.0);
  const double sides = std::hypot(dx, dz) - kCorner,
               front = 0.9 * (-p.y() - bellyHeight(p.x(), p.z()));
  return smoothMax(smoothMax(sides, front, 0.030), p.y(), 0.004);
}

struct PhantomBody {
  Field field;
  Vec3 low, high;  // m; the body lies within
  double cell;
};

PhantomBody bodyOf(PhantomKind kind) {
  if (kind == PhantomKind::breast)
    return {breastField, {-0.060, -0.045, -0.060}, {0.060, 0, 0.060}, 0.0022};
  return {abdomenField, {-0.130, -0.082, -0.100}, {0.130, 0, 0.100}, 0.0035};
}

TriangleMesh phantomMesh(const Field& field, const Vec3& low, const Vec3& high, double cell) {
  const Vec3 room = Vec3::Constant(2.5 * cell);
  return surfaceNets(field, {low - room, high + room}, cell, 2.5);
}

struct PlaceUnderSkin {
  Vec3 skin, centre;
};

// Under the skin at (x, z), along its normal.
PlaceUnderSkin placeUnder(const PhantomBody& body, double x, double z, double depth) {
  const auto front = [&](double y) { return body.field({x, y, z}); };
  const double outside = body.low.y() - 0.010;
  if (!(front(outside) > 0 && front(-0.005) < 0))
    throw Error("there is no skin " + std::to_string(1e3 * x) + " mm to the left and " +
                    std::to_string(1e3 * z) + " mm up",
                "phantom", "Put the inclusion nearer to the middle");
  const Vec3 skin(x, findRoot(front, outside, -0.005, 1e-9), z);
  return {skin, skin - depth * gradient(body.field, skin, 1e-4).normalized()};
}

OrganSurface sphereIn(const PhantomInclusion& inclusion, const PlaceUnderSkin& place) {
  const double radius = inclusion.diameter / 2;
  const auto field = [&](const Vec3& p) { return (p - place.centre).norm() - radius; };
  const Vec3 reach = Vec3::Constant(radius);
  return {"inclusion", Organ::inclusion,
          phantomMesh(field, place.centre - reach, place.centre + reach, radius / 12),
          kInclusionColour};
}

// z of the liver's lower edge: lowest toward the patient's right, up to the costal margin beyond
// the midline.
double liverEdge(double x) { return 0.024 + 8 * (x + 0.06) * (x + 0.06); }

// A wedge: its front keeps its depth under the nearest skin, its back falls away above the rounded
// edge.
OrganSurface liverIn(const PhantomBody& body, const TriangleTree& skin,
                     const PhantomInclusion& inclusion, PlaceUnderSkin* middle) {
  constexpr double kRight = -0.098, kTop = 0.092, kMiddle = -0.045, kWedge = 0.35;
  const double thick = inclusion.diameter, depth = inclusion.depth;
  const auto field = [=, &skin](const Vec3& p) {
    const double under = bellyHeight(p.x(), p.z()) + p.y(), above = p.z() - liverEdge(p.x());
    const double front = depth + skin.closest(p).signed_distance,
                 back = 0.94 * (under - depth - thick - kWedge * std::max(above, 0.0));
    const double ends =
        smoothMax(smoothMax(kRight - p.x(), p.z() - kTop, 0.020), -0.6 * above, 0.010);
    return smoothMax(smoothMax(front, back, 0.2 * thick), ends, 0.9 * thick);
  };
  *middle = placeUnder(body, kMiddle, liverEdge(kMiddle) + thick, depth + 0.5 * thick);
  const double cell = std::clamp(thick / 8, 0.0010, 0.0025);
  return {"liver", Organ::inclusion,
          phantomMesh(field, {kRight, -0.082, 0.020}, {0.040, 0, kTop}, cell), kInclusionColour};
}

void requireRoom(const Patient& patient, const PhantomInclusion& inclusion) {
  const SurfaceQuery query(patient);
  double least = 1;
  for (const Vec3& p : patient.organs.back().mesh.points)
    least = std::min(least, -query.closest(0, p).distance);
  if (least >= std::min(inclusion.depth, kLeastSilicone) - kMeshError) return;
  char what[160];
  std::snprintf(
      what, sizeof what,
      "an inclusion of %.1f mm under %.1f mm does not fit: %.1f mm of silicone would stay round it",
      1e3 * inclusion.diameter, 1e3 * inclusion.depth, 1e3 * least);
  throw Error(what, "phantom", "Make it smaller or put it elsewhere");
}

void addInclusion(const PhantomBody& body, PhantomKind kind, const PhantomInclusion& inclusion,
                  Patient* patient) {
  if (!(inclusion.diameter >= kLeastDiameter && inclusion.diameter <= 0.2 &&
        inclusion.depth >= 0.001 && inclusion.depth <= 0.1))
    throw Error("an inclusion is 2 to 200 mm thick and 1 to 100 mm deep", "phantom",
                "Give such values");
  PlaceUnderSkin place;
  if (kind == PhantomKind::breast) {
    place =
        placeUnder(body, inclusion.left, inclusion.up, inclusion.depth + inclusion.diameter / 2);
    patient->organs.push_back(sphereIn(inclusion, place));
  } else {
    patient->organs.push_back(
        liverIn(body, TriangleTree(patient->organs.front().mesh), inclusion, &place));
  }
  patient->landmarks[landmark::kInclusion] = place.centre;
  patient->landmarks[landmark::kInclusionSkin] = place.skin;
  requireRoom(*patient, inclusion);
}

}  // namespace

Patient buildPhantom(const PhantomSpec& spec) {
  const PhantomBody body = bodyOf(spec.kind);
  Patient patient;
  patient.name = spec.kind == PhantomKind::breast ? "breast phantom" : "abdomen phantom";
  patient.layers = {0.002, 0, 0};
  patient.organs.push_back({"skin", Organ::skin,
                            phantomMesh(body.field, body.low, body.high, body.cell),
                            kSiliconeColour});
  if (spec.inclusion) addInclusion(body, spec.kind, *spec.inclusion, &patient);
  return patient;
}

}  // namespace palpa::anatomy

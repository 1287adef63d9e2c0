#include "anatomy/query/local_geometry_builder.h"

#include <gtest/gtest.h>

#include "test_shapes.h"

namespace palpa::anatomy {
namespace {

struct Scene {
  explicit Scene(Side side)
      : patient(referencePatient(side)), query(patient), builder(patient, query) {
    entry = patient.landmark(landmark::kEntry);
    direction = (patient.landmark(landmark::kVeinTarget) - entry).normalized();
  }
  /// Needle on the taught line, its tip `depth` along it.
  ToolPlacement tool(double depth) const {
    return {makePose(rotationWithZ(direction), entry + depth * direction), depth > 0, entry};
  }
  LocalGeometry build(double depth, const Pose& X_DA = Pose::Identity()) const {
    return builder.build(7, 123456789, tool(depth), X_DA);
  }
  const Patient& patient;
  SurfaceQuery query;
  LocalGeometryBuilder builder;
  Vec3 entry, direction;
};

double along(const Scene& scene, const Boundary& boundary) {
  return (unpack(boundary.p) - scene.entry).dot(scene.direction);
}

TEST(LocalGeometryBuilder, TaughtLineCrossesTheLayersInOrderWhereRaysSay) {
  const Scene scene(Side::right);
  for (const double depth : {0.0005, 0.010, 0.030}) {
    const LocalGeometry g = scene.build(depth);
    EXPECT_EQ(g.number, 7u);
    EXPECT_EQ(g.t_ns, 123456789);
    ASSERT_GE(g.boundary_count, 6);
    const Tissue order[] = {Tissue::air,       Tissue::skin,       Tissue::fat,
                            Tissue::muscle,    Tissue::connective, Tissue::vein_lumen,
                            Tissue::connective};
    for (int i = 0; i < 6; ++i) {
      const Boundary& b = g.boundaries[i];
      EXPECT_EQ(b.from, order[i]);
      EXPECT_EQ(b.to, order[i + 1]);
      EXPECT_EQ(b.wall, i == 0   ? Organ::skin
                        : i == 2 ? Organ::fascia
                        : i >= 4 ? Organ::vein
                                 : Organ::none);
      EXPECT_EQ(b.leaving, i == 5);
      EXPECT_LT(unpack(b.n).dot(scene.direction), 0);
      EXPECT_NEAR(unpack(b.n).norm(), 1, 1e-9);
      if (i > 0) {
        EXPECT_GT(along(scene, b), along(scene, g.boundaries[i - 1]));
      }
    }
    // The landmark lies on a facet of the skin; the skin is rounded over it by less than 0.1 mm.
    // Once punctured the snapshot's skin is the plane there.
    const double skin = along(scene, g.boundaries[0]);
    const double sine = -scene.direction.dot(unpack(g.skin.n));
    const SurfacePoint rounded = scene.query.rounded(0, scene.entry);
    EXPECT_LT((rounded.p_A - scene.entry).norm(), 1e-4);
    const double plane =
        (rounded.p_A - scene.entry).dot(rounded.n_A) / scene.direction.dot(rounded.n_A);
    EXPECT_NEAR(skin, plane, 1e-9);
    EXPECT_NEAR(along(scene, g.boundaries[1]) - skin, scene.patient.layers.skin / sine, 1e-9);
    EXPECT_NEAR(along(scene, g.boundaries[2]) - skin,
                (scene.patient.layers.skin + scene.patient.layers.fat) / sine, 1e-9);
    std::vector<double> walls;
    for (const RayHit& hit : scene.query.cast(scene.entry, scene.direction, 0.1)) {
      if (hit.organ == Organ::vein) walls.push_back(hit.s);
      if (hit.organ == Organ::muscle && !hit.entering) {
        EXPECT_NEAR(along(scene, g.boundaries[3]), hit.s, 1e-9);
      }  // before the plane is reached
    }
    ASSERT_GE(walls.size(), 2u);
    EXPECT_NEAR(along(scene, g.boundaries[4]), walls[0], 1e-9);
    EXPECT_NEAR(along(scene, g.boundaries[5]), walls[1], 1e-9);
  }
}

TEST(LocalGeometryBuilder, MuscleEndsAtItsPlaneAwayFromItsBorder) {
  const Scene scene(Side::right);
  ToolPlacement tool = scene.tool(-0.005);
  const Vec3 n = scene.query.closest(0, scene.entry).n_A;
  tool.X_AT = makePose(rotationWithZ(-n), scene.entry + 0.005 * n);
  const LocalGeometry g = scene.builder.build(1, 0, tool, Pose::Identity());
  ASSERT_GE(g.boundary_count, 4);
  const SoftLayers& layers = scene.patient.layers;
  const double depths[] = {0, layers.skin, layers.skin + layers.fat,
                           layers.skin + layers.fat + layers.muscle};
  for (int i = 0; i < 4; ++i) {
    const double depth = (unpack(g.skin.p) - unpack(g.boundaries[i].p)).dot(unpack(g.skin.n));
    // The muscle's mesh is made of the same layers on a surface that bends.
    EXPECT_NEAR(depth, depths[i], i == 3 ? 0.5e-3 : 1e-9);
  }
}

TEST(LocalGeometryBuilder, BonesTouchTheirMeshesNearTheNeedle) {
  const Scene scene(Side::right);
  for (const double depth : {-0.01, 0.005, 0.02, 0.035}) {
    const LocalGeometry g = scene.build(depth);
    ASSERT_GE(g.bone_count, 2);
    ASSERT_EQ(g.bones[0].organ, Organ::clavicle);
    // Distance from tip (and inserted shaft) to mesh and to capsule agree.
    double mesh = 1, capsule = 1;
    const Vec3 a = unpack(g.bones[0].a), b = unpack(g.bones[0].b);
    for (int i = 0; i <= 200; ++i) {
      const double s = depth > 0 ? depth * i / 200 : depth;
      const Vec3 p = scene.entry + s * scene.direction;
      const double t = std::clamp((p - a).dot(b - a) / (b - a).squaredNorm(), 0.0, 1.0);
      mesh = std::min(mesh, scene.query.closest(1, p).distance);
      capsule = std::min(capsule, (p - a - t * (b - a)).norm() - g.bones[0].radius);
    }
    // The capsule touches at the nearest point; beside it the bone bends away by less than this.
    EXPECT_NEAR(capsule, mesh, 0.15e-3) << "tip at " << depth;
  }
}

TEST(LocalGeometryBuilder, EveryBoneInReachHasAPlaceTheNearestFirst) {
  const Scene scene(Side::right);
  int shared = 0;
  for (double depth = -0.02; depth < 0.06; depth += 0.002) {
    const LocalGeometry g = scene.build(depth);
    ASSERT_LE(g.bone_count, LocalGeometry::kMaxBones);
    const auto start = scene.tool(depth);
    std::vector<int> bones;
    double before = 0;
    for (int i = 0; i < g.bone_count; ++i) {
      if (!bones.empty() && bones.back() == g.bones[i].bone) continue;
      EXPECT_EQ(std::count(bones.begin(), bones.end(), g.bones[i].bone),
                0);  // a bone's capsules lie together
      bones.push_back(g.bones[i].bone);
      const Vec3 tip = start.X_AT.translation(), back = depth > 0 ? scene.entry : tip;
      const double distance = scene.query.nearSegment(g.bones[i].bone, tip, back).distance;
      EXPECT_GT(distance, before - 5e-4);  // the shaft ends on the skin rounded, not at the entry
      before = distance;
    }
    for (std::size_t i = 0; i < scene.patient.organs.size(); ++i) {
      const Organ organ = scene.patient.organs[i].organ;
      if (organ != Organ::clavicle && organ != Organ::rib) continue;
      if (scene.query.closest(static_cast<int>(i), start.X_AT.translation()).distance > 0.039)
        continue;
      EXPECT_EQ(std::count(bones.begin(), bones.end(), static_cast<int>(i)), 1)
          << scene.patient.organs[i].id;
    }
    shared += bones.size() > 1 && g.bone_count > static_cast<int>(bones.size());
  }
  EXPECT_GT(shared, 0);
}

TEST(LocalGeometryBuilder, TheClavicleIsTheGuideOnTheTaughtLine) {
  const Scene scene(Side::right);
  const LocalGeometry g = scene.build(0.037);
  const Vec3 a = unpack(g.bones[0].a), b = unpack(g.bones[0].b);
  double least = 1;
  for (int i = 0; i <= 370; ++i) {
    const Vec3 p = scene.entry + 1e-4 * i * scene.direction;
    const double t = std::clamp((p - a).dot(b - a) / (b - a).squaredNorm(), 0.0, 1.0);
    least = std::min(least, (p - a - t * (b - a)).norm() - g.bones[0].radius);
  }
  EXPECT_GT(least, 1e-3);
  EXPECT_LT(least, 4e-3);
}

TEST(LocalGeometryBuilder, MirroredSideGivesTheMirroredSnapshot) {
  const Scene right(Side::right), left(Side::left);
  const auto mirrored = [](const Packed3& v) { return Vec3(-v[0], v[1], v[2]); };
  for (const double depth : {-0.01, 0.02}) {
    const LocalGeometry r = right.build(depth), l = left.build(depth);
    // Same operations on mirrored numbers; the tree may visit ties in another order.
    constexpr double kRounding = 1e-9;
    EXPECT_LT((unpack(r.skin.n) - mirrored(l.skin.n)).norm(), kRounding);
    EXPECT_LT((unpack(r.skin.p) - mirrored(l.skin.p)).norm(), kRounding);
    ASSERT_EQ(r.boundary_count, l.boundary_count);
    for (int i = 0; i < r.boundary_count; ++i) {
      EXPECT_EQ(r.boundaries[i].to, l.boundaries[i].to);
      // Vessels and lungs of the two sides differ toward the midline, so their grids lie otherwise.
      const bool twin = r.boundaries[i].wall == Organ::none ||
                        r.boundaries[i].wall == Organ::skin ||
                        r.boundaries[i].wall == Organ::fascia;
      EXPECT_LT((unpack(r.boundaries[i].p) - mirrored(l.boundaries[i].p)).norm(),
                twin ? kRounding : 5e-5);
      EXPECT_LT((unpack(r.boundaries[i].n) - mirrored(l.boundaries[i].n)).norm(),
                twin ? kRounding : 0.05);
    }
    ASSERT_EQ(r.bone_count, l.bone_count);
    // Neither the ends of a capsule nor the sides of a chain have an order.
    const auto apart = [&](const Capsule& a, const Capsule& b) {
      const double straight =
          (unpack(a.a) - mirrored(b.a)).norm() + (unpack(a.b) - mirrored(b.b)).norm();
      const double crossed =
          (unpack(a.a) - mirrored(b.b)).norm() + (unpack(a.b) - mirrored(b.a)).norm();
      return std::min(straight, crossed) + std::abs(a.radius - b.radius);
    };
    for (int i = 0; i < r.bone_count; ++i) {
      double least = 1;
      for (int k = 0; k < l.bone_count; ++k)
        if (r.bones[i].bone == l.bones[k].bone)
          least = std::min(least, apart(r.bones[i], l.bones[k]));
      EXPECT_LT(least, kRounding);
    }
  }
}

TEST(LocalGeometryBuilder, IsExpressedInTheDeviceFrame) {
  const Scene scene(Side::right);
  RandomStream random = RandomStream::ofSeed(31);
  for (int i = 0; i < 5; ++i) {
    const Pose X_DA = makePose(rotationWithZ(randomDirection(random)), randomIn(random, 1));
    const LocalGeometry a = scene.build(0.02), d = scene.build(0.02, X_DA);
    constexpr double kRounding = 1e-12;
    EXPECT_LT((X_DA * unpack(a.skin.p) - unpack(d.skin.p)).norm(), kRounding);
    EXPECT_LT((X_DA.linear() * unpack(a.skin.n) - unpack(d.skin.n)).norm(), kRounding);
    ASSERT_EQ(a.boundary_count, d.boundary_count);
    ASSERT_EQ(a.bone_count, d.bone_count);
    for (int k = 0; k < a.boundary_count; ++k) {
      EXPECT_LT((X_DA * unpack(a.boundaries[k].p) - unpack(d.boundaries[k].p)).norm(), kRounding);
      EXPECT_LT((X_DA.linear() * unpack(a.boundaries[k].n) - unpack(d.boundaries[k].n)).norm(),
                kRounding);
    }
    for (int k = 0; k < a.bone_count; ++k) {
      EXPECT_LT((X_DA * unpack(a.bones[k].a) - unpack(d.bones[k].a)).norm(), kRounding);
      EXPECT_LT((X_DA * unpack(a.bones[k].b) - unpack(d.bones[k].b)).norm(), kRounding);
      EXPECT_EQ(a.bones[k].radius, d.bones[k].radius);
    }
  }
}

TEST(LocalGeometryBuilder, StraightDownMeetsTheLungAfterTheSoftTissue) {
  const Scene scene(Side::right);
  // 60 mm caudal of the vein the lung lies behind the ribs; aim at its middle.
  const Vec3 aim(-0.055, 0.06, -0.065);
  const Vec3 direction = Vec3(0, 1, 0);
  ToolPlacement tool;
  tool.X_AT = makePose(rotationWithZ(direction), Vec3(aim.x(), -0.03, aim.z()));
  const LocalGeometry g = scene.builder.build(1, 0, tool, Pose::Identity());
  ASSERT_GE(g.boundary_count, 5);
  EXPECT_EQ(g.boundaries[4].to, Tissue::lung);
  EXPECT_EQ(g.boundaries[4].wall, Organ::lung);
  EXPECT_EQ(g.boundaries[4].from, Tissue::connective);
}

TEST(LocalGeometryBuilder, ANeedleThatPointsAwayHasNoBoundaries) {
  const Scene scene(Side::right);
  ToolPlacement tool = scene.tool(-0.01);
  tool.X_AT.linear() = rotationWithZ(-Vec3::UnitY());
  const LocalGeometry g = scene.builder.build(1, 0, tool, Pose::Identity());
  EXPECT_EQ(g.boundary_count, 0);
  EXPECT_NEAR(unpack(g.skin.n).norm(), 1, 1e-9);
}

TEST(LocalGeometryBuilder, SameInputsSameBits) {
  const Scene scene(Side::right);
  const LocalGeometry a = scene.build(0.02), b = scene.build(0.02);
  for (int i = 0; i < a.boundary_count; ++i) EXPECT_EQ(a.boundaries[i].p, b.boundaries[i].p);
  for (int i = 0; i < a.bone_count; ++i) EXPECT_EQ(a.bones[i].a, b.bones[i].a);
}

}  // namespace
}  // namespace palpa::anatomy

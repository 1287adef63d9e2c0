#include <gtest/gtest.h>

#include "anatomy/base/error.h"
#include "anatomy/import/surface_topology.h"
#include "sample_meshes.h"

namespace palpa::anatomy {
namespace {

using namespace test;

void isTheBox(const std::vector<RawMesh>& meshes, double tolerance) {
  ASSERT_EQ(meshes.size(), 1u);
  const SurfaceCheck check = checkSurface(meshes[0]);
  EXPECT_TRUE(check.sound());
  EXPECT_EQ(check.triangles, 12u);
  EXPECT_LT((check.low - Vec3(0, -0.5, -1)).norm(), tolerance);
  EXPECT_LT((check.high - Vec3(2, 2.5, 3)).norm(), tolerance);
  EXPECT_NEAR(check.volume, 24, 24 * tolerance);
}

TEST(MeshReaders, EveryFormatGivesTheSameSolid) {
  const RawMesh mesh = box();
  isTheBox(readMesh(MeshFormat::obj, asObj(mesh), "box.obj"), 1e-12);
  isTheBox(readMesh(MeshFormat::stl, asStl(mesh, true), "text.stl"), 1e-12);
  isTheBox(readMesh(MeshFormat::stl, asStl(mesh, false), "binary.stl"), 1e-12);
  for (const char coding : {'t', 'l', 'b'})
    isTheBox(readMesh(MeshFormat::ply, asPly(mesh, coding), "box.ply"), 1e-12);
}

TEST(MeshReaders, GltfNodesArePlacedByAllTheirParents) {
  const std::vector<RawMesh> meshes = readMesh(MeshFormat::gltf, asGlb(box()), "box.glb");
  ASSERT_EQ(meshes.size(), 1u);
  EXPECT_EQ(meshes[0].name, "box");
  const SurfaceCheck check = checkSurface(meshes[0]);
  EXPECT_TRUE(check.sound());
  // (x, y, z) -> (x, y, z + 5), turned: (x, -(z + 5), y), twice.
  EXPECT_LT((check.low - Vec3(0, -16, -1)).norm(), 1e-5);
  EXPECT_LT((check.high - Vec3(4, -8, 5)).norm(), 1e-5);
  EXPECT_NEAR(check.volume, 8 * 24, 1e-3);
}

TEST(MeshReaders, PolygonsBecomeFans) {
  const std::vector<RawMesh> meshes =
      readMesh(MeshFormat::obj, "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nf 1 2 3 4\n", "quad.obj");
  ASSERT_EQ(meshes[0].triangles.size(), 2u);
  EXPECT_EQ(meshes[0].triangles[1], (std::array<std::uint32_t, 3>{0, 2, 3}));
}

/// What is wrong, and where, in one line.
void refused(MeshFormat format, const std::string& bytes, const std::string& word) {
  try {
    readMesh(format, bytes, "the file");
    FAIL() << word;
  } catch (const Error& error) {
    EXPECT_NE(std::string(error.what()).find(word), std::string::npos)
        << word << " | " << error.what();
    EXPECT_EQ(std::string(error.what()).rfind("the file: ", 0), 0u) << error.what();
  }
}

TEST(MeshReaders, LiesAreToldInPlainWords) {
  refused(MeshFormat::obj, "v 0 0 0\nv 1 0 0\nf 1 2 3\n", "point 3");
  refused(MeshFormat::obj, "v 0 zero 0\n", "\"zero\" is not a number");
  refused(MeshFormat::obj, "v 0 nan 0\nv 0 0 0\nv 1 0 0\nf 1 2 3\n", "\"nan\" is not a number");
  refused(MeshFormat::obj, "", "no surface");
  std::string stl = asStl(box(), false);
  stl[80] = stl[81] = stl[82] = stl[83] = '\x7f';
  refused(MeshFormat::stl, stl, "claims 2139062143 facets and has room for 12");
  refused(MeshFormat::ply,
          "ply\nformat ascii 1.0\nelement vertex 4000000000\nproperty float x\nend_header\n",
          "claims 4000000000");
  refused(MeshFormat::ply, "ply\nformat ascii 1.0\nelement vertex 1\nproperty float x\n", "no end");
  std::string glb = asGlb(box());
  glb.resize(glb.size() - 4);
  refused(MeshFormat::gltf, glb, "claims");
  refused(MeshFormat::gltf, asGlb(box(), true), "no surface");
}

TEST(MeshReaders, AnotherEndingIsRefused) {
  EXPECT_THROW(meshFormat("a.step"), UsageError);
  EXPECT_EQ(meshFormat("A.STL"), MeshFormat::stl);
}

}  // namespace
}  // namespace palpa::anatomy

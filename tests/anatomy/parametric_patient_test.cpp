#include "anatomy/parametric_patient.h"

#include <gtest/gtest.h>

#include <fstream>

#include "anatomy/geometry/error.h"
#include "anatomy/patient_check.h"
#include "anatomy/shapes/mesh_tools.h"
#include "test_shapes.h"

namespace palpa::anatomy {
namespace {

double value(const std::vector<Finding>& findings, const std::string& what) {
  for (const Finding& f : findings)
    if (f.name == what) return f.value;
  ADD_FAILURE() << "no finding " << what;
  return 0;
}

/// Everything the taught manoeuvre needs, measured on the meshes.
void expectTeachable(const PatientParameters& p) {
  const Patient patient = buildPatient(p);
  const std::vector<Finding> findings = checkPatient(patient);
  for (const Finding& f : findings)
    EXPECT_TRUE(f.ok) << patient.name << ": " << f.name << " is " << f.value << " " << f.unit
                      << ", wanted " << f.wanted;
  // The agreed accuracies of the drawn figures on the meshes.
  EXPECT_NEAR(value(findings, "vein depth under the skin"), 1e3 * p.vein_depth, 0.3);
  EXPECT_NEAR(value(findings, "vein diameter"), 1e3 * p.vein_diameter, 0.2);
  EXPECT_NEAR(value(findings, "vein to pleura"), 1e3 * p.pleura_distance, 0.5);
  const double chord =
      (patient.landmark(landmark::kAcromialEnd) - patient.landmark(landmark::kSternalEnd)).norm();
  EXPECT_NEAR(1e3 * chord, 1e3 * p.clavicle_length, 1.0);  // the blunt ends point off the chord
  EXPECT_LT(value(findings, "triangles"), 120000);
}

TEST(ParametricPatient, ReferenceIsTeachableOnBothSides) {
  expectTeachable(drawParameters(referenceFile(), Side::right, 0));
  expectTeachable(drawParameters(referenceFile(), Side::left, 0));
}

class Drawn : public testing::TestWithParam<int> {};
TEST_P(Drawn, IsTeachable) {
  const Side side = GetParam() % 2 ? Side::right : Side::left;
  expectTeachable(drawParameters(referenceFile(), side, GetParam()));
}
INSTANTIATE_TEST_SUITE_P(Seeds, Drawn, testing::Range(1, 13));

TEST(ParametricPatient, SidesAreExactMirrorImages) {
  const Patient &right = referencePatient(Side::right), &left = referencePatient(Side::left);
  const auto mirrored = [](const Vec3& p) { return Vec3(-p.x(), p.y(), p.z()); };
  ASSERT_EQ(right.organs.size(), left.organs.size());
  for (std::size_t i = 0; i < right.organs.size(); ++i) {
    const TriangleMesh &a = right.organs[i].mesh, &b = left.organs[i].mesh;
    ASSERT_EQ(a.points.size(), b.points.size());
    for (std::size_t k = 0; k < a.points.size(); ++k) {
      ASSERT_EQ(a.points[k], mirrored(b.points[k]));
      ASSERT_EQ(a.normals[k], mirrored(b.normals[k]));
    }
    EXPECT_NEAR(signedVolume(a), signedVolume(b), 1e-12);
  }
  // The nearest point of the mesh may be a tie between two triangles: equal to rounding only.
  for (const auto& [key, p] : right.landmarks)
    EXPECT_LT((p - mirrored(left.landmark(key))).norm(), 1e-12) << key;
  EXPECT_LT(right.landmark(landmark::kAcromialEnd).x(), -0.1);  // +x is the patient's left
}

TEST(ParametricPatient, OriginIsTheNotchOnTheSkin) {
  const Patient& patient = referencePatient();
  EXPECT_EQ(patient.landmark(landmark::kNotch), Vec3::Zero());
  double nearest = 1;
  for (const Vec3& p : patient.organ(Organ::skin).mesh.points)
    nearest = std::min(nearest, p.norm());
  EXPECT_LT(nearest, 0.0032);  // one cell of the skin's mesh
}

TEST(ParametricPatient, NormalsAreUnitAndFaceOutward) {
  for (const OrganSurface& o : referencePatient().organs) {
    for (const Vec3& n : o.mesh.normals) ASSERT_NEAR(n.norm(), 1, 1e-9) << o.id;
    for (const auto& t : o.mesh.triangles) {
      const Vec3& a = o.mesh.points[t[0]];
      const Vec3 face = (o.mesh.points[t[1]] - a).cross(o.mesh.points[t[2]] - a);
      const Vec3 mean = o.mesh.normals[t[0]] + o.mesh.normals[t[1]] + o.mesh.normals[t[2]];
      if (face.norm() > 1e-9) {
        EXPECT_GT(face.normalized().dot(mean), -0.5) << o.id;
      }  // creases bend
    }
    EXPECT_TRUE(isClosed(o.mesh)) << o.id;
    EXPECT_GT(signedVolume(o.mesh), 0) << o.id;
  }
}

TEST(ParametricPatient, SameSeedSameBits) {
  const PatientParameters a = drawParameters(referenceFile(), Side::left, 5);
  const PatientParameters b = drawParameters(referenceFile(), Side::left, 5);
  EXPECT_EQ(a.vein_depth, b.vein_depth);
  const Patient p = buildPatient(a), q = buildPatient(b);
  for (std::size_t i = 0; i < p.organs.size(); ++i)
    EXPECT_EQ(p.organs[i].mesh.points, q.organs[i].mesh.points);
}

TEST(ParametricPatient, ImpossibleParametersNameTheConstraint) {
  const auto message = [](auto change) -> std::string {
    PatientParameters p;
    change(p);
    try {
      buildPatient(p);
    } catch (const Error& e) {
      return e.what();
    }
    return "no error";
  };
  EXPECT_NE(message([](auto& p) { p.vein_depth = 0.06; }).find("vein_depth"), std::string::npos);
  EXPECT_NE(message([](auto& p) { p.layers.fat = NAN; }).find("layers.fat"), std::string::npos);
  // Inside its range, but the vein would lie in the bone or the needle too steep.
  EXPECT_NE(message([](auto& p) { p.vein_depth = 0.014; }).find("parametric patient"),
            std::string::npos);
  EXPECT_NE(message([](auto& p) { p.vein_depth = 0.028; }).find("degrees"), std::string::npos);
}

TEST(DrawParameters, SeedZeroIsTheMeansAndOthersSpread) {
  const PatientParameters mean = drawParameters(referenceFile(), Side::right, 0);
  EXPECT_DOUBLE_EQ(mean.vein_depth, 0.020);
  EXPECT_DOUBLE_EQ(mean.vein_diameter, 0.009);
  EXPECT_DOUBLE_EQ(mean.pleura_distance, 0.006);
  EXPECT_DOUBLE_EQ(mean.clavicle_length, 0.1494);
  double sum = 0, squares = 0;
  constexpr int kDraws = 60;
  for (int seed = 1; seed <= kDraws; ++seed) {
    const PatientParameters p = drawParameters(referenceFile(), Side::right, seed);
    EXPECT_GE(p.vein_depth, 0.0175);
    EXPECT_LE(p.vein_depth, 0.026);
    const double d = p.pleura_distance - 0.006;
    sum += d;
    squares += d * d;
  }
  // Pleura distance is hardly tied to feasibility: mean within three standard errors of a spread of
  // 2 mm (0.26 mm each), sd near that of the truncated normal (1.7 mm).
  EXPECT_NEAR(sum / kDraws, 0, 0.0008);
  EXPECT_NEAR(std::sqrt(squares / kDraws), 0.0017, 0.0005);
}

TEST(DrawParameters, BadReferenceFilesAreRefused) {
  const ScratchFolder folder("reference");
  EXPECT_THROW(drawParameters((folder / "absent.json").string(), Side::right, 1), Error);
  const auto refused = [&](const std::string& text) {
    std::ofstream(folder / "r.json") << text;
    EXPECT_THROW(drawParameters((folder / "r.json").string(), Side::right, 0), Error) << text;
  };
  refused("{");
  refused("[]");
  refused(R"({"vein_depth": {"unit": "cm", "mean": 2, "sd": 1, "range": [1, 3]}})");
  refused(R"({"vein_depth": {"unit": "mm", "mean": 20, "sd": 6}})");
  refused(R"({"vein_depth": {"unit": "mm", "mean": 40, "sd": 6, "range": [10, 30]}})");
}

}  // namespace
}  // namespace palpa::anatomy

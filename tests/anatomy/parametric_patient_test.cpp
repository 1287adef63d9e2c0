#include "anatomy/parametric/parametric_patient.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>

#include "anatomy/base/error.h"
#include "anatomy/patient/patient_check.h"
#include "anatomy/query/triangle_tree.h"
#include "anatomy/shapes/mesh_tools.h"
#include "test_shapes.h"
#include "tests/support/counts.h"

namespace palpa::anatomy {
namespace {

double value(const std::vector<PatientFinding>& findings, const std::string& what) {
  for (const PatientFinding& f : findings)
    if (f.name == what) return f.value;
  ADD_FAILURE() << "no finding " << what;
  return 0;
}

/// Everything the taught manoeuvre needs, measured on the meshes.
void expectTeachable(const PatientParameters& p) {
  const Patient patient = buildPatient(p);
  const std::vector<PatientFinding> findings = checkPatient(patient);
  for (const PatientFinding& f : findings)
    EXPECT_TRUE(f.ok) << patient.name << ": " << f.name << " is " << f.value << " " << f.unit
                      << ", wanted " << f.wanted;
  // The agreed accuracies of the drawn figures on the meshes.
  EXPECT_NEAR(value(findings, "vein depth under the skin"), 1e3 * p.vein_depth, 0.2)
      << patient.name;
  EXPECT_NEAR(value(findings, "vein diameter"), 1e3 * p.vein_diameter, 0.2) << patient.name;
  EXPECT_NEAR(value(findings, "vein to pleura"), 1e3 * p.pleura_distance, 0.3) << patient.name;
  const double chord =
      (patient.landmark(landmark::kAcromialEnd) - patient.landmark(landmark::kSternalEnd)).norm();
  EXPECT_NEAR(1e3 * chord, 1e3 * p.clavicle_length, 0.3)
      << patient.name;  // the blunt ends point off the chord
  EXPECT_LE(value(findings, "triangles"), 300'000) << patient.name;
}

using test::fullCounts;

TEST(ParametricPatient, ReferenceIsTeachableOnBothSides) {
  expectTeachable(drawParameters(reference(), Side::right, 0));
  expectTeachable(drawParameters(reference(), Side::left, 0));
}

/// Women and men, short to tall, lean to obese, either side.
Person personNumber(int i) {
  Person person;
  person.sex = i % 2 ? Sex::male : Sex::female;
  person.height = 1.48 + 0.02 * (i % 17) + (i % 2 ? 0.10 : 0);
  person.bmi = 17 + 1.25 * (i * 7 % 22);
  return person;
}

class Drawn : public testing::TestWithParam<int> {};
TEST_P(Drawn, IsTeachable) {
  constexpr int kAll = 200, kSome = 4;
  const int chunk = (fullCounts() ? kAll : kSome) / 4;
  for (int i = GetParam() * chunk + 1; i <= (GetParam() + 1) * chunk; ++i) {
    PatientParameters p = drawParameters(reference(), i % 3 ? Side::right : Side::left,
                                         static_cast<std::uint64_t>(i), personNumber(i));
    p.extent = i % 4 == 1 ? Extent::bust : Extent::torso;
    expectTeachable(p);
  }
}
INSTANTIATE_TEST_SUITE_P(Quarters, Drawn, testing::Range(0, 4));

// What lies in the middle or differs between a body's own sides (great vessels, airway, lungs) does
// not.
bool mirrors(Organ organ) {
  return organ != Organ::vein && organ != Organ::artery && organ != Organ::airway &&
         organ != Organ::lung;
}

TEST(ParametricPatient, PuncturedSidesAreExactMirrorImages) {
  const Patient &right = referencePatient(), &left = referencePatient(Side::left);
  const auto mirrored = [](const Vec3& p) { return Vec3(-p.x(), p.y(), p.z()); };
  ASSERT_EQ(right.organs.size(), left.organs.size());
  for (std::size_t i = 0; i < right.organs.size(); ++i) {
    if (!mirrors(right.organs[i].organ)) continue;
    const TriangleMesh &a = right.organs[i].mesh, &b = left.organs[i].mesh;
    ASSERT_EQ(a.points.size(), b.points.size());
    for (std::size_t k = 0; k < a.points.size(); ++k) {
      ASSERT_EQ(a.points[k], mirrored(b.points[k]));
      ASSERT_EQ(a.normals[k], mirrored(b.normals[k]));
    }
    EXPECT_NEAR(signedVolume(a), signedVolume(b), 1e-12);
  }
  // The window is solved for, to 0.02 mm, in the veins' field, which is not alike on both sides of
  // a body.
  for (const auto& [key, p] : right.landmarks)
    EXPECT_LT((p - mirrored(left.landmark(key))).norm(), key == landmark::kWindow ? 2e-5 : 1e-12)
        << key;
  EXPECT_LT(right.landmark(landmark::kAcromialEnd).x(), -0.1);  // +x is the patient's left
}

TEST(ParametricPatient, TheCavaIsOnTheRightAndTheArchOnTheLeftWhicheverSideIsPunctured) {
  for (const Side side : {Side::right, Side::left}) {
    const Patient& patient = referencePatient(side);
    const auto lowest = [&](Organ organ) {
      const auto& points = patient.organ(organ).mesh.points;
      return *std::min_element(points.begin(), points.end(),
                               [](const Vec3& a, const Vec3& b) { return a.z() < b.z(); });
    };
    EXPECT_LT(lowest(Organ::vein).x(), -0.01);   // superior vena cava
    EXPECT_GT(lowest(Organ::artery).x(), 0.01);  // descending aorta
  }
}

TEST(ParametricPatient, OriginIsTheNotchOnTheSkin) {
  const Patient& patient = referencePatient();
  EXPECT_EQ(patient.landmark(landmark::kNotch), Vec3::Zero());
  EXPECT_LT(
      std::abs(TriangleTree(patient.organ(Organ::skin).mesh).closest(Vec3::Zero()).signed_distance),
      5e-4);
}

TEST(ParametricPatient, NormalsAreUnitAndFaceOutward) {
  for (const OrganSurface& o : referencePatient().organs) {
    for (const Vec3& n : o.mesh.normals) ASSERT_NEAR(n.norm(), 1, 1e-7) << o.id;  // in floats
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
  const PatientParameters a = drawParameters(reference(), Side::left, 5);
  const PatientParameters b = drawParameters(reference(), Side::left, 5);
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
  // Inside its ranges, but no line leads behind so short a clavicle through so much fat.
  EXPECT_NE(message([](auto& p) {
              p.clavicle_length = 0.121;
              p.layers.fat = 0.019;
              p.layers.muscle = 0.015;
            }).find("degrees"),
            std::string::npos);
}

TEST(DrawParameters, SeedZeroIsTheMeansAndOthersSpread) {
  const PatientParameters mean = drawParameters(reference(), Side::right, 0);
  EXPECT_DOUBLE_EQ(mean.vein_depth, 0.020);
  EXPECT_DOUBLE_EQ(mean.vein_diameter, 0.009);
  EXPECT_DOUBLE_EQ(mean.pleura_distance, 0.006);
  EXPECT_DOUBLE_EQ(mean.clavicle_length, 0.1494);
  EXPECT_DOUBLE_EQ(mean.height, 1.70);
  EXPECT_NEAR(mean.layers.skin + mean.layers.fat + mean.layers.muscle, 0.016, 5e-5);
}

// The published means within 5 % and spreads within 10 %, of women and men drawn without
// statements.
TEST(DrawParameters, PopulationHasThePublishedMeansAndSpreads) {
  const int draws = fullCounts() ? 1000 : 60;
  struct Figure {
    const char* what;
    double mean, sd, PatientParameters::*field;
    double sum = 0, squares = 0;
  };
  Figure figures[] = {{"vein depth", 0.020, 0.006, &PatientParameters::vein_depth},
                      {"vein diameter", 0.009, 0.002, &PatientParameters::vein_diameter},
                      {"pleura distance", 0.006, 0.002, &PatientParameters::pleura_distance},
                      {"clavicle length", 0.1494, 0.0103, &PatientParameters::clavicle_length}};
  for (int seed = 1; seed <= draws; ++seed) {
    const PatientParameters p =
        drawParameters(reference(), Side::right, static_cast<std::uint64_t>(seed));
    for (Figure& f : figures) {
      f.sum += p.*f.field;
      f.squares += (p.*f.field) * (p.*f.field);
    }
  }
  for (const Figure& f : figures) {
    const double mean = f.sum / draws, sd = std::sqrt(f.squares / draws - mean * mean);
    // The stated bounds; of fewer draws three standard errors more.
    const double slack = fullCounts() ? 0 : 3 / std::sqrt(draws);
    EXPECT_NEAR(mean, f.mean, 0.05 * f.mean + slack * f.sd) << f.what;
    EXPECT_NEAR(sd, f.sd, (0.10 + slack / std::sqrt(2.0)) * f.sd) << f.what;
  }
}

TEST(DrawParameters, WhatIsStatedOfAPersonShiftsWhatGoesWithIt) {
  const auto of = [](double height, double bmi) {
    Person person;
    person.sex = Sex::female;
    person.height = height;
    person.bmi = bmi;
    return drawParameters(reference(), Side::right, 0, person);
  };
  EXPECT_GT(of(1.80, 25).clavicle_length, of(1.50, 25).clavicle_length + 0.01);
  EXPECT_GT(of(1.65, 35).vein_depth, of(1.65, 20).vein_depth + 0.005);
  EXPECT_GT(of(1.65, 35).layers.fat, of(1.65, 20).layers.fat + 0.003);
  EXPECT_THROW(of(3.0, 25), Error);
  EXPECT_THROW(of(1.65, 90), Error);
}

TEST(Population, BadFilesAreRefused) {
  const ScratchFolder folder("reference");
  EXPECT_THROW(readPopulation((folder / "absent.json").string()), Error);
  const auto refused = [&](const std::string& text) {
    std::ofstream(folder / "r.json") << text;
    EXPECT_THROW(readPopulation((folder / "r.json").string()), Error) << text;
  };
  refused("{");
  refused("[]");
  refused(R"({"vein_depth": {"unit": "cm", "mean": 2, "sd": 1, "range": [1, 3]}})");
  refused(R"({"vein_depth": {"unit": "mm", "mean": 20, "sd": 6}})");
  refused(R"({"vein_depth": {"unit": "mm", "mean": 40, "sd": 6, "range": [10, 30]}})");
}

}  // namespace
}  // namespace palpa::anatomy

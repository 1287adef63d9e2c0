#include <gtest/gtest.h>

#include <vector>

#include "anatomy/patient/patient_check.h"
#include "apps/station/assets.h"
#include "apps/task_needle/task_file.h"
#include "tests/competence/reference.h"
#include "tests/support/counts.h"

/// Deviations planted in good trials on drawn bodies: the larger one costs more, by the shipped
/// rules.
namespace palpa::competence {
namespace {

using palpa::test::kDeg;
using palpa::test::Script;

struct Scored {
  const anatomy::Patient& patient;
  anatomy::LandmarkFrame frame{patient};
  calibration::TaughtPath path = test::pathOn(patient);
  assess::ScoringRules rules =
      task_needle::readTask(station::assetFile("tasks/paracentesis.json")).rules;

  /// The same hand each time.
  double total(const Script& script) const {
    RandomStream draw(7, "test.planted");
    const auto samples = palpa::test::ScriptedHand(script, frame, path, draw).trial();
    return assess::assessTrial(assess::test::facts("success"), samples, patient,
                               assess::OrganDistance(assess::test::far), path, rules)
        .total;
  }
};

void expectRising(const Scored& body, const std::vector<Script>& scripts, const char* what) {
  double before = 0;
  for (std::size_t i = 0; i < scripts.size(); ++i) {
    const double total = body.total(scripts[i]);
    EXPECT_GT(total, before) << body.patient.name << ", " << what << ' ' << i;
    before = total;
  }
}

TEST(Planted, DeviationsCostTheMoreTheLargerTheyAreOnEveryBody) {
  const anatomy::Population population =
      anatomy::readPopulation(station::assetFile("patients/reference.json").string());
  int admitted = 0;
  for (std::uint64_t seed = 1; seed <= palpa::test::counted(2u, 200u); ++seed) {
    anatomy::PatientParameters p = anatomy::drawParameters(
        population, seed % 2 ? anatomy::Side::left : anatomy::Side::right, seed);
    p.extent = anatomy::Extent::bust;
    const anatomy::Patient patient = anatomy::buildPatient(p);
    if (!anatomy::whyNotScored(patient, anatomy::SurfaceQuery(patient)).empty()) continue;
    ++admitted;
    const Scored body{patient};
    for (const double sign : {1.0, -1.0}) {
      const auto steeper = [&](double deg) { return Script{.steeper = sign * deg * kDeg}; };
      const auto cephalad = [&](double deg) { return Script{.cephalad = sign * deg * kDeg}; };
      const auto along = [&](double mm) { return Script{.along = 1e-3 * sign * mm}; };
      const auto across = [&](double mm) { return Script{.across = 1e-3 * sign * mm}; };
      expectRising(body, {steeper(5), steeper(10), steeper(15)}, "steeper");
      expectRising(body, {cephalad(5), cephalad(10), cephalad(15)}, "cephalad");
      expectRising(body, {along(5), along(10)}, "along the clavicle");
      expectRising(body, {across(5), across(10)}, "across the clavicle");
    }
  }
  EXPECT_GT(admitted, 0);
}

}  // namespace
}  // namespace palpa::competence

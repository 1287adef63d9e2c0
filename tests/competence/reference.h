#pragma once

#include <cmath>
#include <limits>
#include <optional>

#include "anatomy/parametric/parametric_patient.h"
#include "apps/assess/competence/verdict.h"
#include "apps/assess/needle/assess_trial.h"
#include "tests/support/files.h"
#include "tests/support/scripted_trial.h"

namespace palpa::competence::test {

/// The reference patient's landmarks on a side; made once a process.
inline const anatomy::Patient& referencePatient(anatomy::Side side) {
  const auto make = [](anatomy::Side of) {
    anatomy::PatientParameters p = anatomy::drawParameters(
        anatomy::readPopulation(PALPA_SOURCE_DIR "/assets/patients/reference.json"), of, 0);
    p.extent = anatomy::Extent::bust;
    return anatomy::buildPatient(p);
  };
  static const anatomy::Patient right = make(anatomy::Side::right),
                                left = make(anatomy::Side::left);
  return side == anatomy::Side::right ? right : left;
}

/// The shipped path on a patient; on the reference patient.
inline calibration::TaughtPath pathOn(const anatomy::Patient& patient) {
  return calibration::readExpertPath(PALPA_SOURCE_DIR "/assets/tasks/paracentesis_expert_path.json")
      .onBody(assess::teachingLineOf(patient, anatomy::SurfaceQuery(patient)));
}
inline const calibration::TaughtPath& shippedPath(anatomy::Side side = anatomy::Side::right) {
  static const calibration::TaughtPath right = pathOn(referencePatient(anatomy::Side::right)),
                                       left = pathOn(referencePatient(anatomy::Side::left));
  return side == anatomy::Side::right ? right : left;
}
inline Checklist shippedChecklist() {
  return parseChecklist(palpa::test::slurp(PALPA_SOURCE_DIR "/assets/checklists/subclavian.json"),
                        "subclavian.json");
}
inline GlobalRating shippedGlobal() {
  return parseGlobalRating(
      palpa::test::slurp(PALPA_SOURCE_DIR "/assets/checklists/global_rating.json"),
      "global_rating.json");
}

/// A scripted trial, judged as a session judges it; `seed` even: on the right side.
inline assess::TrialAssessment judged(const palpa::test::Script& script, std::uint64_t seed,
                                      RandomStream& draw) {
  const anatomy::Side side = seed % 2 ? anatomy::Side::left : anatomy::Side::right;
  const anatomy::Patient& patient = referencePatient(side);
  const anatomy::LandmarkFrame frame(patient);
  const calibration::TaughtPath& path = shippedPath(side);
  std::vector<assess::TrialSample> samples =
      palpa::test::ScriptedHand(script, frame, path, draw).trial();
  assess::ScoringRules rules;
  rules.told_within_s = 10;
  if (palpa::test::succeeds(script)) {  // it is asked what was aspirated, and told
    samples.push_back(samples.back());
    samples.back().waiting = true;
  }
  return assess::assessTrial(
      assess::test::facts(palpa::test::succeeds(script) ? "success" : "aborted"), samples, patient,
      assess::OrganDistance(assess::test::far), path, rules);
}

inline Figures figuresOf(const assess::TrialAssessment& a) {
  return [&a](const std::string& name) -> std::optional<double> {
    for (const metrics::MetricValue& m : a.metrics)
      if (m.name == name) return m.value;
    return std::nullopt;
  };
}

}  // namespace palpa::competence::test

#pragma once

#include <algorithm>
#include <string>
#include <vector>

#include "anatomy/base/random.h"
#include "apps/study/analysis/power_analysis.h"
#include "apps/study/analysis/study_design.h"
#include "tests/study_analysis/rows.h"

/// Results of studies that never were, for pages to be made of.
namespace palpa::report::test {

using study_analysis::StudyDesign;
using study_analysis::StudyKind;
using study_analysis::StudyResult;
using study_analysis::StudyRow;

/// Twenty simulated subjects, as many as Tzafestas et al. 2008 had.
inline StudyResult pilotResult() {
  return analyseStudy(study_analysis::drawStudy(study_analysis::pilotModels(), 5, 10, 1),
                      study_analysis::test::pilotDesign());
}

/// Twenty-one subjects who search; times that fall, success that rises more with cues.
inline StudyResult searchResult() {
  std::vector<StudyRow> rows;
  RandomStream random = RandomStream::ofSeed(4);
  for (int s = 0; s < 21; ++s) {
    const bool cues = s % 2 != 0;
    const double own = 3 * random.openNormal(), skill = 0.5 + 0.1 * random.openNormal(),
                 gained = (cues ? 0.12 : 0.05) + 0.1 * random.openNormal(),
                 hurry = (cues ? 3 : 1) + 2 * random.openNormal();
    for (int t = 0; t < 160; ++t) {
      const bool training = t >= 60 && t < 100, after = t >= 100;
      const double seconds = std::max(3.0, 14 + own + 20.0 / (1 + 0.04 * t) + (training ? 6 : 0) -
                                               (after ? hurry : 0) + 4 * random.openNormal());
      const bool found = random.openUniform() < skill + (after ? gained : 0);
      rows.push_back({"S" + std::to_string(s + 1),
                      "trainee",
                      training ? (cues ? "augmented" : "degraded") : "full",
                      training ? "training"
                      : after  ? "evaluation"
                               : "baseline",
                      t < 60 ? 1 : 2,
                      t + 1,
                      0,
                      true,
                      "palpa 0.1.0",
                      {{"success", found ? 1.0 : 0.0}, {"time_s", seconds}}});
    }
  }
  orderAndNumber(rows, "example");
  StudyDesign design;
  design.kind = StudyKind::search_study;
  design.title = "Search study";
  design.conditions = {"full", "degraded", "augmented"};
  design.words = {{"degraded", "a weak device without cues"},
                  {"augmented", "a weak device with cues"}};
  return analyseStudy(rows, design);
}

}  // namespace palpa::report::test

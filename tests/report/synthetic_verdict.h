#pragma once

#include "apps/assess/competence/verdict.h"
#include "apps/report/paper/rating_form.h"
#include "tests/report/synthetic_report.h"

/// A made-up verdict on a made-up trial, by the shipped forms.
namespace palpa::report::test {

inline const competence::Checklist& shippedChecklist() {
  static const competence::Checklist list = competence::parseChecklist(
      slurp(PALPA_SOURCE_DIR "/assets/checklists/subclavian.json"), "subclavian.json");
  return list;
}

inline const competence::GlobalRating& shippedGlobal() {
  static const competence::GlobalRating global = competence::parseGlobalRating(
      slurp(PALPA_SOURCE_DIR "/assets/checklists/global_rating.json"), "global_rating.json");
  return global;
}

/// Needle never drawn back, advanced without suction, pleura punctured; everything else well.
inline std::optional<double> madeUpFigure(const std::string& name) {
  if (name == "withdrawal_turn_deg") return std::nan("");
  if (name == "aspirated_advance_pct") return 20;
  for (const char* one : {"success", "pleural_punctures", "skin_punctures", "needle_passes"})
    if (name == one) return 1;
  return 0;
}

/// The trial with trouble, judged, with two errors and another trial beside.
inline SessionReport judgedReport() {
  SessionReport report = syntheticReport(1);
  TrialPage& page = report.trials.front();
  page.assessment.errors = {
      {"cephalad", "Too cephalad", "The needle was aimed 14° too far toward the head <there>.", 9.4,
       14, 10, "deg", 1},
      {"left_vein", "Needle left the vein", "Blood had come for 0.6 s.", 24, 0.6, 1, "s", 2}};
  page.verdict =
      competence::judge({true, training::Outcome::success}, shippedChecklist(), madeUpFigure,
                        {{"sterile", competence::kDone}}, &shippedGlobal(), {{"plan", 3}}, 0.98);
  page.certification = competence::whatCannotBeCertified(1);
  page.beside = {"expert", "The dash-dotted line is an expert's.", page.samples};
  return report;
}

inline RatingForm madeUpForm(bool blank) {
  RatingForm form;
  form.checklist = &shippedChecklist();
  form.global = &shippedGlobal();
  if (blank) return form;
  form.trainee = "T<1>";
  form.trial = 3;
  form.simulated = true;
  form.marks = competence::marked(shippedChecklist(), madeUpFigure, {});
  return form;
}

}  // namespace palpa::report::test

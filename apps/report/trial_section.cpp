#include "apps/report/trial_section.h"

#include <string>

#include "apps/report/competence_section.h"
#include "apps/report/near_miss.h"
#include "apps/report/pictures.h"
#include "apps/report/score_table.h"
#include "apps/report/trial_chart.h"
#include "apps/report/verdict.h"

namespace palpa::report {

void writeTrialSection(Html& html, const TrialPage& page) {
  const assess::TrialAssessment& trial = page.assessment;
  const std::string id = "trial-" + std::to_string(trial.trial);
  const auto section = html.in("section", {{"class", "card trial"}, {"id", id}});
  {
    const auto heading = html.in("h2");
    html.text("Trial " + std::to_string(trial.trial));
    if (!trial.role.empty()) html.element("span", {{"class", "role"}}, trial.role);
  }
  writeVerdict(html, trial);
  writeCompetence(html, page);
  if (trial.by_path) {
    html.element("h3", "Score");
    writeScoreTable(html, trial);
  }
  html.element("h3", "Course of the trial");
  writeTrialChart(html, page);
  if (trial.by_path) writeNearMisses(html, trial);
  writePictures(html, page.pictures);
}

}  // namespace palpa::report

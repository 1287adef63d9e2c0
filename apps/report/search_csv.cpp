#include "anatomy/geometry/whole_file.h"
#include "apps/report/csv_field.h"
#include "apps/report/numbers.h"
#include "apps/report/search_report.h"
#include "apps/report/subtask_csv.h"

namespace palpa::report {
namespace {

std::string episodeFields(const assess::SearchTrial& t) {
  std::string row = ',' + std::to_string(t.trial) + ',' + std::to_string(t.seed) +
                    (t.simulated ? ",1" : ",0") + (t.force_feedback ? ",1," : ",0,") +
                    csvField(t.outcome) + ',' + csvField(t.block) + ',' + assess::name(t.mode);
  row += ',' + shortest(t.orientation_deg) + ',' + std::to_string(t.target) + ',' +
         std::to_string(t.chosen) + (assess::chose(t) && t.found() ? ",1" : ",0");
  for (const double value : {t.seconds, t.path_m, t.mean_force_N, t.peak_force_N, t.visited_s[0],
                             t.visited_s[1], t.visited_s[2]})
    row += ',' + shortest(value);
  return row;
}

}  // namespace

void writeSearchCsv(const std::string& user_id, const std::vector<assess::SearchTrial>& trials,
                    const std::filesystem::path& file) {
  const std::vector<assess::SubtaskDose> parts =
      trials.empty() ? std::vector<assess::SubtaskDose>{} : trials.front().doses;
  std::string csv =
      "USER_ID,TRIAL,SEED,SIMULATED,FF,OUTCOME,BLOCK,MODE,ORIENTATION_DEG,TARGET,CHOSEN,FOUND,TIME_"
      "S,PATH_M,MEAN_N,PEAK_N,VISIT_0_S,VISIT_1_S,VISIT_2_S" +
      subtaskColumns(parts) + '\n';
  for (const assess::SearchTrial& trial : trials)
    csv += csvField(user_id) + episodeFields(trial) + subtaskFields(parts, trial.doses) + '\n';
  writeWhole(file, csv);
}

}  // namespace palpa::report

#include <string>

#include "anatomy/geometry/whole_file.h"
#include "apps/report/numbers.h"
#include "apps/report/session_report.h"
#include "apps/report/subtask_csv.h"

namespace palpa::report {
namespace {

constexpr const char* kHeader =
    "USER_ID,FF,COL_LUNG,COL_RIB,COL_ART,COL_VEIN,PHASE_1,PHASE_2,ECON_MEAN,ECON_VAR,TIME,SUCCESS,"
    "TRIAL,SEED,SIMULATED,TOTAL,AUGMENTED";

/// RFC 4180: quoted only where needed, quotes doubled.
std::string field(const std::string& text) {
  if (text.find_first_of(",\"\r\n") == std::string::npos) return text;
  std::string quoted = "\"";
  for (const char c : text) quoted += c == '"' ? std::string("\"\"") : std::string(1, c);
  return quoted + '"';
}

std::string row(const std::string& user_id, const assess::TrialAssessment& trial) {
  const assess::ParacentesisValues& v = trial.values;
  std::string line = field(user_id) + (trial.force_feedback ? ",1" : ",0");
  for (const double value : {v.col_lung, v.col_rib, v.col_art, v.col_vein, v.phase_1, v.phase_2,
                             v.econ_mean, v.econ_var}) {
    line += ',' + (trial.by_path ? shortest(value) : "");
  }
  line += ',' + shortest(v.time_ms);
  line += v.success ? ",1," : ",0,";
  return line + std::to_string(trial.trial) + ',' + std::to_string(trial.seed) +
         (trial.simulated ? ",1," : ",0,") + (trial.by_path ? shortest(trial.total) : "") +
         (trial.augmented ? ",1" : ",0");
}

}  // namespace

void writeTrialsCsv(const std::string& user_id, const std::vector<assess::TrialAssessment>& trials,
                    const std::filesystem::path& file) {
  const std::vector<assess::SubtaskDose> parts =
      trials.empty() ? std::vector<assess::SubtaskDose>() : trials.front().doses;
  std::string csv = kHeader + subtaskColumns(parts) + '\n';
  for (const auto& trial : trials)
    csv += row(user_id, trial) + subtaskFields(parts, trial.doses) + '\n';
  writeWhole(file, csv);
}

}  // namespace palpa::report

#include <string>

#include "anatomy/geometry/whole_file.h"
#include "apps/report/csv_field.h"
#include "apps/report/numbers.h"
#include "apps/report/palpation_report.h"
#include "apps/report/subtask_csv.h"

namespace palpa::report {
namespace {

constexpr const char* kPalpationHeader =
    "USER_ID,TRIAL,SEED,SIMULATED,FF,OUTCOME,LUMPS,FOUND,MISSED,FALSE_ALARMS,REPEATED,CLEAR_"
    "QUADRANTS,WRONG_QUADRANTS,COVERAGE_LIGHT,COVERAGE_MEDIUM,COVERAGE_DEEP,TWICE,"
    "PATTERN,PATTERN_KEPT,PEAK_N,MEAN_N,TOO_LIGHT,TOO_HARD,CLOSER_FORCE,PRESSES,TIME_S,GUIDED,"
    "ERROR_MEAN_MM,SIZE_ERROR_MEAN_MM,AT_STANDARD,AUGMENTED";

std::string meanField(double sum, int count) { return count > 0 ? shortest(sum / count) : ""; }

/// ERROR_MEAN_MM and SIZE_ERROR_MEAN_MM.
std::string errorFields(const assess::PalpationAssessment& trial) {
  double error = 0, size = 0;
  int found = 0, graded = 0;
  for (const assess::LumpVerdict& verdict : trial.score.lumps) {
    if (verdict.mark < 0) continue;
    error += 1000 * verdict.error;
    ++found;
    if (!(trial.marks.at(static_cast<std::size_t>(verdict.mark)).diameter > 0)) continue;
    size += 1000 * verdict.size_error;
    ++graded;
  }
  return meanField(error, found) + ',' + meanField(size, graded);
}

std::string palpationRow(const std::string& user_id, const assess::PalpationAssessment& trial) {
  const assess::PalpationFacts& facts = trial.facts;
  const assess::PalpationScore& s = trial.score;
  std::string line = csvField(user_id) + ',' + std::to_string(facts.trial) + ',' +
                     std::to_string(facts.seed) + (facts.simulated ? ",1" : ",0") +
                     (facts.force_feedback ? ",1," : ",0,") + csvField(facts.outcome);
  for (const int count : {s.found + s.missed, s.found, s.missed, s.false_alarms, s.repeated,
                          s.clear_quadrants, s.wrong_quadrants})
    line += ',' + std::to_string(count);
  for (const double share : s.coverage) line += ',' + shortest(share);
  line += ',' + shortest(s.twice) + ',' + assess::nameOf(s.pattern.pattern);
  for (const double value : {s.pattern.kept, s.peak, s.mean, s.too_light, s.too_hard})
    line += ',' + shortest(value);
  line +=
      ',' + (s.closer_force > 0 ? shortest(s.closer_force) : "") + ',' + std::to_string(s.presses);
  return line + ',' + shortest(s.seconds) + ',' + shortest(facts.guided) + ',' +
         errorFields(trial) + (trial.passed ? ",1" : ",0") + (facts.augmented ? ",1" : ",0");
}

}  // namespace

void writePalpationCsv(const std::string& user_id,
                       const std::vector<assess::PalpationAssessment>& trials,
                       const std::filesystem::path& file) {
  const std::vector<assess::SubtaskDose> parts =
      trials.empty() ? std::vector<assess::SubtaskDose>() : trials.front().doses;
  std::string csv = kPalpationHeader + subtaskColumns(parts) + '\n';
  for (const auto& trial : trials)
    csv += palpationRow(user_id, trial) + subtaskFields(parts, trial.doses) + '\n';
  writeWhole(file, csv);
}

}  // namespace palpa::report

#include "anatomy/geometry/whole_file.h"
#include "apps/report/csv_field.h"
#include "apps/report/numbers.h"
#include "apps/report/squeeze_report.h"

namespace palpa::report {

void writeSqueezeCsv(const std::string& user_id, const std::vector<assess::SqueezeTrial>& trials,
                     const std::filesystem::path& file) {
  std::string csv =
      "USER_ID,TRIAL,SEED,SIMULATED,FF,OUTCOME,PROPERTY,FIRST,SECOND,SAID,RIGHT,PEAK_N,TIME_S,"
      "GRIPS_FIRST,GRIPS_SECOND\n";
  for (const assess::SqueezeTrial& t : trials) {
    csv += csvField(user_id) + ',' + std::to_string(t.trial) + ',' + std::to_string(t.seed) +
           (t.simulated ? ",1" : ",0") + (t.force_feedback ? ",1," : ",0,") + csvField(t.outcome);
    csv += t.property == assess::SqueezedProperty::stiffness ? ",stiffness," : ",weight,";
    csv += shortest(t.factors[0]) + ',' + shortest(t.factors[1]) + ',' + std::to_string(t.said) +
           (t.right() ? ",1," : ",0,") + shortest(t.peak_N) + ',' + shortest(t.seconds) + ',' +
           std::to_string(t.grips[0]) + ',' + std::to_string(t.grips[1]) + '\n';
  }
  writeWhole(file, csv);
}

}  // namespace palpa::report

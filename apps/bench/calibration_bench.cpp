#include "apps/bench/calibration_bench.h"

#include "apps/bench/estimator_studies.h"
#include "apps/bench/metric.h"
#include "apps/bench/study_figures.h"

namespace palpa::bench {

void benchCalibration(const CalibrationBenchOptions& options) {
  for (const EstimatorStudy& estimator : estimatorStudies())
    for (const double outliers : {0.0, 0.1}) {
      const StudyFigures figures = figuresOf(estimator, options.sets, outliers);
      const nlohmann::json params{{"estimator", estimator.name},
                                  {"sets", options.sets},
                                  {"outliers", outliers},
                                  {"data", "simulated"}};
      print("rmse_over_crlb", figures.ratio, "1", params);
      print("rmse_over_crlb_worst_parameter", figures.worst_ratio, "1", params);
      print("coverage95", figures.coverage, "1", params);
      print("refused", figures.refused, "sets", params);
    }
}

}  // namespace palpa::bench

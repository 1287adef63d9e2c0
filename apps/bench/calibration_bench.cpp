#include <algorithm>
#include <cmath>
#include <cstdio>
#include <vector>

#include "anatomy/base/error.h"
#include "apps/bench/bench.h"
#include "apps/bench/estimate_check.h"
#include "apps/bench/estimator_studies.h"
#include "apps/bench/timing.h"

namespace palpa::bench {

StudyFigures figuresOf(const EstimatorStudy& study, int sets, double outliers) {
  VectorX errors, bounds;
  double inside = 0, all = 0;
  StudyFigures figures;
  for (int seed = 1; seed <= sets; ++seed) {
    try {
      const EstimateCheck check = study.run(static_cast<std::uint64_t>(seed), outliers);
      if (errors.size() == 0) errors = bounds = VectorX::Zero(check.error.size());
      errors += check.error.cwiseAbs2();
      bounds += check.bound.cwiseAbs2();
      inside += (check.error.cwiseAbs().array() <= check.half95.array()).count();
      all += static_cast<double>(check.error.size());
    } catch (const Error& error) {
      std::fprintf(stderr, "%s, set %d: %s\n", study.name.c_str(), seed, error.what());
      ++figures.refused;
    }
  }
  std::vector<double> ratios;
  for (Eigen::Index k = 0; k < errors.size(); ++k)
    ratios.push_back(std::sqrt(errors[k] / bounds[k]));
  std::sort(ratios.begin(), ratios.end());
  if (ratios.empty()) return figures;
  const std::size_t n = ratios.size();
  figures.ratio = (ratios[n / 2] + ratios[(n - 1) / 2]) / 2;
  figures.worst_ratio = ratios.back();
  figures.coverage = inside / all;
  return figures;
}

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

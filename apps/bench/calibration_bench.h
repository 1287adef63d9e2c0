#pragma once

namespace palpa::bench {

struct CalibrationBenchOptions {
  int sets = 500;  ///< synthetic sets for each estimator
};

/// How near each estimator comes to what the data permit: rmse_over_crlb (root mean square error
/// over the Cramer-Rao bound; median over the parameters), coverage95 (share of truths inside the
/// stated 95 % intervals, all parameters), and the same with a tenth of gross errors. One JSON
/// object a line. Simulated data.
void benchCalibration(const CalibrationBenchOptions& options);

}  // namespace palpa::bench

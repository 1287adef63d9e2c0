#pragma once

#include <vector>

namespace palpa::statistics {

/// What an educator sets: failure rates and the chances of being wrong about them. No rates are
/// established for any of these procedures.
struct CusumRates {
  double acceptable = 0.10,
         unacceptable = 0.25;  ///< shares of failures, 0 < acceptable < unacceptable < 1
  double alpha = 0.1;          ///< chance to call an acceptable performance unacceptable
  double beta = 0.1;           ///< chance to call an unacceptable performance acceptable
};

/// The sequential probability ratio test as a sum: + (1 - s) for a failure, - s for a success. With
/// P = ln(p1/p0), Q = ln((1-p0)/(1-p1)):
///   s = Q / (P + Q)
///   h_accept = ln((1-alpha)/beta) / (P + Q)
///   h_reject = ln((1-beta)/alpha) / (P + Q)
/// Source: Wald 1947; Bolsin and Colson, Int. J. Qual. Health Care 12, 2000.
struct CusumLimits {
  double s = 0, h_accept = 0, h_reject = 0;
  /// fewest trials, all successes, after which the acceptable rate is accepted
  int shortest_clean_run = 0;
};

/// Throws Error for rates out of range or order.
CusumLimits cusumLimits(const CusumRates& rates);

enum class CusumVerdict { undecided, acceptable, unacceptable };

/// The sum after each trial. Once a limit is crossed the verdict is said and the test starts anew
/// at 0 with the next trial, as charts of continued practice do; `verdicts[i]`: at trial i.
struct Cusum {
  std::vector<double> sums;
  std::vector<CusumVerdict> verdicts;
  CusumVerdict last = CusumVerdict::undecided;  ///< the latest that was reached
};
Cusum cusum(const std::vector<bool>& failures, const CusumLimits& limits);

}  // namespace palpa::statistics

#pragma once

#include <vector>

namespace palpa::assess {

/// Welch's t-test for two independent samples of unequal variance:
///   t = (m_a - m_b) / sqrt(s_a^2/n_a + s_b^2/n_b),
///   degrees of freedom after Welch and Satterthwaite. Source: Welch, Biometrika 34, 1947.
struct WelchTest {
  double mean_a = 0, mean_b = 0;
  double t = 0, degrees = 0;
  double p_less = 1;        ///< one-tailed: a is smaller than b
  double p_two_sided = 1;
};

/// Throws Error when a sample has fewer than two values or both are constant.
WelchTest welch(const std::vector<double>& a, const std::vector<double>& b);

/// The same from published means, standard deviations and counts.
WelchTest welchFromMoments(double mean_a, double sd_a, double n_a, double mean_b, double sd_b, double n_b);

}  // namespace palpa::assess

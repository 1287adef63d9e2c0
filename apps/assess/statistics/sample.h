#pragma once

#include <cstddef>
#include <string>
#include <vector>

namespace palpa::statistics {

/// What tests of means need of a sample; may come from a publication.
struct Moments {
  double mean = 0, sd = 0;  ///< sd with n - 1
  double n = 0;
};

/// Throws Error, naming `where`, for fewer than two values or one that is not finite.
Moments momentsOf(const std::vector<double>& values, const std::string& where = "statistics");

double meanOf(const std::vector<double>& values);  ///< not a number for none

/// The share q of the values lies below: linear between the two nearest (type 7 of Hyndman and Fan
/// 1996). Not a number for none.
double quantileOf(std::vector<double> values, double q);

struct Description {
  std::size_t n = 0;
  double mean = 0, sd = 0;  ///< sd: not a number for fewer than two
  double median = 0, q1 = 0, q3 = 0, min = 0, max = 0;
};

/// All not a number but n for no value. Throws Error for a value that is not finite.
Description describe(const std::vector<double>& values);

/// Ranks from 1, equal values share the mean of theirs. `ties`: sum of t^3 - t over groups of t
/// equal values.
struct Ranks {
  std::vector<double> of;
  double ties = 0;
};
Ranks ranksOf(const std::vector<double>& values);

}  // namespace palpa::statistics

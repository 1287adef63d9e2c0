#pragma once

#include <optional>
#include <string>
#include <vector>

#include "apps/assess/progress/errors.h"
#include "apps/assess/statistics/bootstrap.h"
#include "apps/assess/statistics/cusum.h"
#include "apps/assess/statistics/raters.h"

/// What holds of several trainees. What is independent is the trainee: intervals are over trainees,
/// never over trials.
namespace palpa::progress {

/// A mean of the trainees' means, with its 95 % interval (bootstrap over trainees, BCa); the
/// interval is none for fewer than three.
struct GroupMean {
  double mean = 0;
  std::size_t trainees = 0;
  std::optional<std::pair<double, double>> interval;
};
GroupMean groupMean(const std::vector<double>& of_trainees);

struct CommonError {
  const ErrorKind* kind = nullptr;
  int trials = 0, with = 0;  ///< of all trainees together, as counts
  int trainees = 0, trainees_with = 0;
  GroupMean share;  ///< of each trainee's trials
};
/// Every kind of the engine that happened, the most common first.
std::vector<CommonError> commonErrors(const Series& group);

/// A figure of one trainee: the mean of the last five trials that have it, with a 95 % interval
/// (bootstrap over these trials; none for fewer than three).
struct TraineeFigure {
  std::string trainee;
  std::vector<double> values;  ///< of these trials
  double mean = 0;
  std::optional<std::pair<double, double>> interval;
};
std::vector<TraineeFigure> traineeFigures(const Series& group, const std::string& metric);

/// The trainees' curves over their trials and the group's mean at each trial that at least three,
/// and half of them, have done.
struct GroupCurve {
  std::vector<std::string> trainees;
  std::vector<std::vector<double>> curves;
  std::vector<GroupMean> mean;  ///< at trial 1, 2, ...
};
GroupCurve groupCurve(const Series& group, const std::string& metric);
/// Of several metrics at once, which costs little more than of one.
std::vector<GroupCurve> groupCurves(const Series& group, const std::vector<std::string>& metrics);

/// Somebody to look after, and why, in words.
struct Attention {
  std::string trainee;
  std::vector<std::string> reasons;
};
std::vector<Attention> whoNeedsAttention(const Series& group, const statistics::CusumRates& rates);

/// How far a metric tells trainees apart: ICC(3,k) over each one's last eight trials as cases. None
/// for fewer than eight cases or two trainees, and where they do not differ.
struct Reliability {
  std::size_t trainees = 0, cases = 0;
  statistics::Icc icc;
};
inline constexpr std::size_t kFewestCases = 8;
inline constexpr double kReliable = 0.7;  ///< below it nobody should pass or fail by such figures
std::optional<Reliability> reliabilityOf(const Series& group, const std::string& metric);

}  // namespace palpa::progress

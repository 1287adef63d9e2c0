#pragma once

#include <string>
#include <utility>

/// A metric and its values in words.
namespace palpa::report {

/// "Time", "Total penalty": a metric's title.
std::string titleOf(const std::string& metric);
/// "time", "total penalty": a metric's title within a sentence.
std::string titleWithin(const std::string& metric);
/// "21.5 s", "80 %", "340 points": a mean of a metric with its unit; a metric that is 1 or 0 is a
/// share.
std::string figureOf(const std::string& metric, double mean);
/// The factor and unit in which a metric is drawn: a metric that is 1 or 0 in per cent.
std::pair<double, std::string> scaleOf(const std::string& metric);

/// The figure of one trial for a table, without its unit: "21.5"; a metric that is 1 or 0: "yes",
/// "no".
std::string fieldOf(const std::string& metric, double value);

}  // namespace palpa::report

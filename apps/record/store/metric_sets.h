#pragma once

#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "apps/record/store/sql_connection.h"

/// How the store keeps the metrics of a trial: their values as one text beside the trial, their
/// names once for all trials that have the same.
namespace palpa::record {

struct Metric {
  std::string name;  ///< as in the table of metrics
  double value = 0;  ///< not a number: does not apply to this trial
};

/// In the order of their names; all empty for none.
struct PackedMetrics {
  std::string set;    ///< SHA-256 of the names
  std::string names;  ///< "col_lung,success,time_s"
  /// "0,1,,20.5": as few digits as give the number back to the last bit; nothing where it does not
  /// apply
  std::string values;
};
/// Throws Error for a name that stands there twice or holds a comma.
PackedMetrics packed(std::vector<Metric> metrics);

/// Within a transaction: keeps the names of this set, where they are not there yet.
void keepSet(SqlConnection& connection, const PackedMetrics& metrics);

/// The names of all sets that a store has, read once.
class MetricSets {
 public:
  explicit MetricSets(SqlConnection& connection);
  /// Throws Error for a set that is not there.
  const std::vector<std::string>& names(std::string_view set) const;
  /// The metrics of a trial; what is in `metrics` already of the same set keeps its names, so that
  /// of a thousand trials after the other only the values are written. Throws Error where values
  /// and names do not fit.
  void unpack(std::string_view set, std::string_view values, std::vector<Metric>& metrics);

 private:
  using Names = std::vector<std::string>;
  [[noreturn]] void failDamaged() const;
  std::map<std::string, Names, std::less<>> sets_;
  const Names* last_ = nullptr;  ///< those of the trial before
  std::string place_;
};

/// Values of chosen metrics, trial after trial: where they stand is looked up once for all trials
/// that have the same names.
class MetricColumns {
 public:
  explicit MetricColumns(std::vector<std::string> chosen);
  /// In the order of the chosen; not a number for what is not there. Valid until the next call.
  const std::vector<double>& of(const std::vector<Metric>& metrics);

 private:
  const std::vector<std::string> chosen_;
  std::vector<std::string> names_;  ///< of the trial before
  std::vector<std::size_t> at_;     ///< of each chosen one among them
  std::vector<double> values_;
};

/// Of the older tables, where each metric had a row of its own: brings all into their trials.
void packMetricRows(SqlConnection& connection);

}  // namespace palpa::record

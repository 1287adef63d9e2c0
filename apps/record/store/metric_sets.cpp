#include "apps/record/store/metric_sets.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <limits>
#include <system_error>

#include "anatomy/base/sha256.h"

namespace palpa::record {
namespace {

std::string shortest(double value) {
  if (std::isnan(value)) return "";
  char text[32];
  return {text, std::to_chars(text, text + sizeof text, value).ptr};
}

/// Of a list with commas the first entry, which is taken from it; false: there is none.
bool takeEntry(std::string_view& list, std::string_view& entry, bool& more) {
  if (!more) return false;
  const std::size_t comma = list.find(',');
  entry = list.substr(0, comma);
  more = comma != std::string_view::npos;
  if (more) list.remove_prefix(comma + 1);
  return true;
}

std::vector<std::string> entriesIn(std::string_view list) {
  std::vector<std::string> all;
  bool more = !list.empty();
  for (std::string_view entry; takeEntry(list, entry, more);) all.emplace_back(entry);
  return all;
}

}  // namespace

PackedMetrics packed(std::vector<Metric> metrics) {
  PackedMetrics all;
  if (metrics.empty()) return all;
  std::sort(metrics.begin(), metrics.end(),
            [](const Metric& a, const Metric& b) { return a.name < b.name; });
  for (std::size_t i = 0; i < metrics.size(); ++i) {
    const std::string& name = metrics[i].name;
    if (name.empty() || name.find(',') != std::string::npos ||
        (i > 0 && name == metrics[i - 1].name))
      throw Error("is there twice, or is no name of a metric", "metric \"" + name + "\"",
                  "Report this");
    all.names += (i > 0 ? "," : "") + name;
    all.values += (i > 0 ? "," : "") + shortest(metrics[i].value);
  }
  all.set = sha256(all.names);
  return all;
}

void keepSet(SqlConnection& connection, const PackedMetrics& metrics) {
  if (metrics.set.empty()) return;
  connection.query(
      "INSERT INTO metric_sets(digest,names) VALUES($1,$2) ON CONFLICT(digest) DO NOTHING",
      {metrics.set, metrics.names});
}

MetricSets::MetricSets(SqlConnection& connection) : place_(connection.place()) {
  const SqlRows rows = connection.query("SELECT digest,names FROM metric_sets");
  for (std::size_t i = 0; i < rows.size(); ++i) sets_[rows.text(i, 0)] = entriesIn(rows.text(i, 1));
  sets_[""] = {};
}

void MetricSets::failDamaged() const {
  throw Error("is damaged (figures of a trial do not fit their names)", place_,
              "Restore a backup: palpa records restore");
}

const std::vector<std::string>& MetricSets::names(std::string_view set) const {
  const auto found = sets_.find(set);
  if (found == sets_.end()) failDamaged();
  return found->second;
}

void MetricSets::unpack(std::string_view set, std::string_view values,
                        std::vector<Metric>& metrics) {
  const Names& known = names(set);
  if (last_ != &known || metrics.size() != known.size()) {
    metrics.clear();
    for (const std::string& name : known) metrics.push_back({name, 0});
    last_ = &known;
  }
  bool more = !known.empty();
  std::string_view text;
  for (Metric& metric : metrics) {
    if (!takeEntry(values, text, more)) failDamaged();
    metric.value = std::numeric_limits<double>::quiet_NaN();
    if (text.empty()) continue;
    const auto [end, problem] = std::from_chars(text.begin(), text.end(), metric.value);
    if (problem != std::errc() || end != text.end()) failDamaged();
  }
  if (more) failDamaged();
}

MetricColumns::MetricColumns(std::vector<std::string> chosen)
    : chosen_(std::move(chosen)), at_(chosen_.size(), 0), values_(chosen_.size()) {}

const std::vector<double>& MetricColumns::of(const std::vector<Metric>& metrics) {
  const bool same =
      std::equal(metrics.begin(), metrics.end(), names_.begin(), names_.end(),
                 [](const Metric& m, const std::string& name) { return m.name == name; });
  if (!same) {
    names_.clear();
    for (const Metric& m : metrics) names_.push_back(m.name);
    for (std::size_t c = 0; c < chosen_.size(); ++c)
      at_[c] = static_cast<std::size_t>(std::find(names_.begin(), names_.end(), chosen_[c]) -
                                        names_.begin());
  }
  for (std::size_t c = 0; c < chosen_.size(); ++c)
    values_[c] =
        at_[c] < metrics.size() ? metrics[at_[c]].value : std::numeric_limits<double>::quiet_NaN();
  return values_;
}

void packMetricRows(SqlConnection& connection) {
  std::string session;
  std::int64_t number = 0;
  std::vector<Metric> metrics;
  std::string known;
  const auto write = [&] {
    if (metrics.empty()) return;
    const PackedMetrics all = packed(std::move(metrics));
    metrics.clear();
    if (all.set != known) keepSet(connection, all);
    known = all.set;
    connection.query(
        "UPDATE trials SET metric_set=$1,metric_values=$2 WHERE session=$3 AND number=$4",
        {all.set, all.values, session, number});
  };
  const auto rows = connection.cursor(
      "SELECT session,number,name,value FROM metrics ORDER BY session,number,name");
  while (rows->next()) {
    if (rows->text(0) != session || rows->integer(1) != number) {
      write();
      session = rows->text(0);
      number = rows->integer(1);
    }
    metrics.push_back({std::string(rows->text(2)), rows->real(3)});
  }
  write();
}

}  // namespace palpa::record

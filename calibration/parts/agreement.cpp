#include "calibration/parts/agreement.h"

#include <algorithm>
#include <limits>
#include <string>

#include "anatomy/base/error.h"

namespace palpa::calibration {
namespace {

constexpr char kAgreementWhere[] = "agreement of two labelings";

void requireLabels(const std::vector<int>& one, const std::vector<int>& other) {
  if (one.empty()) throw Error("there are no steps", kAgreementWhere, "Label at least one");
  if (one.size() != other.size())
    throw Error(std::to_string(one.size()) + " steps and " + std::to_string(other.size()) +
                    " are not the same",
                kAgreementWhere, "Label the same steps in both");
}

std::vector<int> labelsIn(std::vector<int> labels) {
  std::sort(labels.begin(), labels.end());
  labels.erase(std::unique(labels.begin(), labels.end()), labels.end());
  return labels;
}

Eigen::Index placeOf(int label, const std::vector<int>& labels) {
  return std::lower_bound(labels.begin(), labels.end(), label) - labels.begin();
}

/// The Hungarian method with potentials, a row at a time along the cheapest path that alternates;
/// O(n^3).
class Assignment {
 public:
  explicit Assignment(const Eigen::MatrixXd& cost)
      : cost_(cost),
        n_(static_cast<std::size_t>(cost.rows())),
        row_potential_(n_, 0),
        column_potential_(n_, 0),
        row_of_(n_, kNobody) {}
  /// By column, the row.
  std::vector<std::size_t> run() {
    for (std::size_t row = 0; row < n_; ++row) place(row);
    return row_of_;
  }

 private:
  static constexpr std::size_t kNobody = std::numeric_limits<std::size_t>::max();

  double reduced(std::size_t row, std::size_t column) const {
    return cost_(static_cast<Eigen::Index>(row), static_cast<Eigen::Index>(column)) -
           row_potential_[row] - column_potential_[column];
  }

  void place(std::size_t newcomer) {
    std::vector<double> way(
        n_, std::numeric_limits<double>::infinity());  // cheapest so far to a column
    std::vector<std::size_t> before(n_, kNobody);      // the column before it on that path
    std::vector<bool> reached(n_, false);
    std::size_t row = newcomer, last = kNobody;
    while (true) {
      std::size_t next = kNobody;
      for (std::size_t c = 0; c < n_; ++c) {
        if (reached[c]) continue;
        if (reduced(row, c) < way[c]) {
          way[c] = reduced(row, c);
          before[c] = last;
        }
        if (next == kNobody || way[c] < way[next]) next = c;
      }
      shift(newcomer, way[next], reached, &way);
      reached[next] = true;
      last = next;
      if (row_of_[next] == kNobody) break;
      row = row_of_[next];
    }
    for (; before[last] != kNobody; last = before[last]) row_of_[last] = row_of_[before[last]];
    row_of_[last] = newcomer;
  }

  /// Potentials by which the next column costs nothing.
  void shift(std::size_t newcomer, double by, const std::vector<bool>& reached,
             std::vector<double>* way) {
    row_potential_[newcomer] += by;
    for (std::size_t c = 0; c < n_; ++c) {
      if (reached[c]) {
        row_potential_[row_of_[c]] += by;
        column_potential_[c] -= by;
      } else {
        (*way)[c] -= by;
      }
    }
  }

  const Eigen::MatrixXd& cost_;
  std::size_t n_;
  std::vector<double> row_potential_, column_potential_;
  std::vector<std::size_t> row_of_;
};

double pairsOf(double n) { return n * (n - 1) / 2; }

}  // namespace

Contingency contingencyOf(const std::vector<int>& one, const std::vector<int>& other) {
  requireLabels(one, other);
  Contingency table{labelsIn(one), labelsIn(other), {}};
  table.counts = Eigen::MatrixXi::Zero(static_cast<Eigen::Index>(table.one.size()),
                                       static_cast<Eigen::Index>(table.other.size()));
  for (std::size_t i = 0; i < one.size(); ++i)
    ++table.counts(placeOf(one[i], table.one), placeOf(other[i], table.other));
  return table;
}

std::vector<int> bestMatching(const Contingency& table) {
  const Eigen::Index rows = table.counts.rows(), columns = table.counts.cols(),
                     n = std::max(rows, columns);
  Eigen::MatrixXd cost = Eigen::MatrixXd::Zero(n, n);  // padded by labels that nobody has
  const Eigen::MatrixXd counts = table.counts.cast<double>();
  const Eigen::VectorXd of_row = counts.rowwise().sum() / counts.sum(),
                        of_column = counts.colwise().sum().transpose() / counts.sum();
  // Chance sums to 1 at most: half of it never outweighs a step.
  cost.topLeftCorner(rows, columns) = 0.5 * of_row * of_column.transpose() - counts;
  const std::vector<std::size_t> row_of = Assignment(cost).run();
  std::vector<int> matching(static_cast<std::size_t>(rows), -1);
  for (std::size_t c = 0; c < static_cast<std::size_t>(columns); ++c)
    if (row_of[c] < matching.size()) matching[row_of[c]] = static_cast<int>(c);
  return matching;
}

double cohensKappa(const Contingency& table) {
  if (table.counts.size() == 1) return 1;
  const std::vector<int> matching = bestMatching(table);
  const Eigen::MatrixXd share =
      table.counts.cast<double>() / static_cast<double>(table.counts.sum());
  double observed = 0, by_chance = 0;
  for (std::size_t i = 0; i < matching.size(); ++i) {
    if (matching[i] < 0) continue;
    const auto row = static_cast<Eigen::Index>(i);
    observed += share(row, matching[i]);
    by_chance += share.row(row).sum() * share.col(matching[i]).sum();
  }
  return (observed - by_chance) / (1 - by_chance);
}

double kappaByName(const Eigen::MatrixXi& counts) {
  if (counts.rows() != counts.cols() || counts.sum() == 0)
    throw Error("the table is not square or empty", kAgreementWhere,
                "Count the same labels in both, at least one step");
  const Eigen::MatrixXd share = counts.cast<double>() / static_cast<double>(counts.sum());
  const double observed = share.trace(),
               by_chance = share.rowwise().sum().dot(share.colwise().sum().transpose());
  return by_chance < 1 ? (observed - by_chance) / (1 - by_chance) : 1;
}

double adjustedRandIndex(const Contingency& table) {
  const Eigen::MatrixXd n = table.counts.cast<double>();
  const double together = n.unaryExpr(&pairsOf).sum();
  const double one = n.rowwise().sum().unaryExpr(&pairsOf).sum(),
               other = n.colwise().sum().unaryExpr(&pairsOf).sum();
  const double all = pairsOf(n.sum()), most = (one + other) / 2,
               by_chance = all > 0 ? one * other / all : 0;
  if (one == other && (one == 0 || one == all)) return 1;
  return (together - by_chance) / (most - by_chance);
}

std::vector<int> boundariesOf(const std::vector<int>& labels) {
  std::vector<int> boundaries;
  for (std::size_t i = 1; i < labels.size(); ++i)
    if (labels[i] != labels[i - 1]) boundaries.push_back(static_cast<int>(i));
  return boundaries;
}

double BoundaryAgreement::precision() const {
  return found > 0 ? static_cast<double>(met) / found : 1;
}

double BoundaryAgreement::recall() const {
  return expected > 0 ? static_cast<double>(met) / expected : 1;
}

double BoundaryAgreement::f() const {
  const double both = precision() + recall();
  return both > 0 ? 2 * precision() * recall() / both : 0;
}

BoundaryAgreement& BoundaryAgreement::operator+=(const BoundaryAgreement& more) {
  met += more.met;
  found += more.found;
  expected += more.expected;
  return *this;
}

BoundaryAgreement boundaryAgreement(const std::vector<int>& found, const std::vector<int>& expected,
                                    int tolerance) {
  requireLabels(found, expected);
  if (tolerance < 0)
    throw Error("the tolerance is negative", kAgreementWhere, "Give steps, 0 or more");
  const std::vector<int> ours = boundariesOf(found), theirs = boundariesOf(expected);
  BoundaryAgreement agreement{0, static_cast<int>(ours.size()), static_cast<int>(theirs.size())};
  // In order, each with the first that is free: on a line that pairs as many as can be.
  for (auto a = ours.begin(), b = theirs.begin(); a != ours.end() && b != theirs.end();) {
    const int ahead = *a - *b;
    if (ahead >= -tolerance && ahead <= tolerance) {
      ++agreement.met;
      ++a;
      ++b;
    } else if (ahead < 0) {
      ++a;
    } else {
      ++b;
    }
  }
  return agreement;
}

}  // namespace palpa::calibration

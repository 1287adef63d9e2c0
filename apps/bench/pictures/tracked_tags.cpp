#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <numbers>

#include "apps/bench/pictures/tracking_fit.h"

/// Which tags of a board are found, by their width in the picture.
namespace palpa::bench {
namespace {

double normalShare(double x) { return 0.5 * std::erfc(-x / std::numbers::sqrt2); }

}  // namespace

/// By Fisher's scoring.
TagWidths fitTagWidths(const std::vector<TagChance>& tags) {
  if (std::all_of(tags.begin(), tags.end(), [](const TagChance& tag) { return tag.found; }))
    return {};
  constexpr double kSurelyFound = 25;  // px
  double a = -15 / 1.5, b = 1 / 1.5;   // found: a + b width > a normal variate
  for (int iteration = 0; iteration < 30; ++iteration) {
    Eigen::Matrix2d information = 1e-9 * Eigen::Matrix2d::Identity();
    Eigen::Vector2d score = Eigen::Vector2d::Zero();
    for (const TagChance& tag : tags) {
      if (tag.width > kSurelyFound) continue;
      const double x = a + b * tag.width;
      const double share = std::clamp(normalShare(x), 1e-9, 1 - 1e-9),
                   density = std::exp(-x * x / 2) / std::sqrt(2 * std::numbers::pi),
                   weight = density / (share * (1 - share));
      const Eigen::Vector2d by(1, tag.width);
      score += weight * ((tag.found ? 1 : 0) - share) * by;
      information += weight * density * by * by.transpose();
    }
    const Eigen::Vector2d step = information.ldlt().solve(score);
    a += step[0];
    b += step[1];
  }
  return b > 1e-3 ? TagWidths{-a / b, 1 / b} : TagWidths{};
}

double leastWidthOf(const std::vector<TagChance>& tags, double spread, double otherwise) {
  double found = 0;
  for (const TagChance& tag : tags) found += tag.found;
  if (found == 0 || found == double(tags.size())) return otherwise;
  double low = 0, high = 100;
  for (int i = 0; i < 40; ++i) {
    const double middle = (low + high) / 2;
    double expected = 0;
    for (const TagChance& tag : tags) expected += normalShare((tag.width - middle) / spread);
    (expected > found ? low : high) = middle;
  }
  return low;
}

namespace {

/// Two pictures of the same pose disagree so often about a tag at x where this share of the
/// variance is common to them.
double disagreementAt(double x, double lasting) {
  double sum = 0, weights = 0;
  for (double phi = -4; phi <= 4; phi += 0.25) {
    const double weight = std::exp(-phi * phi / 2),
                 share = normalShare((x - std::sqrt(lasting) * phi) / std::sqrt(1 - lasting));
    sum += weight * 2 * share * (1 - share);
    weights += weight;
  }
  return sum / weights;
}

}  // namespace

double lastingShareOf(const std::vector<std::array<TagChance, 2>>& tags, const TagWidths& widths) {
  constexpr double kInDoubt = 3;  // standard deviations
  std::vector<double> at;
  double differ = 0;
  for (const auto& [first, again] : tags) {
    const double x = (first.width - widths.least) / widths.spread;
    if (std::abs(x) > kInDoubt) continue;
    at.push_back(x);
    differ += first.found != again.found;
  }
  if (at.empty()) return 0;
  double low = 0, high = 0.99;
  for (int i = 0; i < 12; ++i) {
    const double middle = (low + high) / 2;
    double expected = 0;
    for (const double x : at) expected += disagreementAt(x, middle);
    (expected > differ ? low : high) = middle;
  }
  return low;
}

}  // namespace palpa::bench

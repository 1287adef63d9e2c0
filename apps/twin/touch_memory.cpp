#include "apps/twin/touch_memory.h"

#include <algorithm>
#include <cmath>

namespace palpa::twin {
namespace {

constexpr std::size_t kCompared = 12, kFewest = 8;   // presses
constexpr double kBeside = 0.004, kAbout = 0.006, kOneLump = 0.015;   // m

double medianOf(std::vector<double> values) {
  std::nth_element(values.begin(), values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2), values.end());
  return values[values.size() / 2];
}

}  // namespace

double across(const Vec3& a, const Vec3& b) { return (a - b).head<2>().norm(); }

/// A hand compares side by side.
std::vector<double> TouchMemory::ordinaryAbout(const Vec3& p_P, std::size_t pressure) const {
  std::vector<std::pair<double, double>> near;
  for (const FeltPress& press : presses_)
    if (!press.firm && press.depths.size() > pressure && across(press.p_P, p_P) > kBeside) near.emplace_back(across(press.p_P, p_P), press.depths[pressure]);
  std::sort(near.begin(), near.end());
  std::vector<double> depths;
  for (std::size_t i = 0; i < std::min(near.size(), kCompared); ++i) depths.push_back(near[i].second);
  return depths;
}

double TouchMemory::firmness(const FeltPress& press) const {
  double sum = 0;
  int count = 0;
  for (std::size_t l = first_told_; l < press.depths.size(); ++l) {
    const std::vector<double> around = ordinaryAbout(press.p_P, l);
    if (around.size() < kFewest) continue;
    sum += std::log(medianOf(around) / std::max(press.depths[l], 1e-4));
    ++count;
  }
  return count > 0 ? sum / count : 0;
}

double TouchMemory::meanFirmness(const std::vector<FeltPress>& presses) const {
  double sum = 0;
  for (const FeltPress& press : presses) sum += firmness(press) / static_cast<double>(presses.size());
  return sum;
}

std::optional<Vec3> TouchMemory::uphill(const std::vector<FeltPress>& presses, const Vec3& centre) const {
  constexpr std::size_t kCrossOf = 5;
  constexpr double kOnTop = 2.4e-3, kFarthest = 8e-3;   // m
  if (presses.size() < kCrossOf) return std::nullopt;
  const std::vector<FeltPress> last(presses.end() - kCrossOf, presses.end());
  double least = 1e9, weight = 0;
  for (const FeltPress& press : last) least = std::min(least, firmness(press));
  Vec3 shift = Vec3::Zero();
  for (const FeltPress& press : last) {
    const double w = std::pow(firmness(press) - least, 2);
    shift += w * (press.p_P - centre);
    weight += w;
  }
  shift.z() = 0;
  if (weight > 0) shift *= 2 / weight;
  if (shift.norm() < kOnTop) return std::nullopt;
  return centre + shift * std::min(1.0, kFarthest / shift.norm());
}

Vec3 TouchMemory::firmestPlace(const std::vector<FeltPress>& presses, const Vec3& centre) const {
  Vec3 middle = Vec3::Zero();
  double weight = 0;
  for (const FeltPress& press : presses) {
    if (across(press.p_P, centre) > kAbout) continue;
    const double w = std::pow(std::max(firmness(press), 0.0), 2);
    middle += w * press.p_P;
    weight += w;
  }
  return weight > 0 ? Vec3(middle / weight) : centre;
}

double TouchMemory::spreadAbout(const Vec3& centre, const std::vector<FeltPress>& more) const {
  double sum = 0, weight = 0;
  const auto add = [&](const FeltPress& press) {
    const double r = across(press.p_P, centre), w = std::max(firmness(press), 0.0);
    if (r > kOneLump) return;
    sum += w * r * r;
    weight += w;
  };
  std::for_each(presses_.begin(), presses_.end(), add);
  std::for_each(more.begin(), more.end(), add);
  return weight > 0 ? std::sqrt(sum / weight) : kBeside;
}

}  // namespace palpa::twin

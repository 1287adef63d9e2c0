#include "apps/twin/touch_memory.h"

#include <algorithm>
#include <cmath>

#include "anatomy/base/quantile.h"

namespace palpa::twin {
namespace {

constexpr std::size_t kCompared = 12, kFewest = 6;                   // presses
constexpr double kBeside = 0.004, kOneLump = 0.015, kAlike = 0.007;  // m

}  // namespace

double across(const Vec3& a, const Vec3& b) { return (a - b).head<2>().norm(); }

/// A hand compares side by side.
std::vector<double> TouchMemory::ordinaryAbout(const FeltPress& press, std::size_t pressure) const {
  std::vector<std::pair<double, double>> near;
  for (const FeltPress& other : presses_) {
    const bool comparable = !other.firm && other.depths.size() > pressure &&
                            std::abs(other.from_normal - press.from_normal) < kAlike;
    if (const double apart = across(other.p_P, press.p_P); comparable && apart > kBeside)
      near.emplace_back(apart, other.depths[pressure]);
  }
  std::sort(near.begin(), near.end());
  std::vector<double> depths;
  for (std::size_t i = 0; i < std::min(near.size(), kCompared); ++i)
    depths.push_back(near[i].second);
  return depths;
}

double TouchMemory::firmness(const FeltPress& press) const {
  double sum = 0, weights = 0;
  for (std::size_t l = first_reported_; l < press.depths.size(); ++l) {
    const std::vector<double> around = ordinaryAbout(press, l);
    if (around.size() < kFewest) continue;
    const double ordinary = upperMedian(around);
    sum += ordinary * std::log(ordinary / std::max(press.depths[l], 1e-4));
    weights += ordinary;
  }
  return weights > 0 ? sum / weights : 0;
}

double TouchMemory::meanFirmness(const std::vector<FeltPress>& presses) const {
  double sum = 0;
  for (const FeltPress& press : presses)
    sum += firmness(press) / static_cast<double>(presses.size());
  return sum;
}

TouchMemory::Hill TouchMemory::hillAbout(const std::vector<FeltPress>& presses,
                                         const Vec3& centre) const {
  constexpr double kWide = 8.5e-3, kFelt = 0.016, kStep = 1e-3;  // m
  constexpr int kFarthest = 10;                                  // steps
  std::vector<std::pair<Vec3, double>> felt;
  for (const std::vector<FeltPress>* some : {&presses_, &presses})
    for (const FeltPress& press : *some)
      if (across(press.p_P, centre) < kFelt) felt.emplace_back(press.p_P, firmness(press));
  Hill hill{centre, 0};
  for (int i = -kFarthest; i <= kFarthest; ++i) {
    for (int j = -kFarthest; j <= kFarthest; ++j) {
      const Vec3 at = centre + kStep * Vec3(i, j, 0);
      double along = 0, square = 0;
      for (const auto& [p, firm] : felt) {
        const double height = std::exp(-std::pow(across(p, at) / kWide, 2) / 2);
        along += height * firm;
        square += height * height;
      }
      const double explained = along > 0 ? along * along / square : 0;
      if (explained > hill.explained) hill = {at, explained};
    }
  }
  return hill;
}

const FeltPress* TouchMemory::firmestAbout(const Vec3& centre, double reach) const {
  const FeltPress* firmest = nullptr;
  for (const FeltPress& press : presses_)
    if (across(press.p_P, centre) < reach && (!firmest || firmness(press) > firmness(*firmest)))
      firmest = &press;
  return firmest;
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

#include "apps/assess/palpation/search_pattern.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <numbers>

#include "anatomy/base/pinned_math.h"

namespace palpa::assess {
namespace {

constexpr double kSamePress_s = 0.1, kNear_s = 5, kNear = 5e-3;  // s, s, m
constexpr int kCloserLook = 2;

void add(Press* press, const PalpationSample& sample, const PalpationSample* before,
         double* weight) {
  press->to_s = sample.t_s;
  press->peak = std::max(press->peak, sample.f_n);
  press->p_P += sample.f_n * sample.p_P;
  *weight += sample.f_n;
  if (before) press->slid += (sample.p_P - before->p_P).head<2>().norm();
}

}  // namespace

std::vector<PalpationSample> ofTool(PalpationSamples samples, int tool) {
  std::vector<PalpationSample> its;
  std::copy_if(samples.begin(), samples.end(), std::back_inserter(its),
               [tool](const PalpationSample& sample) { return sample.tool == tool; });
  return its;
}

std::vector<Press> pressesIn(PalpationSamples samples, double touch) {
  std::vector<Press> presses;
  std::vector<double> weights;
  const PalpationSample* before = nullptr;
  for (const PalpationSample& sample : samples) {
    if (sample.f_n < touch) continue;
    const bool goes_on = !presses.empty() && sample.t_s - presses.back().to_s <= kSamePress_s;
    if (!goes_on) {
      presses.push_back({sample.t_s, sample.t_s, Vec3::Zero(), 0, 0, false});
      weights.push_back(0);
      before = nullptr;
    }
    add(&presses.back(), sample, before, &weights.back());
    before = &sample;
  }
  for (std::size_t i = 0; i < presses.size(); ++i) presses[i].p_P /= weights[i];
  for (std::size_t i = 0; i < presses.size(); ++i) {
    int near = 0;
    for (std::size_t j = 0; j < presses.size(); ++j) {
      const double apart_s =
          std::max(presses[j].from_s - presses[i].to_s, presses[i].from_s - presses[j].to_s);
      near +=
          j != i && apart_s < kNear_s && (presses[j].p_P - presses[i].p_P).head<2>().norm() < kNear;
    }
    presses[i].palpating = near >= kCloserLook;
  }
  return presses;
}

namespace {

constexpr std::size_t kFewestPlaces = 8;
constexpr double kAlongShare = 0.6;  // of the way that a strip goes along itself
constexpr double kOnward =
    0.7;  // share of the moves across that go the one way; of turning and of growing, net over all
constexpr double kMoves = 2e-3;  // m: smaller ones are trembling
constexpr double kWide = 0.6;    // of the area's width
constexpr double kTurns = 2;     // of a spiral

/// How well strips along `axis` were kept; 0: they were not.
double strips(const std::vector<Vec3>& places, int axis, double width) {
  const int across = 1 - axis;
  double along_way = 0, across_way = 0, least = places.front()[across], most = least;
  int up = 0, down = 0;
  for (std::size_t i = 1; i < places.size(); ++i) {
    const double move = places[i][across] - places[i - 1][across];
    along_way += std::abs(places[i][axis] - places[i - 1][axis]);
    across_way += std::abs(move);
    up += move > kMoves;
    down += move < -kMoves;
    least = std::min(least, places[i][across]);
    most = std::max(most, places[i][across]);
  }
  const double share = along_way / std::max(along_way + across_way, 1e-9),
               onward = static_cast<double>(std::max(up, down)) / std::max(up + down, 1);
  return share >= kAlongShare && onward >= kOnward && most - least >= kWide * width ? onward : 0;
}

double spiral(const std::vector<Vec3>& places, double width) {
  Vec3 middle = Vec3::Zero();
  for (const Vec3& p : places) middle += p / static_cast<double>(places.size());
  double turned = 0, turning = 0, outward = 0, radial = 0;
  for (std::size_t i = 1; i < places.size(); ++i) {
    const Vec3 a = places[i - 1] - middle, b = places[i] - middle;
    const double angle =
        pinned::atan2(a.x() * b.y() - a.y() * b.x(), a.x() * b.x() + a.y() * b.y());
    turned += angle;
    turning += std::abs(angle);
    outward += b.head<2>().norm() - a.head<2>().norm();
    radial += std::abs(b.head<2>().norm() - a.head<2>().norm());
  }
  const bool round =
      std::abs(turned) >= kTurns * 2 * std::numbers::pi && std::abs(turned) >= kOnward * turning;
  return round && std::abs(outward) >= kOnward * radial &&
                 std::abs(outward) >= 0.5 * kWide * width / 2
             ? std::abs(turned) / turning
             : 0;
}

}  // namespace

const char* nameOf(SearchPattern pattern) {
  switch (pattern) {
    case SearchPattern::strips:
      return "vertical strips";
    case SearchPattern::rows:
      return "rows";
    case SearchPattern::spiral:
      return "spiral";
    default:
      return "no pattern";
  }
}

SearchedPattern patternOf(const std::vector<Press>& presses, const SearchArea& area) {
  std::vector<Vec3> places;
  for (const Press& press : presses)
    if (!press.palpating) places.push_back(press.p_P);
  if (places.size() < kFewestPlaces) return {};
  SearchedPattern best;
  for (const auto& [pattern, kept] :
       {std::pair(SearchPattern::strips, strips(places, 1, 2 * area.half_x)),
        std::pair(SearchPattern::rows, strips(places, 0, 2 * area.half_y)),
        std::pair(SearchPattern::spiral, spiral(places, 2 * std::min(area.half_x, area.half_y)))}) {
    if (kept > best.kept) best = {pattern, kept};
  }
  return best;
}

}  // namespace palpa::assess

#include <algorithm>
#include <limits>

#include "anatomy/random_stream.h"
#include "apps/assess/search/search_trial.h"

namespace palpa::assess {
namespace {

constexpr int kResamples = 10'000;
constexpr std::size_t kBeyond = kResamples / 40;  // 2.5 % of the resamples lie beyond either end
constexpr double kNoEnd = std::numeric_limits<double>::infinity();

struct FoundOf {
  int found = 0, of = 0;
  double share() const { return static_cast<double>(found) / of; }
};

FoundOf foundIn(const std::vector<SearchTrial>& trials, SearchMode mode) {
  FoundOf sum;
  for (const SearchTrial& trial : trials) {
    if (!counts(trial) || trial.mode != mode) continue;
    ++sum.of;
    sum.found += chose(trial) && trial.found();
  }
  return sum;
}

double resampledShare(const FoundOf& seen, anatomy::RandomStream& random) {
  const double likely = (seen.found + 0.5) / (seen.of + 1);
  FoundOf drawn{0, seen.of};
  for (int i = 0; i < seen.of; ++i) drawn.found += random.uniform() < likely;
  return drawn.share();
}

}  // namespace

std::optional<Recovery> recoveryOf(const std::vector<SearchTrial>& trials, std::uint64_t seed) {
  const FoundOf real = foundIn(trials, SearchMode::real),
                degraded = foundIn(trials, SearchMode::degraded),
                augmented = foundIn(trials, SearchMode::augmented);
  if (real.of == 0 || degraded.of == 0 || augmented.of == 0 || !(real.share() > degraded.share()))
    return std::nullopt;
  Recovery recovery{(augmented.share() - degraded.share()) / (real.share() - degraded.share()),
                    -kNoEnd, kNoEnd};
  anatomy::RandomStream random(seed);
  std::vector<double> shares;
  for (int i = 0; i < kResamples; ++i) {
    const double r = resampledShare(real, random), d = resampledShare(degraded, random),
                 a = resampledShare(augmented, random);
    if (r > d) shares.push_back((a - d) / (r - d));
  }
  const std::size_t without = kResamples - shares.size();  // a ratio
  if (without > kBeyond) return recovery;
  std::sort(shares.begin(), shares.end());
  recovery.low = shares[kBeyond - without];
  recovery.high = shares[shares.size() - 1 - (kBeyond - without)];
  return recovery;
}

}  // namespace palpa::assess

#include "apps/assess/competence/certification.h"

#include <cmath>

namespace palpa::competence {
namespace {

std::string inPercent(double share) { return std::to_string(std::lround(100 * share)) + " %"; }

}  // namespace

std::vector<Certification> certifications() {
  std::vector<Certification> all;
  for (const auto& [acceptable, unacceptable] : {std::pair(0.10, 0.25), std::pair(0.10, 0.20),
                                                 std::pair(0.05, 0.15), std::pair(0.05, 0.10)}) {
    const statistics::CusumRates rates{acceptable, unacceptable, 0.1, 0.1};
    all.push_back({rates, statistics::cusumLimits(rates)});
  }
  return all;
}

std::string whatCannotBeCertified(int trials) {
  const std::vector<Certification> all = certifications();
  std::string within, beyond;
  const auto clause = [](const Certification& c) {
    return std::to_string(c.limits.shortest_clean_run) + " for a rate of failure of " +
           inPercent(c.rates.acceptable) + " against " + inPercent(c.rates.unacceptable);
  };
  for (const Certification& c : all)
    (c.limits.shortest_clean_run <= trials ? within : beyond) +=
        (((c.limits.shortest_clean_run <= trials ? within : beyond).empty()) ? "" : ", ") +
        clause(c);
  const std::string count = std::to_string(trials) + (trials == 1 ? " trial" : " trials");
  if (beyond.empty())
    return count + " without a failure are enough for every rate shown (" + within + ").";
  return count +
         (within.empty() ? " cannot certify anybody"
                         : " without a failure are enough for some rates (" + within +
                               ") and not for others") +
         ". The fewest trials in a row without a failure: " + beyond +
         " (sequential test, chances of error 0.1 each).";
}

}  // namespace palpa::competence

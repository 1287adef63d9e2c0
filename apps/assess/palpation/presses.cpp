#include "apps/assess/palpation/presses.h"

#include <cmath>

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

}  // namespace palpa::assess

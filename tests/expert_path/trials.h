#pragma once

#include <cmath>
#include <random>
#include <vector>

#include "calibration/expert_path.h"

/// Experts' trials with known mean and spread. mt19937's numbers are fixed by the standard; the
/// sums of twelve that stand for normal ones are ours, so the trials are the same everywhere.
namespace palpa::calibration::test {

constexpr double kDeg = M_PI / 180;

class Normal {
 public:
  explicit Normal(std::uint32_t seed) : random_(seed) {}
  double operator()(double sd) {
    double sum = -6;
    for (int i = 0; i < 12; ++i) sum += static_cast<double>(random_()) / 4294967296.0;
    return sd * sum;
  }

 private:
  std::mt19937 random_;
};

struct Truth {
  Vec3 entry{0.001, -0.020, -0.010};
  double depth = 0.008;
  Vec3 direction = Vec3(0.87, 0.42, 0.24).normalized();
  double length = 0.030;
  double entry_sd = 0.002, depth_sd = 0.001, direction_sd = 2 * kDeg;
};

/// Of the body on which those trials are performed: its vein lies where the mean trial ends.
inline TeachingLine lineOf(const Truth& truth) {
  return {truth.entry, Vec3::UnitY(),
          truth.entry + Vec3(0, truth.depth, 0) + truth.length * truth.direction};
}

inline ExpertTrial drawTrial(const Truth& truth, const std::string& expert, Normal* normal) {
  ExpertTrial trial;
  trial.line = lineOf(truth);
  trial.expert = expert;
  trial.entry_L =
      truth.entry + Vec3((*normal)(truth.entry_sd), 0, (*normal)(truth.entry_sd));  // in the skin
  trial.depth = truth.depth + (*normal)(truth.depth_sd);
  const Vec3 across = truth.direction.cross(Vec3::UnitZ()).normalized();
  const Vec3 other = truth.direction.cross(across);
  trial.direction_L = (truth.direction + (*normal)(truth.direction_sd) * across +
                       (*normal)(truth.direction_sd) * other)
                          .normalized();
  trial.start_L = trial.entry_L + Vec3(0, trial.depth, 0);
  trial.end_L = trial.start_L + truth.length * trial.direction_L;
  return trial;
}

inline std::vector<ExpertTrial> drawTrials(const Truth& truth, int each = 50,
                                           std::uint32_t seed = 7) {
  Normal normal(seed);
  std::vector<ExpertTrial> trials;
  for (const char* expert : {"A", "B", "C"})
    for (int i = 0; i < each; ++i) trials.push_back(drawTrial(truth, expert, &normal));
  return trials;
}

}  // namespace palpa::calibration::test

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>
#include <vector>

#include "haptics/augmentation/learned_part.h"
#include "tests/support/allocation_guard.h"

/// The belief in the tick, against sums over every path; steps against sums written down again.
namespace palpa::haptics {
namespace {

LearnedModel threeStates() {
  LearnedModel model;
  model.states = 3;
  model.start = {0.5, 0.3, 0.2};
  model.transition[0] = {0.8, 0.15, 0.05};
  model.transition[1] = {0.1, 0.7, 0.2};
  model.transition[2] = {0.3, 0.3, 0.4};
  for (std::size_t j = 0; j < 3; ++j) {
    model.mean[j] = {-4 + static_cast<double>(j), -1 + 0.5 * static_cast<double>(j),
                     0.4 * static_cast<double>(j), -4};
    model.variance[j] = {0.5, 0.4, 0.1, 1 + static_cast<double>(j)};
  }
  return model;
}

double likelihood(const LearnedModel& model, std::size_t j, const LearnedRow& x) {
  double p = 1;
  for (std::size_t d = 0; d < x.size(); ++d)
    p *= std::exp(-0.5 * std::pow(x[d] - model.mean[j][d], 2) / model.variance[j][d]) /
         std::sqrt(model.variance[j][d]);
  return p;
}

/// P(last state, steps), by every path there is.
double pathsTo(const LearnedModel& model, const std::vector<LearnedRow>& steps, std::size_t t,
               std::size_t j) {
  double before = 0;
  if (t == 0)
    before = model.start[j];
  else
    for (std::size_t i = 0; i < 3; ++i)
      before += pathsTo(model, steps, t - 1, i) * model.transition[i][j];
  return before * likelihood(model, j, steps[t]);
}

struct Felt {
  double speed = 0;
  Vec3 f = Vec3::Zero();
};
std::vector<Felt> feltFor(int ticks) {
  std::mt19937 bits(5);
  std::uniform_real_distribution<double> even(0, 1);
  std::vector<Felt> felt;
  for (int i = 0; i < ticks; ++i)
    felt.push_back(
        {0.08 * even(bits), (i / 40 % 2) * 2 * even(bits) * Vec3(even(bits), even(bits), 1)});
  return felt;
}

TEST(LearnedPart, TheBeliefIsThatOfEveryPath) {
  const LearnedModel model = threeStates();
  LearnedState state;
  StepSums sums;
  std::vector<LearnedRow> steps;
  for (const Felt& at : feltFor(80)) {
    sums.add(at.speed, at.f, 1e-3);
    const bool ends = sums.ticks == 10;
    if (ends) steps.push_back(sums.close());
    const int said = learnedState(model, at.speed, at.f, 1'000'000, &state);
    if (steps.empty()) {
      EXPECT_EQ(said, -1);
    } else if (ends) {
      double all = 0, most = 0;
      int best = -1;
      std::array<double, 3> p{};
      for (std::size_t j = 0; j < 3; ++j) {
        all += p[j] = pathsTo(model, steps, steps.size() - 1, j);
        if (p[j] > most) most = p[j], best = static_cast<int>(j);
      }
      for (std::size_t j = 0; j < 3; ++j)
        EXPECT_NEAR(state.belief[j], p[j] / all, 1e-12) << steps.size();
      EXPECT_EQ(said, best);
    }
  }
  EXPECT_EQ(steps.size(), 8u);
}

TEST(LearnedPart, AStepIsWhatItsTicksSumUpTo) {
  StepSums sums;
  double speed = 0, force = 0, contact = 0, shaking2 = 0;
  Vec3 slow = Vec3::Zero();
  const std::vector<Felt> felt = feltFor(60);
  for (std::size_t i = 0; i < 60; ++i) {
    sums.add(felt[i].speed, felt[i].f, 1e-3);
    slow += (felt[i].f - slow) / 9;  // 1 ms of 1 + 8 ms
    speed += felt[i].speed;
    force += felt[i].f.norm();
    contact += felt[i].f.norm() >= 0.02;
    shaking2 += (felt[i].f - slow).squaredNorm();
  }
  const LearnedRow row = sums.close();
  EXPECT_NEAR(row[kLogSpeed], std::log(speed / 60), 1e-12);
  EXPECT_NEAR(row[kLogForce], std::log(force / 60), 1e-12);
  EXPECT_NEAR(row[kInContact], contact / 60, 1e-12);
  EXPECT_NEAR(row[kLogShaking], 0.5 * std::log(shaking2 / 60), 1e-12);
  EXPECT_EQ(sums.ticks, 0u);
  EXPECT_LT((unpack(sums.slow_force) - slow).norm(), 1e-12) << "what is slow goes on";
}

TEST(LearnedPart, InTheAirAndAtRestNothingIsInfinite) {
  StepSums sums;
  sums.add(0, Vec3::Zero(), 1e-3);
  EXPECT_EQ(sums.close(), (LearnedRow{std::log(1e-3), std::log(0.02), 0, std::log(0.005)}));
}

TEST(LearnedPart, WithoutAModelOrANumberNothingIsLearnt) {
  LearnedState state;
  EXPECT_EQ(learnedState({}, 0.1, Vec3::UnitZ(), 20'000'000, &state), -1);
  const LearnedModel model = threeStates();
  const double none = std::numeric_limits<double>::quiet_NaN();
  for (int i = 0; i < 30; ++i)
    learnedState(model, i % 2 ? none : 0.1, i % 2 ? Vec3::UnitZ() : Vec3(none, 0, 0), 1'000'000,
                 &state);
  EXPECT_EQ(state.state, -1);
  EXPECT_EQ(state.sums.ticks, 0u);
  EXPECT_EQ(learnedState(model, 0.1, Vec3::UnitZ(), -5, &state), -1);
}

/// However far from all that was learnt: some state it is, and the belief stays one.
TEST(LearnedPart, WhatNoStateExplainsLeavesABelief) {
  LearnedModel model = threeStates();
  for (LearnedRow& v : model.variance) v = {1e-9, 1e-9, 1e-9, 1e-9};
  LearnedState state;
  for (const Felt& at : feltFor(200)) learnedState(model, at.speed, at.f, 1'000'000, &state);
  EXPECT_NEAR(state.belief[0] + state.belief[1] + state.belief[2], 1, 1e-12);
  EXPECT_GE(state.state, 0);
}

TEST(LearnedPart, NeverAllocates) {
  const LearnedModel model = threeStates();
  const std::vector<Felt> felt = feltFor(100);
  LearnedState state;
  const NoAllocation guard;
  for (const Felt& at : felt) learnedState(model, at.speed, at.f, 1'000'000, &state);
  EXPECT_EQ(guard.allocations(), 0);
}

}  // namespace
}  // namespace palpa::haptics

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "apps/calibrate/subtask_features.h"
#include "calibration/parts/hidden_markov.h"
#include "haptics/loop/tick.h"

/// What was learned from recordings, in the loop that they come from: the tick's belief against the
/// calibration's own recursion over what the tick recorded.
namespace palpa::calibrate {
namespace {

using haptics::LearnedModel;

constexpr int kStates = 3;

/// At rest in the air, in motion in the air, in contact.
LearnedModel threeStates() {
  LearnedModel model;
  model.states = kStates;
  model.start = {0.5, 0.3, 0.2};
  model.transition = {{{0.9, 0.05, 0.05}, {0.1, 0.8, 0.1}, {0.02, 0.08, 0.9}}};
  for (std::size_t k = 0; k < kStates; ++k) {
    model.mean[k] = {k == 0 ? -6.5 : -4.0, k == 2 ? 0.3 : -3.9, k == 2 ? 1.0 : 0.0, -4.5};
    model.variance[k] = {0.8, 0.9, 0.1, 1.5};
  }
  return model;
}

calibration::HiddenMarkov asFitted(const LearnedModel& model) {
  calibration::HiddenMarkov m;
  m.start = Eigen::Map<const Eigen::VectorXd>(model.start.data(), kStates);
  m.transition.resize(kStates, kStates);
  m.mean.resize(kStates, kSubtaskFeatures);
  m.variance.resize(kStates, kSubtaskFeatures);
  for (std::size_t k = 0; k < kStates; ++k) {
    const auto row = static_cast<Eigen::Index>(k);
    m.transition.row(row) =
        Eigen::Map<const Eigen::RowVectorXd>(model.transition[k].data(), kStates);
    m.mean.row(row) = Eigen::Map<const Eigen::RowVectorXd>(model.mean[k].data(), kSubtaskFeatures);
    m.variance.row(row) =
        Eigen::Map<const Eigen::RowVectorXd>(model.variance[k].data(), kSubtaskFeatures);
  }
  return m;
}

/// A part for each state, on while the model says so.
haptics::TickConfig learnedConfig() {
  haptics::TickConfig config;
  config.contact_mode = haptics::ContactMode::floor;
  config.coupling = {2000, 0.001};
  config.floor.real = {2000, 1};
  config.floor.unit = 240e-6;
  config.safety.max_force_N = 100;
  config.safety.max_slew_N_per_s = 1e6;
  config.augmentations.learned = threeStates();
  haptics::Subtasks& parts = config.augmentations.subtasks;
  for (; parts.count < kStates; ++parts.count) {
    parts.each[parts.count].count = 1;
    parts.each[parts.count].conditions[0] = {
        haptics::Signal::learned, haptics::Condition::Compare::equal, 0, {}, 1.0 + parts.count, 0};
  }
  return config;
}

/// Rests above a floor, comes down, slides, lifts off, rests: twice in 4 s.
Vec3 wayAt(int ms, double unit) {
  const double u = std::fmod(ms, 2000) / 2000, high = 24 * std::cos(2 * M_PI * u) + 10;
  const double along = u > 0.3 && u < 0.7 ? 100 * (u - 0.3) : u < 0.5 ? 0 : 40;
  return unit * Vec3(along, 0, u < 0.15 || u > 0.85 ? 24 : high);
}

struct Flown {
  std::vector<haptics::FlightRecord> ticks;
  std::vector<SubtaskSequence> sequences;
};

/// Held before for so many ms; parts are told whether cues are allowed or not.
Flown fly(const haptics::TickConfig& config, int held_for, bool allowed) {
  static const haptics::SearchSurface surface(haptics::SearchSpec{}, {0.7, 1}, [] { return 0.5; });
  const haptics::Floor floor{&surface, nullptr, nullptr};
  haptics::TickState state;
  haptics::TickCommands commands;
  commands.armed = 1;
  commands.augmented = allowed;
  Flown flown;
  SubtaskSteps steps(config);
  for (int ms = 1; ms <= 4000 + held_for; ++ms) {
    commands.held = ms <= held_for;
    haptics::DeviceReading reading;
    reading.t_ns = std::int64_t{ms} * 1'000'000;
    reading.sequence = static_cast<std::uint64_t>(ms);
    reading.homed = 1;
    reading.p_DE = pack(wayAt(std::max(0, ms - held_for), config.floor.unit));
    flown.ticks.push_back(
        haptics::tick(config, state, reading, nullptr, commands, reading.t_ns, {}, &floor));
    steps.add(flown.ticks.back());
  }
  flown.sequences = steps.take();
  return flown;
}

/// Of the states in the parts' bits; -1: none.
int stateIn(const haptics::FlightRecord& record) {
  int state = -1;
  for (int k = 0; k < kStates; ++k)
    if (record.subtasks >> k & 1) state = state < 0 ? k : kStates;  // never two
  return state;
}

class LearnedTick : public testing::TestWithParam<bool> {};

TEST_P(LearnedTick, BelievesWhatTheCalibrationWould) {
  const haptics::TickConfig config = learnedConfig();
  const calibration::HiddenMarkov model = asFitted(config.augmentations.learned);
  constexpr int kHeld = 137;
  const Flown flown = fly(config, kHeld, GetParam());
  ASSERT_EQ(flown.sequences.size(), 1u);
  const Eigen::MatrixXd& steps = flown.sequences[0].features;
  ASSERT_GE(steps.rows(), 395);
  for (int ms = 0; ms < kHeld + 9; ++ms)
    EXPECT_EQ(stateIn(flown.ticks[static_cast<std::size_t>(ms)]), -1)
        << "nothing is known yet: " << ms;
  Eigen::VectorXd belief;
  std::array<int, kStates> seen{};
  int agree = 0;
  for (Eigen::Index step = 0; step < steps.rows(); ++step) {
    belief = calibration::filtered(model, belief, steps.row(step).transpose());
    Eigen::Index expected = 0;
    belief.maxCoeff(&expected);
    const int said = stateIn(flown.ticks[static_cast<std::size_t>(kHeld + 10 * (step + 1) - 1)]);
    ASSERT_TRUE(said >= 0 && said < kStates) << step;
    ++seen[static_cast<std::size_t>(said)];
    agree += said == expected;
  }
  for (const int times : seen) EXPECT_GT(times, 20);
  EXPECT_GE(agree, steps.rows() - 2);  // the recording begins with a tick that has no velocity yet
}

INSTANTIATE_TEST_SUITE_P(CuesOffAndOn, LearnedTick, testing::Bool());

TEST(LearnedTrial, AnotherTrialKnowsNothingOfTheLast) {
  const haptics::TickConfig config = learnedConfig();
  haptics::TickState state;
  haptics::TickCommands commands;
  commands.armed = 1;
  commands.trial = 1;
  const auto step = [&](int ms) {
    haptics::DeviceReading reading;
    reading.t_ns = std::int64_t{ms} * 1'000'000;
    reading.sequence = static_cast<std::uint64_t>(ms);
    reading.homed = 1;
    reading.p_DE = pack(Vec3(0, 0, 0.05));
    return haptics::tick(config, state, reading, nullptr, commands, reading.t_ns);
  };
  int ms = 0;
  while (ms < 100) step(++ms);
  EXPECT_EQ(stateIn(step(++ms)), 0);
  commands.trial = 2;
  for (int i = 0; i < 5; ++i) EXPECT_EQ(stateIn(step(++ms)), -1);
}

}  // namespace
}  // namespace palpa::calibrate

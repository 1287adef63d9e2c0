#include "apps/calibrate/subtask_features.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

namespace palpa::calibrate {
namespace {

constexpr std::array<SubtaskFeatureName, kSubtaskFeatures> kFeatureNames{
    {{"log_speed", "speed of the tip"},
     {"log_force", "contact force"},
     {"in_contact", "contact"},
     {"log_shaking", "shaking of the force"}}};

/// Sums before a step's first tick.
const calibration::ToolStep kNoTool{.axis_D = Vec3::Zero()};

void countOne(int value, std::vector<std::pair<int, int>>* counted) {
  const auto known = std::find_if(counted->begin(), counted->end(),
                                  [&](const auto& c) { return c.first == value; });
  if (known == counted->end())
    counted->emplace_back(value, 1);
  else
    ++known->second;
}

/// The value that was counted most often; of equals the one that came first.
int mostOften(const std::vector<std::pair<int, int>>& labels) {
  return std::max_element(labels.begin(), labels.end(),
                          [](const auto& a, const auto& b) { return a.second < b.second; })
      ->first;
}

}  // namespace

const SubtaskFeatureName& subtaskFeatureName(int feature) {
  return kFeatureNames.at(static_cast<std::size_t>(feature));
}

/// As the parts' cue "contact_force" has it: sensed of a real thing, else computed.
Vec3 SubtaskSteps::forceOn(const haptics::FlightRecord& record) const {
  const bool sensed = config_.contact_mode == haptics::ContactMode::sensed_object &&
                      record.sensed.state == haptics::SensorState::valid;
  return unpack(sensed ? record.sensed.f_D : record.f_contact_D);
}

Vec3 SubtaskSteps::tipOf(const haptics::DeviceReading& reading) const {
  return unpack(reading.p_DE) + unpack(reading.q_DE).normalized() * unpack(config_.X_ET.p);
}

/// The tool lies along +z of T.
Vec3 SubtaskSteps::axisOf(const haptics::DeviceReading& reading) const {
  return unpack(reading.q_DE).normalized() * (unpack(config_.X_ET.q).normalized() * Vec3::UnitZ());
}

void SubtaskSteps::interrupt() {
  if (running_ && !rows_.empty()) {
    SubtaskSequence sequence{
        .trial = {},
        .begins_s = 1e-9 * static_cast<double>(begin_ns_),
        .features = Eigen::MatrixXd(static_cast<Eigen::Index>(rows_.size()), kSubtaskFeatures),
        .motion = calibration::interactionFeatures(tools_),
        .labels = std::move(labels_),
        .parts = std::move(parts_)};
    for (std::size_t i = 0; i < rows_.size(); ++i)
      sequence.features.row(static_cast<Eigen::Index>(i)) = rows_[i];
    done_.push_back(std::move(sequence));
  }
  rows_.clear();
  labels_.clear();
  parts_.clear();
  tools_.clear();
  tool_ = kNoTool;
  sums_ = {};
  counted_.clear();
  parts_counted_.clear();
  running_ = false;
}

void SubtaskSteps::closeStep() {
  const std::uint32_t ticks = sums_.ticks;
  const haptics::LearnedRow step = sums_.close();
  closeTool(ticks, step[kLogShaking], step[kInContact]);
  const Eigen::RowVectorXd row =
      Eigen::Map<const Eigen::RowVectorXd>(step.data(), kSubtaskFeatures);
  rows_.push_back(row);
  labels_.push_back(mostOften(counted_));
  parts_.push_back(mostOften(parts_counted_));
  counted_.clear();
  parts_counted_.clear();
  ++step_;
}

void SubtaskSteps::closeTool(std::uint32_t ticks, double log_shaking, double contact) {
  const double n = ticks;
  tools_.push_back({.p_DT = tool_.p_DT / n,
                    .axis_D = tool_.axis_D.normalized(),
                    .f_D = tool_.f_D / n,
                    .shaking = std::exp(log_shaking),
                    .buzzing = std::sqrt(tool_.buzzing / n),
                    .contact = contact,
                    .plunger = tool_.plunger / n});
  tool_ = kNoTool;
}

void SubtaskSteps::count(const haptics::FlightRecord& record) {
  const double dt = 1e-9 * static_cast<double>(record.t_ns - last_ns_);
  haptics::follow(motion_, tipOf(record.reading), kSpeedTau_s, dt);
  sums_.add(unpack(motion_.v_D).norm(), forceOn(record), dt);
  tool_.p_DT += tipOf(record.reading);
  tool_.axis_D += axisOf(record.reading);
  tool_.f_D += forceOn(record);
  tool_.plunger += record.reading.plunger;
  below_buzz_ += (forceOn(record) - below_buzz_) * (dt / (kBuzzTau_s + dt));
  tool_.buzzing += (forceOn(record) - below_buzz_).squaredNorm();
  countOne(record.subtasks, &counted_);
  countOne(record.commands.subtask, &parts_counted_);
}

void SubtaskSteps::add(const haptics::FlightRecord& record) {
  if (record.tool != 0) return;
  if (!record.commands.armed || record.commands.held || !tipOf(record.reading).allFinite() ||
      !forceOn(record).allFinite())
    return interrupt();
  // A step without a tick is a gap.
  if (running_ &&
      (record.t_ns <= last_ns_ || record.t_ns >= begin_ns_ + (step_ + 2) * kSubtaskStep_ns))
    interrupt();
  if (!running_) {
    running_ = true;
    begin_ns_ = last_ns_ = record.t_ns;
    step_ = 0;
    motion_ = {};
    sums_.slow_force = pack(forceOn(record));
    below_buzz_ = forceOn(record);
  }
  if (record.t_ns >= begin_ns_ + (step_ + 1) * kSubtaskStep_ns) closeStep();
  count(record);
  last_ns_ = record.t_ns;
}

std::vector<SubtaskSequence> SubtaskSteps::take() {
  interrupt();
  return std::exchange(done_, {});
}

}  // namespace palpa::calibrate

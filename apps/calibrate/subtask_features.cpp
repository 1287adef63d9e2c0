#include "apps/calibrate/subtask_features.h"

#include <algorithm>
#include <array>
#include <utility>

namespace palpa::calibrate {
namespace {

constexpr std::array<SubtaskFeatureName, kSubtaskFeatures> kFeatureNames{
    {{"log_speed", "speed of the tip"},
     {"log_force", "contact force"},
     {"in_contact", "contact"},
     {"log_shaking", "shaking of the force"}}};

/// The bits that were counted most often; of equals those that came first.
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

void SubtaskSteps::interrupt() {
  if (running_ && !rows_.empty()) {
    SubtaskSequence sequence{
        {},
        1e-9 * static_cast<double>(begin_ns_),
        Eigen::MatrixXd(static_cast<Eigen::Index>(rows_.size()), kSubtaskFeatures),
        std::move(labels_)};
    for (std::size_t i = 0; i < rows_.size(); ++i)
      sequence.features.row(static_cast<Eigen::Index>(i)) = rows_[i];
    done_.push_back(std::move(sequence));
  }
  rows_.clear();
  labels_.clear();
  sums_ = {};
  counted_.clear();
  running_ = false;
}

void SubtaskSteps::closeStep() {
  const haptics::LearnedRow step = sums_.close();
  const Eigen::RowVectorXd row =
      Eigen::Map<const Eigen::RowVectorXd>(step.data(), kSubtaskFeatures);
  rows_.push_back(row);
  labels_.push_back(mostOften(counted_));
  counted_.clear();
  ++step_;
}

void SubtaskSteps::count(const haptics::FlightRecord& record) {
  const double dt = 1e-9 * static_cast<double>(record.t_ns - last_ns_);
  haptics::follow(motion_, tipOf(record.reading), kSpeedTau_s, dt);
  sums_.add(unpack(motion_.v_D).norm(), forceOn(record), dt);
  const int bits = record.subtasks;
  const auto label = std::find_if(counted_.begin(), counted_.end(),
                                  [&](const auto& l) { return l.first == bits; });
  if (label == counted_.end())
    counted_.emplace_back(bits, 1);
  else
    ++label->second;
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

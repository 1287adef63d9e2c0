#include "apps/task_search/search_listener.h"

#include <algorithm>

namespace palpa::task_search {
namespace {

constexpr double kLongestGap_s = 0.1;  // longer: it was paused

}  // namespace

SearchListener::SearchListener(const SearchSettings& task, const haptics::AugmentationPlan& plan)
    : task_(&task), plan_(plan) {}

void SearchListener::begin(std::uint32_t trial) {
  *this = SearchListener(*task_, plan_);
  trial_ = trial;
  doses_ = assess::DoseCounter(plan_, task_->augmentations.subtaskNames());
}

void SearchListener::add(const haptics::FlightRecord& record, const Vec3& p_DT) {
  if (record.commands.trial != trial_ || !record.commands.armed || record.commands.held) return;
  const double dt = last_ns_ < 0 ? 0 : 1e-9 * static_cast<double>(record.t_ns - last_ns_);
  const Vec3 way = p_DT - p_last_;
  last_ns_ = record.t_ns;
  p_last_ = p_DT;
  released_ = true;
  if (dt <= 0 || dt > kLongestGap_s) return;
  seconds_ += dt;
  path_ += way.norm();
  subtasks_ = record.subtasks;
  doses_.add(record, dt);
  const int element = (record.place & haptics::kPlaceElement) - 1;
  if (element >= 0) visited_[static_cast<std::size_t>(element)] += dt;
  if (record.place & haptics::kPlaceTouching) {
    const double N = (unpack(record.f_contact_D) + unpack(record.f_augmentation_D)).norm();
    peak_N_ = std::max(peak_N_, N);
    force_Ns_ += N * dt;
    contact_s_ += dt;
  }
  const bool in_pit =
      (record.place & haptics::kPlacePit) && (record.place & haptics::kPlaceTouching);
  dwell_s_ = in_pit && element == dwells_ ? dwell_s_ + dt : 0;
  dwells_ = in_pit ? element : -1;
  if (chosen_ < 0 && dwell_s_ >= task_->dwell_s) chosen_ = element;
}

assess::SearchTrial SearchListener::heard(assess::SearchTrial facts) const {
  facts.chosen = chosen_;
  facts.seconds = seconds_;
  facts.path_m = path_;
  facts.peak_force_N = peak_N_;
  facts.mean_force_N = contact_s_ > 0 ? force_Ns_ / contact_s_ : 0;
  facts.visited_s = visited_;
  facts.doses = doses_.doses();
  return facts;
}

}  // namespace palpa::task_search

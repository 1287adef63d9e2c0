#pragma once

#include <algorithm>
#include <cstdint>
#include <vector>

namespace palpa::training {

/// The one time of a trial, for who performs, judges and shows it. It runs while the device is
/// armed: a pause does not count, nor does a gap in which nobody was served.
class TrialClock {
 public:
  static constexpr double kLongestGap_s = 0.1;  ///< longer between two ticks: nobody was served

  /// An armed tick of the trial, at its session time in ns. How much it adds, s: 0 for the first,
  /// the first after a pause or a gap, and one of the same time (a second tool's).
  double pass(std::int64_t t_ns) {
    const double dt_s = last_ns_ < 0 ? 0 : 1e-9 * static_cast<double>(t_ns - last_ns_);
    last_ns_ = t_ns;
    if (!(dt_s > 0 && dt_s <= kLongestGap_s)) return 0;
    seconds_ += dt_s;
    return dt_s;
  }
  void pause() { last_ns_ = -1; }  ///< a tick that is not armed
  double seconds() const { return seconds_; }

 private:
  std::int64_t last_ns_ = -1;
  double seconds_ = 0;
};

/// A trial's time of any session time, out of its ticks in their order: where a note, an event or a
/// sample of a curve belongs beside what was judged.
class TrialTimes {
 public:
  void add(std::int64_t t_ns, bool armed) {
    if (!armed) return clock_.pause();
    const bool goes_on = clock_.pass(t_ns) > 0;
    const Armed now{t_ns, t_ns, clock_.seconds()};
    if (!goes_on && (runs_.empty() || t_ns > runs_.back().to_ns)) runs_.push_back(now);
    runs_.back().to_ns = t_ns;
  }
  /// s; what lay in a pause is at its begin, what came before the trial at 0, after it at its end.
  double at(std::int64_t t_ns) const {
    const auto after =
        std::upper_bound(runs_.begin(), runs_.end(), t_ns,
                         [](std::int64_t t, const Armed& run) { return t < run.from_ns; });
    if (after == runs_.begin()) return 0;
    const Armed& run = *(after - 1);
    return run.from_s + 1e-9 * static_cast<double>(std::min(t_ns, run.to_ns) - run.from_ns);
  }
  double length_s() const { return clock_.seconds(); }

 private:
  struct Armed {
    std::int64_t from_ns, to_ns;
    double from_s;  ///< the trial's time there
  };
  TrialClock clock_;
  std::vector<Armed> runs_;
};

}  // namespace palpa::training

#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <vector>

#include "anatomy/base/random.h"

namespace palpa::twin {

/// How a person notices beats by what the fingers press, N, 100 times a second. Of it, low-passed
/// twice with 30 ms (what trembles at 8 to 12 Hz is not attended to), the rise over the lowest of
/// the last 0.25 s,
///     r = f - min f
/// A beat is noticed where r has been above
///     (least + contrast b) (1 + s n)
/// for the first time since it fell below a fifth of its largest: b the third quarter of the last
/// five beats' largest r, n standard normal for each beat. At most once in 0.22 s; who has felt
/// nothing for 2.5 s attends to anything again.
class BeatSense {
 public:
  static constexpr double kStep_s = 0.01;
  struct Limits {
    double least_N = 0.015;
    double contrast = 0.25;
    double spread = 0.1;
  };
  BeatSense(const Limits& limits, RandomStream noise) : limits_(limits), noise_(noise) {}

  void begin() {
    seen_ = 0;
    rises_.clear();
    up_ = false;
    since_s_ = kRest_s;
    attend();
  }

  /// The next step; true: a beat is noticed now.
  bool feel(double pressed_N) {
    if (seen_ == 0) fast_ = smooth_ = pressed_N, last_.fill(pressed_N);
    fast_ += (pressed_N - fast_) * (kStep_s / (kFast_s + kStep_s));
    smooth_ += (fast_ - smooth_) * (kStep_s / (kFast_s + kStep_s));
    last_[seen_++ % last_.size()] = smooth_;
    const double rise = smooth_ - *std::min_element(last_.begin(), last_.end());
    since_s_ += kStep_s;
    if (up_) {
      top_ = std::max(top_, rise);
      if (rise >= 0.2 * top_) return false;
      up_ = false;
      rises_.push_back(top_);
      attend();
      return false;
    }
    if (since_s_ > kForgets_s && !rises_.empty()) {
      rises_.clear();
      attend();
    }
    if (rise < threshold_ || since_s_ < kRest_s) return false;
    up_ = true;
    top_ = rise;
    since_s_ = 0;
    return true;
  }
  /// b above, N; 0: no beat is over.
  double usual() const {
    if (rises_.empty()) return 0;
    std::vector<double> last(rises_.end() - std::min<std::ptrdiff_t>(5, std::ssize(rises_)),
                             rises_.end());
    std::sort(last.begin(), last.end());
    return last[3 * (last.size() - 1) / 4];
  }

 private:
  static constexpr double kFast_s = 0.03, kRest_s = 0.22, kForgets_s = 2.5;

  void attend() {
    threshold_ = (limits_.least_N + limits_.contrast * usual()) *
                 std::max(1 + limits_.spread * noise_.normal(), 0.2);
  }
  Limits limits_;
  RandomStream noise_;
  double fast_ = 0, smooth_ = 0, top_ = 0, since_s_ = kRest_s;
  double threshold_ = limits_.least_N;
  bool up_ = false;
  std::size_t seen_ = 0;
  std::array<double, 25> last_{};
  std::vector<double> rises_;
};

/// What a rhythm is taken for by the intervals that were felt, s: 1 regular, 2 regular with
/// premature beats, 3 irregular. Of the middle interval M, an interval is even within 15 %; a short
/// one and the long one after it belong together where their sum is 2 M within 12 % (a compensatory
/// pause), and one of about 2 M hides a beat that was not felt. Irregular where more than 15 % are
/// neither; with premature beats where there are two such pauses, or one with its short interval.
inline int rhythmBy(const std::vector<double>& intervals) {
  constexpr double kEven = 0.15, kPause = 0.12, kOdd = 0.15;
  if (intervals.size() < 5) return 1;
  std::vector<double> sorted = intervals;
  std::sort(sorted.begin(), sorted.end());
  const double middle = sorted[sorted.size() / 2];
  int odd = 0, pairs = 0, hidden = 0;
  for (std::size_t i = 0; i < intervals.size(); ++i) {
    const double now = intervals[i] / middle;
    const double next = i + 1 < intervals.size() ? intervals[i + 1] / middle : 0;
    if (std::abs(now - 1) < kEven) continue;
    if (now < 1 && next > 1 + kEven && std::abs(now + next - 2) < 2 * kPause) {
      ++pairs;
      ++i;
    } else if (std::abs(now - 2) < 2 * kPause) {
      ++hidden;
    } else {
      ++odd;
    }
  }
  if (odd > kOdd * static_cast<double>(intervals.size())) return 3;
  return pairs >= 1 || hidden >= 2 ? 2 : 1;
}

}  // namespace palpa::twin

#pragma once

#include <algorithm>

namespace palpa::training {

/// Help that fades with the trainee's skill: all of it at first, less after each good trial, a
/// little more after one that was not. Every second trial has none, for it is the unaided ones that
/// count.
///     g - 0.34 after a good trial, g + 0.17 after another; 0 (never) <= g <= 1
/// [chosen, after the finding that help as needed served retention and constant help hurt it]
class FadingSupport {
 public:
  /// `start`: g at first, 0 to 1.
  explicit FadingSupport(bool on, double start = 1)
      : on_(on), amount_(on ? std::clamp(start, 0.0, 1.0) : 0) {}

  /// Trials from 1: the odd ones are helped.
  bool helps(int trial) const { return on_ && trial % 2 == 1 && amount_ > 0; }
  double amount() const { return amount_; }                          ///< g
  double in(int trial) const { return helps(trial) ? amount_ : 0; }  ///< of this trial
  void end(bool good) {
    constexpr double kLess = 0.34, kMore = 0.17;
    if (on_) amount_ = std::clamp(amount_ + (good ? -kLess : kMore), 0.0, 1.0);
  }

 private:
  bool on_;
  double amount_;
};

}  // namespace palpa::training

#pragma once

namespace palpa::training {

/// Help that fades with the trainee's skill: all of it at first, less after each good trial, a
/// little more after one that was not. Every second trial has none, for it is the unaided ones that
/// count.
///     g - 0.34 after a good trial, g + 0.17 after another; 0 (never) <= g <= 1
/// [chosen, after the finding that help as needed served retention and constant help hurt it]
class FadingSupport {
 public:
  /// `start`: g at first, 0 to 1.
  explicit FadingSupport(bool on, double start = 1);

  /// Trials from 1: the odd ones are helped.
  bool helps(int trial) const { return on_ && trial % 2 == 1 && amount_ > 0; }
  double amount() const { return amount_; }                          ///< g
  double in(int trial) const { return helps(trial) ? amount_ : 0; }  ///< of this trial
  void end(bool good);

 private:
  bool on_;
  double amount_;
};

}  // namespace palpa::training

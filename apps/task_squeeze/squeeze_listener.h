#pragma once

#include <array>

#include "apps/task_squeeze/squeeze_file.h"
#include "haptics/flight_record.h"

namespace palpa::task_squeeze {

/// Makes of the recorded ticks of both tools what a comparison is judged by; the same for a session
/// and for its replay. Held: both sensors feel more than `touch` for 0.1 s or longer. Squeezing:
/// the smaller of the forces that both fingers hold against, the real thing's and the device's
/// together.
class SqueezeListener {
 public:
  explicit SqueezeListener(double touch) : touch_(touch) {}
  void begin(std::uint32_t trial, const Comparison& comparison);
  /// Both tools' records of a tick, the first one's first. Counts while the trial is on and force
  /// may be rendered.
  void add(const haptics::FlightRecord& record);

  double seconds() const { return seconds_; }  ///< of the trial, pauses left out
  double peak() const { return peak_; }        ///< N
  double now_N() const { return now_N_; }      ///< squeezing force of the last tick
  bool held() const { return held_s_ > 0; }    ///< both fingers touch
  const std::array<int, 2>& grips() const { return grips_; }
  int thing(const haptics::TickCommands& commands)
      const;  ///< which of the two is felt by these commands: 0 or 1

 private:
  double touch_;
  std::uint32_t trial_ = 0;
  Comparison comparison_;
  std::int64_t last_ns_ = -1;
  haptics::FlightRecord first_;  ///< of the first tool, in this tick
  double seconds_ = 0, peak_ = 0, now_N_ = 0, held_s_ = 0;
  std::array<int, 2> grips_{0, 0};
};

/// What the loop is told of one of the two things.
void tellLoop(const Comparison& comparison, int thing, haptics::TickCommands* commands);

}  // namespace palpa::task_squeeze

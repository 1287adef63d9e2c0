#pragma once

#include <cstdint>

#include "apps/doctor/finding.h"
#include "apps/doctor/picture_facts.h"
#include "apps/runtime/clock.h"

namespace palpa::doctor {

/// How the computer's clocks went for a while.
struct ClockFacts {
  std::int64_t resolution_ns = 1;  ///< of the clock by which sessions run
  double seconds = 0;              ///< how long they were watched
  double date_moved_ms =
      0;  ///< how much further the date went than that clock: it was set meanwhile
  bool synchronised = true;  ///< the date is kept by a time server
};

/// Watches them from its making until it is asked.
class ClockWatch {
 public:
  ClockWatch();
  ClockFacts facts() const;

 private:
  std::int64_t ahead() const;  ///< of the date before that clock
  runtime::SteadyClock clock_;
  std::int64_t ahead_;
};

/// `shared`: several stations write into the same records, and their dates should agree.
/// `pictures`: whether the camera dates its pictures by this computer's clock.
Finding judgeClocks(const ClockFacts& facts, const PictureFacts& pictures, bool shared);

}  // namespace palpa::doctor

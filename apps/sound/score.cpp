#include "apps/sound/score.h"

#include <algorithm>
#include <cmath>

namespace palpa::sound {
namespace {

constexpr double kLeastRise = 1e-6;  // of the syringe: below what could be drawn

}  // namespace

std::vector<CueStart> Score::next(const Seen& seen, std::int64_t now_ns) {
  std::vector<CueStart> starts;
  addBeats(seen, now_ns, &starts);
  addBlood(seen, now_ns, &starts);
  addAlarm(seen, now_ns, &starts);
  last_ns_ = now_ns;
  return starts;
}

void Score::addBeats(const Seen& seen, std::int64_t now_ns, std::vector<CueStart>* starts) const {
  if (!heart_per_min_ || !seen.running || last_ns_ < 0) return;
  const double period_ns = 60e9 / *heart_per_min_;
  const std::int64_t since_ns = std::max(last_ns_, now_ns - kTooLate_ns);
  double number = std::ceil(static_cast<double>(since_ns) / period_ns);
  for (;; ++number) {
    const std::int64_t t_ns = std::llround(number * period_ns);
    if (t_ns > now_ns) return;
    if (t_ns > since_ns) starts->push_back({Cue::beat, t_ns});
  }
}

void Score::addBlood(const Seen& seen, std::int64_t now_ns, std::vector<CueStart>* starts) {
  if (seen.trial != trial_) {
    trial_ = seen.trial;
    level_ = 0;
    rose_ns_ = now_ns - 2 * kFlashOver_ns;
  }
  const bool rises = seen.blood > level_ + kLeastRise;
  level_ = seen.blood;
  if (!rises) return;
  const bool flashes = now_ns - rose_ns_ > kFlashOver_ns;
  rose_ns_ = now_ns;
  if (flashes) said_arterial_ = false;
  const bool is_news = seen.arterial && !said_arterial_;
  if (flashes || is_news)
    starts->push_back({seen.arterial ? Cue::arterial_blood : Cue::blood, now_ns});
  said_arterial_ = said_arterial_ || seen.arterial;
}

void Score::addAlarm(const Seen& seen, std::int64_t now_ns, std::vector<CueStart>* starts) {
  const Urgency before = standing_;
  standing_ = seen.urgency == Urgency::none ? Urgency::none : std::max(before, seen.urgency);
  if (standing_ == Urgency::none || (standing_ == before && now_ns < again_ns_)) return;
  starts->push_back({standing_ == Urgency::high ? Cue::alarm : Cue::warning, now_ns});
  again_ns_ = now_ns + kAgain_ns;
}

}  // namespace palpa::sound

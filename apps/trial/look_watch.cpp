#include "apps/trial/look_watch.h"

#include "apps/runtime/clock.h"

namespace palpa::trial {
namespace {

constexpr std::int64_t kPeriod = runtime::kSecond;
constexpr double kNew = 0.3;  // how much of a later measurement counts: light changes slowly

double toward(double before, double now, double share) { return before + share * (now - before); }

}  // namespace

void LookWatch::take(const std::optional<ar::PictureLook>& measured) {
  if (!measured) return;
  const double share = known_ ? kNew : 1;
  const ar::PictureLook& now = *measured;
  look_.blur_px = toward(look_.blur_px, now.blur_px, share);
  for (std::size_t k = 0; k < 3; ++k) {
    look_.black[k] = toward(look_.black[k], now.black[k], share);
    look_.white[k] = toward(look_.white[k], now.white[k], share);
  }
  for (std::size_t k = 0; k < now.grain.size(); ++k)
    look_.grain[k] = toward(look_.grain[k], now.grain[k], share);
  look_.grain_neighbours = toward(look_.grain_neighbours, now.grain_neighbours, share);
  look_.grain_colour = toward(look_.grain_colour, now.grain_colour, share);
  known_ = true;
}

void LookWatch::see(const cv::Mat& picture, const cv::Rect& where, std::int64_t now_ns) {
  if (now_ns < next_ns_) return;
  const bool first = next_ns_ == INT64_MIN;
  next_ns_ = now_ns + kPeriod;
  if (first) return take(ar::lookOf(picture, where));
  if (pending_.valid()) take(pending_.get());
  pending_ = beside_.start([picture, where] { return ar::lookOf(picture, where); });
}

}  // namespace palpa::trial

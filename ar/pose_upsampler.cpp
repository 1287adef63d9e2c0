#include "ar/pose_upsampler.h"

#include <algorithm>
#include <cmath>

namespace palpa::ar {

Pose PoseUpsampler::carriedTo(std::int64_t now_ns) const {
  const double dt = std::clamp(1e-9 * static_cast<double>(now_ns - t_ns_), 0.0, settings_.longest),
               m = settings_.memory;
  return stepped(X_, dt * rate_ + m * (dt - m * (1 - std::exp(-dt / m))) * acceleration_);
}

void PoseUpsampler::take(const PoseMotion& motion, std::int64_t t_ns, std::int64_t now_ns) {
  const Pose said = at(now_ns);
  X_ = motion.X;
  rate_ = motion.rate;
  acceleration_ = motion.acceleration;
  t_ns_ = t_ns;
  contradiction_ = started_ ? difference(said, carriedTo(now_ns)) : Vector6::Zero();
  taken_ns_ = now_ns;
  started_ = true;
}

Pose PoseUpsampler::at(std::int64_t now_ns) const {
  if (!started_) return Pose::Identity();
  const double s =
      std::clamp(1e-9 * static_cast<double>(now_ns - taken_ns_) / settings_.blend, 0.0, 1.0);
  return stepped(carriedTo(now_ns), (1 - s * s * (3 - 2 * s)) * contradiction_);
}

}  // namespace palpa::ar

#include "ar/tracking/pose_track.h"

#include <algorithm>
#include <cmath>

namespace palpa::ar {
namespace {

double since(std::int64_t from_ns, std::int64_t to_ns) {
  return 1e-9 * static_cast<double>(to_ns - from_ns);
}

/// `s` of the way from a to b, `dt` apart.
Pose between(const PoseMotion& a, const PoseMotion& b, double s, double dt) {
  const Vector6 whole = difference(b.X, a.X);
  const double s2 = s * s, s3 = s2 * s;
  return stepped(
      a.X, (s3 - 2 * s2 + s) * dt * a.rate + (-2 * s3 + 3 * s2) * whole + (s3 - s2) * dt * b.rate);
}

}  // namespace

bool PoseTrack::add(const Pose& X, const Matrix6& covariance, std::int64_t t_ns) {
  const PoseFilter::Taken taken = filter_.update(X, covariance, t_ns);
  if (taken == PoseFilter::Taken::left_out) return false;
  if (taken == PoseFilter::Taken::started_anew)
    past_.clear();  // between the other side of a gap or a jump and here no way was gone
  past_.push_back({t_ns, filter_.now()});
  while (since(past_.front().t_ns, t_ns) > settings_.remembers) past_.pop_front();
  return true;
}

PoseLookup PoseTrack::at(std::int64_t t_ns) const {
  if (past_.empty() || t_ns < past_.front().t_ns) return {};
  const auto after = std::upper_bound(past_.begin(), past_.end(), t_ns,
                                      [](std::int64_t t, const Entry& e) { return t < e.t_ns; });
  const Entry& a = *std::prev(after);
  if (a.t_ns == t_ns) return {Lookup::exact, a.motion.X, a.motion.covariance.topLeftCorner<6, 6>()};
  if (after == past_.end()) {
    if (since(a.t_ns, t_ns) > settings_.longest_prediction) return {};
    const PoseMotion there = filter_.at(t_ns);
    return {Lookup::predicted, there.X, there.covariance.topLeftCorner<6, 6>()};
  }
  const Entry& b = *after;
  const double dt = since(a.t_ns, b.t_ns), s = since(a.t_ns, t_ns) / dt;
  return {Lookup::interpolated, between(a.motion, b.motion, s, dt),
          (1 - s) * a.motion.covariance.topLeftCorner<6, 6>() +
              s * b.motion.covariance.topLeftCorner<6, 6>()};
}

void PoseTrack::forget() {
  filter_.reset();
  past_.clear();
}

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

#include "apps/assess/metrics/motion.h"

#include <cmath>

#include "anatomy/geometry/error.h"

namespace palpa::metrics {
namespace {

struct Step {
  Vec3 tip = Vec3::Zero(), axis = Vec3::Zero();
  double inserted = 0, force = 0;
  int count = 0;

  void add(const RawSample& s) {
    tip += s.tip;
    axis += s.axis;
    inserted += s.inserted;
    force += s.force;
    ++count;
  }
  void appendTo(Motion& motion) const {
    motion.tip.push_back(tip / count);
    motion.axis.push_back(axis.normalized());
    motion.inserted.push_back(inserted / count);
    motion.force.push_back(force / count);
  }
};

void repeatLast(Motion& motion) {
  motion.tip.push_back(Vec3(motion.tip.back()));
  motion.axis.push_back(Vec3(motion.axis.back()));
  motion.inserted.push_back(double{motion.inserted.back()});
  motion.force.push_back(double{motion.force.back()});
}

void require(const RawSample& s, double before_s) {
  const bool finite = std::isfinite(s.t_s) && s.tip.allFinite() && s.axis.allFinite() &&
                      std::isfinite(s.inserted) && std::isfinite(s.force);
  if (!finite || s.t_s < before_s)
    throw Error(finite ? "the time runs backward" : "a sample is not finite",
                "motion at " + std::to_string(s.t_s) + " s", "The recording is damaged");
}

}  // namespace

Motion motionOf(const std::vector<RawSample>& samples) {
  Motion motion;
  if (samples.empty()) return motion;
  const double start = samples.front().t_s;
  Step step;
  double before = start;
  for (const RawSample& s : samples) {
    require(s, before);
    before = s.t_s;
    const auto index = static_cast<std::size_t>((s.t_s - start) / Motion::kStep_s + 1e-9);
    if (index > motion.size() && step.count > 0) {
      step.appendTo(motion);
      step = {};
    }
    while (index > motion.size()) repeatLast(motion);
    step.add(s);
  }
  if (step.count > 0) step.appendTo(motion);
  return motion;
}

std::vector<double> speedsOf(const Motion& motion) {
  std::vector<double> speeds;
  for (std::size_t i = 1; i < motion.size(); ++i)
    speeds.push_back((motion.tip[i] - motion.tip[i - 1]).norm() / Motion::kStep_s);
  return speeds;
}

std::vector<double> turningSpeedsOf(const Motion& motion) {
  std::vector<double> speeds;
  for (std::size_t i = 1; i < motion.size(); ++i)
    speeds.push_back(std::atan2(motion.axis[i].cross(motion.axis[i - 1]).norm(),
                                motion.axis[i].dot(motion.axis[i - 1])) /
                     Motion::kStep_s);
  return speeds;
}

}  // namespace palpa::metrics

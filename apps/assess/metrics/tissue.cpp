#include "apps/assess/metrics/tissue.h"

namespace palpa::metrics {
namespace {

bool insideAt(const Motion& motion, std::size_t i) { return motion.inserted[i] > 0; }
bool insideSince(const Motion& motion, std::size_t i) {
  return i > 0 && insideAt(motion, i) && insideAt(motion, i - 1);
}
Vec3 entryAt(const Motion& motion, std::size_t i) {
  return motion.tip[i] - motion.inserted[i] * motion.axis[i];
}
double triangle(const Vec3& a, const Vec3& b, const Vec3& c) {
  return (b - a).cross(c - a).norm() / 2;
}

}  // namespace

double tissueTime(const Motion& motion) {
  double sum = 0;
  for (std::size_t i = 0; i < motion.size(); ++i) sum += insideAt(motion, i) ? Motion::kStep_s : 0;
  return sum;
}

double tissuePath(const Motion& motion) {
  double sum = 0;
  for (std::size_t i = 1; i < motion.size(); ++i)
    if (insideSince(motion, i)) sum += (motion.tip[i] - motion.tip[i - 1]).norm();
  return sum;
}

double tissueDamage(const Motion& motion) {
  double sum = 0;
  for (std::size_t i = 1; i < motion.size(); ++i) {
    if (!insideSince(motion, i)) continue;
    const Vec3 before = entryAt(motion, i - 1), after = entryAt(motion, i);
    sum +=
        triangle(before, motion.tip[i - 1], motion.tip[i]) + triangle(before, motion.tip[i], after);
  }
  return sum;
}

int insertions(const Motion& motion) {
  int count = 0;
  for (std::size_t i = 0; i < motion.size(); ++i)
    count += insideAt(motion, i) && (i == 0 || !insideAt(motion, i - 1));
  return count;
}

}  // namespace palpa::metrics

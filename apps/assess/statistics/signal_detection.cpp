#include "apps/assess/statistics/signal_detection.h"

#include <boost/math/distributions/normal.hpp>

namespace palpa::statistics {
namespace {

double zOf(int called, int of) {
  return boost::math::quantile(boost::math::normal(), (called + 0.5) / (of + 1.0));
}

}  // namespace

Discrimination discriminationOf(const Detections& seen) {
  if (seen.signals <= 0 || seen.rest <= 0) return {};
  const double hits = zOf(seen.hits, seen.signals), alarms = zOf(seen.alarms, seen.rest);
  return {hits - alarms, -(hits + alarms) / 2};
}

}  // namespace palpa::statistics

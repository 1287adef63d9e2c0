#include "haptics/sensors/wrench_bias.h"

#include <cmath>

#include "anatomy/geometry/error.h"
#include "haptics/sensors/wrench_filter.h"

namespace palpa::haptics {
namespace {

using Six = Eigen::Matrix<double, 6, 1>;

Six stacked(const Packed3& f, const Packed3& tau) {
  return {f[0], f[1], f[2], tau[0], tau[1], tau[2]};
}

Wrench wrenchOf(const Six& v) { return {{v[0], v[1], v[2]}, {v[3], v[4], v[5]}}; }

}  // namespace

BiasEstimate wrenchBias(std::span<const WrenchSample> samples, const ToolLoad& tool,
                        const Packed3& g_S) {
  if (samples.size() < 2)
    throw Error("fewer than two samples for the bias", "force sensor", "Record for a second.");
  Six sum = Six::Zero();
  for (const WrenchSample& s : samples) {
    if (s.flags & kUnusable)
      throw Error("a sample for the bias is missing or faulty", "force sensor",
                  "Check that the sensor streams without faults, then record again.");
    sum += stacked(s.f_S, s.tau_S);
  }
  const double n = static_cast<double>(samples.size());
  const Six mean = sum / n;
  Six squares = Six::Zero();
  for (const WrenchSample& s : samples) squares += (stacked(s.f_S, s.tau_S) - mean).cwiseAbs2();
  SensorMotion rest;
  rest.g_S = g_S;
  const Wrench weight = toolWrench(tool, rest);
  return {wrenchOf(mean - stacked(weight.f_S, weight.tau_S)),
          wrenchOf((squares / (n - 1)).cwiseSqrt())};
}

}  // namespace palpa::haptics

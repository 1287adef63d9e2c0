#include "apps/calibrate/rig_adapters.h"

#include <gtest/gtest.h>

#include <cmath>

#include "apps/runtime/device_adapters.h"
#include "calibration/registration.h"
#include "tests/support/allocation_guard.h"

namespace palpa::calibrate {
namespace {

/// A grid touched by a device whose error is a slow wave.
std::vector<calibration::TouchedPoint> touchedGrid() {
  std::vector<calibration::TouchedPoint> points;
  for (int i = 0; i < 4; ++i)
    for (int j = 0; j < 4; ++j)
      for (int k = 0; k < 4; ++k) {
        const Vec3 p(0.04 * i - 0.06, 0.04 * j - 0.06, 0.03 * k - 0.045), lever(0, 0, -0.11);
        const Vec3 error(0.002 * std::sin(9 * p.y()), 0.001 * std::sin(12 * p.x() + 1),
                         0.0015 * std::cos(10 * p.z()));
        points.push_back({p + lever, p + error + lever, lever});
      }
  return points;
}

TEST(WorkspaceCorrection, InTheLoopIsTheMapThatWasFitted) {
  for (int order = 1; order <= 3; ++order) {
    calibration::WorkspaceMap map;
    map.order = order;
    map.centre_D = Vec3(0.01, -0.02, 0.03);
    map.half_D = Vec3(0.06, 0.07, 0.05);
    map.coefficients.resize((order + 1) * (order + 2) * (order + 3) / 6, 3);
    for (Eigen::Index k = 0; k < map.coefficients.rows(); ++k)
      map.coefficients.row(k) = 1e-3 * Vec3(std::sin(1.0 + 3.0 * static_cast<double>(k)),
                                            std::cos(2.0 * static_cast<double>(k)), 0.3)
                                           .transpose();
    const haptics::WorkspaceCorrection correction = CorrectedRig::asCorrection(map);
    for (const Vec3& p : {Vec3(0, 0, 0), Vec3(0.03, -0.05, 0.02), Vec3(-0.08, 0.01, 0.06)})
      EXPECT_LT((unpack(haptics::corrected(correction, pack(p))) - map.corrected(p)).norm(), 1e-15)
          << order;
  }
}

TEST(WorkspaceCorrection, OfAWaveLeavesLittle) {
  const calibration::WorkspaceMap map = calibration::mapWorkspace(touchedGrid());
  EXPECT_GE(map.order, 2);
  EXPECT_LT(map.left_out_after, 0.1 * map.left_out_before);
}

TEST(WorkspaceCorrection, NoneLeavesPlacesAsTheyAre) {
  const Packed3 p{0.1, -0.2, 0.3};
  EXPECT_EQ(haptics::corrected({}, p), p);
}

class StillDevice final : public haptics::HapticDevice {
 public:
  const haptics::DeviceCapabilities& capabilities() const override { return capabilities_; }
  haptics::DeviceReading read(std::int64_t) noexcept override {
    haptics::DeviceReading r;
    r.p_DE = {0.01, 0.02, 0.03};
    return r;
  }
  void command(std::int64_t, const Packed3&) noexcept override {}

 private:
  haptics::DeviceCapabilities capabilities_;
};

TEST(WorkspaceCorrection, InTheTickAllocatesNothing) {
  StillDevice device;
  const calibration::WorkspaceMap map = calibration::mapWorkspace(touchedGrid());
  runtime::CorrectedDevice corrected(device, CorrectedRig::asCorrection(map));
  haptics::DeviceReading reading;
  {
    const NoAllocation guard;
    reading = corrected.read(0);
    EXPECT_EQ(guard.allocations(), 0);
  }
  EXPECT_LT((unpack(reading.p_DE) - map.corrected(Vec3(0.01, 0.02, 0.03))).norm(), 1e-15);
}

}  // namespace
}  // namespace palpa::calibrate

#include "haptics/sensors/force_sensor.h"

#include <gtest/gtest.h>

#include "anatomy/base/error.h"

namespace palpa::haptics {
namespace {

WrenchSample at(std::int64_t t_ns, double f) {
  WrenchSample sample;
  sample.t_ns = t_ns;
  sample.sequence = static_cast<std::uint64_t>(t_ns);
  sample.f_S = {f, 0, 0};
  return sample;
}

TEST(ReplaySensor, HoldsTheNewestWhoseTimeHasCome) {
  ReplaySensor sensor({}, {at(10, 1), at(20, 2), at(30, 3)});
  EXPECT_EQ(sensor.read(9).flags, kNothingYet);
  EXPECT_EQ(sensor.read(9).f_S[0], 0);
  EXPECT_EQ(sensor.read(10).f_S[0], 1);
  EXPECT_EQ(sensor.read(19).f_S[0], 1);
  EXPECT_EQ(sensor.read(20).f_S[0], 2);
  EXPECT_EQ(sensor.read(1'000'000).f_S[0], 3) << "the last one stays";
  EXPECT_EQ(sensor.read(15).f_S[0], 1) << "wound back";
}

TEST(ReplaySensor, NoSamplesAreNothing) {
  EXPECT_EQ(ReplaySensor({}, {}).read(5).flags, kNothingYet);
}

TEST(ReplaySensor, RecordedFlagsComeBack) {
  WrenchSample faulty = at(1, 0);
  faulty.flags = kFault;
  faulty.status = 9;
  ReplaySensor sensor({}, {faulty});
  EXPECT_EQ(sensor.read(1).flags, kFault);
  EXPECT_EQ(sensor.read(1).status, 9u);
}

TEST(ReplaySensor, SamplesThatGoBackAreRefusedByNumber) {
  try {
    const ReplaySensor never({}, {at(10, 1), at(20, 2), at(15, 3)});
    FAIL();
  } catch (const UsageError& error) {
    EXPECT_NE(std::string(error.what()).find("sample 2"), std::string::npos) << error.what();
  }
}

}  // namespace
}  // namespace palpa::haptics

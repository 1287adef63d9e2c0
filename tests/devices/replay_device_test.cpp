#include "haptics/devices/replay_device.h"

#include <gtest/gtest.h>

#include "anatomy/base/error.h"

namespace palpa::haptics {
namespace {

RecordedReading at(std::int64_t t_ms, double x) {
  RecordedReading r;
  r.t_ns = t_ms * 1'000'000;
  r.reading.sequence = static_cast<std::uint64_t>(t_ms + 1);
  r.reading.p_DE = {x, 0, 0};
  r.reading.homed = 1;
  return r;
}

TEST(ReplayDevice, GivesWhatTheLoopHadReadAtThatTime) {
  ReplayDevice device({}, {at(10, 0.1), at(11, 0.2), at(14, 0.3)});
  EXPECT_EQ(device.read(9'999'999).homed, 0u) << "before the recording nothing is known";
  EXPECT_EQ(device.read(10'000'000).p_DE[0], 0.1);
  EXPECT_EQ(device.read(13'900'000).p_DE[0], 0.2);
  EXPECT_EQ(device.read(14'000'000).p_DE[0], 0.3);
  EXPECT_EQ(device.read(9'000'000'000).sequence, 15u) << "after its end it stands still: silent";
  EXPECT_EQ(device.read(11'000'000).p_DE[0], 0.2) << "wound back";
}

TEST(ReplayDevice, RefusesWhatCannotBePlayed) {
  EXPECT_THROW(ReplayDevice({}, {}), UsageError);
  EXPECT_THROW(ReplayDevice({}, {at(2, 0), at(1, 0)}), UsageError);
}

}  // namespace
}  // namespace palpa::haptics

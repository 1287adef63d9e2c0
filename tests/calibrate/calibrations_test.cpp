#include "apps/station/calibrations.h"

#include <gtest/gtest.h>

#include "a_calibration.h"
#include "apps/station/assets.h"
#include "apps/station/station_file.h"

namespace palpa::station {
namespace {

using palpa::test::says;

AppliedCalibration applied(CalibrationFile file, const std::string& sha) {
  AppliedCalibration c;
  c.file = std::move(file);
  c.sha256 = c.sha256_wanted = sha;
  return c;
}

std::vector<AppliedCalibration> goodSet() {
  CalibrationFile camera = test::aCalibration();
  camera.kind = CalibrationKind::camera;
  camera.rests_on.clear();
  return {applied(camera, "abc"), applied(test::aCalibration(), "def")};
}

TEST(Calibrations, AreFaultlessWhenAllFits) {
  EXPECT_EQ(faultOf(goodSet(), "virtual-bench"), "");
  EXPECT_EQ(outdatedOn(goodSet(), "2026-03-02T00:00:00Z"), "");
}

TEST(Calibrations, TellWhatIsWrong) {
  std::vector<AppliedCalibration> set = goodSet();
  set[1].file.verdict = "the tip's uncertainty is 2 mm, at most 0.25 mm is good";
  EXPECT_TRUE(says(faultOf(set, "virtual-bench"), "tool calibration failed"));
  EXPECT_TRUE(says(faultOf(goodSet(), "another"), "belongs to station \"virtual-bench\""));
  set = goodSet();
  set[1].sha256 = "replaced";
  EXPECT_TRUE(says(faultOf(set, "virtual-bench"), "was replaced"));
  set = goodSet();
  set[0].sha256 = set[0].sha256_wanted = "a newer camera";
  EXPECT_TRUE(says(faultOf(set, "virtual-bench"), "made with another camera calibration"));
  set = {goodSet()[1]};
  EXPECT_TRUE(says(faultOf(set, "virtual-bench"), "made with another camera calibration"));
}

TEST(Calibrations, GrowOld) {
  EXPECT_EQ(outdatedOn(goodSet(), "2026-05-30T00:00:00Z"), "");
  EXPECT_TRUE(says(outdatedOn(goodSet(), "2026-05-31T00:00:00Z"),
                   "is outdated: made on 2026-03-01, good for 90 days"));
  std::vector<AppliedCalibration> set = goodSet();
  set[0].file.date = "yesterday";
  EXPECT_TRUE(says(outdatedOn(set, "2026-03-02T00:00:00Z"), "has no date"));
}

TEST(Calibrations, ChangeWhatTheStationBelievesButNotItsDesign) {
  const Station station = readStation(assetFile("stations/virtual_bench.json"));
  CalibrationFile tool = test::aCalibration();
  tool.rests_on.clear();
  const Station calibrated = withCalibrations(station, {applied(tool, "def")});
  EXPECT_EQ(calibrated.calibration_verdict, "pass");
  EXPECT_LT((calibrated.X_ET.matrix() - poseAt(tool, "X_ET").matrix()).norm(), 1e-12);
  EXPECT_EQ(calibrated.design.X_ET.matrix(), station.X_ET.matrix());
  EXPECT_EQ(calibrated.X_WD.matrix(), station.X_WD.matrix());
  Station old = calibrated;
  judgeAge(old, "2027-01-01T00:00:00Z");
  EXPECT_TRUE(says(old.calibration_verdict, "outdated"));
}

TEST(Calibrations, OfAForceSensorSetItsFilter) {
  Station station = readStation(assetFile("stations/virtual_bench.json"));
  station.force_sensor = station.design.force_sensor = ForceSensorSetup{};
  CalibrationFile sensor = test::aCalibration();
  sensor.kind = CalibrationKind::force_sensor;
  sensor.rests_on.clear();
  sensor.parameters = {{"bias_force_N", {0.1, -0.2, 0.3}},
                       {"bias_torque_Nm", {0.01, 0.02, 0.03}},
                       {"tool_mass_kg", {0.031}},
                       {"tool_centre_m", {0, 0.001, 0.05}}};
  const Station calibrated = withCalibrations(station, {applied(sensor, "abc")});
  EXPECT_EQ(calibrated.force_sensor->bias.f_S, (Packed3{0.1, -0.2, 0.3}));
  EXPECT_EQ(calibrated.force_sensor->bias.tau_S, (Packed3{0.01, 0.02, 0.03}));
  EXPECT_EQ(calibrated.force_sensor->tool.mass, 0.031);
  EXPECT_EQ(calibrated.force_sensor->tool.p_SM, (Packed3{0, 0.001, 0.05}));
  EXPECT_EQ(calibrated.design.force_sensor->tool.mass, station.force_sensor->tool.mass);
}

}  // namespace
}  // namespace palpa::station

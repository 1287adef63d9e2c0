#include "include_arrows.h"

#include <gtest/gtest.h>

namespace palpa::house {
namespace {

/// One line of code in a file of that name: how many of its includes are wrong.
std::size_t wrong(const std::string& path, const std::string& include) {
  return wrongIncludes({path, "#pragma once\n#include " + include + "\n"}).size();
}

TEST(IncludeArrows, TheTreeKeepsThem) {
  std::size_t files = 0;
  for (const SourceFile& file : sourceTree(PALPA_SOURCE_DIR)) {
    if (!file.isCode()) continue;
    ++files;
    for (const std::string& line : wrongIncludes(file)) ADD_FAILURE() << line;
  }
  EXPECT_GT(files, 200u) << "the walk has lost the tree";
}

TEST(IncludeArrows, TheTreeKeepsThemThroughOtherHeaders) {
  for (const std::string& line : wrongWays(sourceTree(PALPA_SOURCE_DIR))) ADD_FAILURE() << line;
}

TEST(IncludeArrows, PlantedLibraryIsCaught) {
  EXPECT_EQ(wrong("anatomy/base/random.h", "<Eigen/Core>"), 1u);
  EXPECT_EQ(wrong("anatomy/geometry/pose.h", "<opencv2/core.hpp>"), 1u);
  EXPECT_EQ(wrong("anatomy/patient.h", "<vtkRenderer.h>"), 1u);
  EXPECT_EQ(wrong("anatomy/import/decimate.cpp", "<vtkPolyDataMapper.h>"), 1u);
  EXPECT_EQ(wrong("haptics/loop/tick.h", "<vtkPolyData.h>"), 1u);
  EXPECT_EQ(wrong("haptics/loop/tick.cpp", "<opencv2/core.hpp>"), 1u);
  EXPECT_EQ(wrong("haptics/loop/tick.cpp", "<libusb.h>"), 1u);
  EXPECT_EQ(wrong("haptics/materials/force_laws.h", "<nlohmann/json.hpp>"), 1u);
  EXPECT_EQ(wrong("scene/overlay/hud.cpp", "<opencv2/imgproc.hpp>"), 1u);
  EXPECT_EQ(wrong("ar/boards/board.cpp", "<vtkImageData.h>"), 1u);
  EXPECT_EQ(wrong("apps/assess/needle/passes.h", "<opencv2/core.hpp>"), 1u);
  EXPECT_EQ(wrong("apps/assess/metrics/motion.h", "<boost/math/tools/roots.hpp>"), 1u);
  EXPECT_EQ(wrong("apps/os/tcp_socket.h", "<nlohmann/json.hpp>"), 1u);
  EXPECT_EQ(wrong("apps/runtime/bus.h", "<CLI/CLI.hpp>"), 1u);
  EXPECT_EQ(wrong("apps/task_needle/needle_task.cpp", "<sqlite3.h>"), 1u);
}

TEST(IncludeArrows, PlantedFolderIsCaughtInTheLibraries) {
  EXPECT_EQ(wrong("anatomy/base/json_file.h", "\"anatomy/geometry/pose.h\""), 1u);
  EXPECT_EQ(wrong("anatomy/geometry/pose.h", "\"anatomy/patient.h\""), 1u);
  EXPECT_EQ(wrong("anatomy/patient.h", "\"haptics/materials/force_laws.h\""), 1u);
  EXPECT_EQ(wrong("anatomy/shapes/spline.h", "\"anatomy/import/decimate.h\""), 1u);
  EXPECT_EQ(wrong("haptics/loop/tick.cpp", "\"anatomy/patient.h\""), 1u);
  EXPECT_EQ(wrong("haptics/loop/tick.cpp", "\"calibration/camera_model.h\""), 1u);
  EXPECT_EQ(wrong("haptics/loop/tick.cpp", "\"haptics/sensors/force_sensor.h\""), 1u);
  EXPECT_EQ(wrong("haptics/loop/tick.cpp", "\"haptics/devices/falcon/falcon_driver.h\""), 1u);
  EXPECT_EQ(wrong("haptics/materials/force_laws.cpp", "\"haptics/loop/tick.h\""), 1u);
  EXPECT_EQ(wrong("haptics/sensors/net_ft_sensor.cpp", "\"apps/runtime/clock.h\""), 1u);
  EXPECT_EQ(wrong("haptics/sensors/net_ft_sensor.cpp", "\"haptics/devices/usb_transport.h\""), 1u);
  EXPECT_EQ(wrong("calibration/camera_model.cpp", "\"ar/boards/board.h\""), 1u);
  EXPECT_EQ(wrong("ar/boards/board.cpp", "\"scene/overlay/hud.h\""), 1u);
  EXPECT_EQ(wrong("ar/boards/board.cpp", "\"haptics/materials/force_laws.h\""), 1u);
  EXPECT_EQ(wrong("scene/overlay/hud.cpp", "\"calibration/camera_model.h\""), 1u);
}

TEST(IncludeArrows, PlantedFolderIsCaughtInTheProgram) {
  EXPECT_EQ(wrong("apps/os/real_time.h", "\"apps/runtime/clock.h\""), 1u);
  EXPECT_EQ(wrong("apps/os/real_time.h", "\"anatomy/geometry/pose.h\""), 1u);
  EXPECT_EQ(wrong("apps/runtime/bus.h", "\"apps/station/station_file.h\""), 1u);
  EXPECT_EQ(wrong("apps/record/session_file.h", "\"apps/record/store/delivery.h\""), 1u);
  EXPECT_EQ(wrong("apps/assess/needle/passes.h", "\"apps/record/session_file.h\""), 1u);
  EXPECT_EQ(wrong("apps/assess/needle/passes.h", "\"apps/station/station_file.h\""), 1u);
  EXPECT_EQ(wrong("apps/report/page/html.h", "\"apps/record/session_file.h\""), 1u);
  EXPECT_EQ(wrong("apps/study/protocol.h", "\"apps/study/run/session.h\""), 1u);
  EXPECT_EQ(wrong("apps/study/analysis/series.h", "\"apps/study/protocol.h\""), 1u);
  EXPECT_EQ(wrong("apps/study/run/session.h", "\"apps/cli/commands.h\""), 1u);
  EXPECT_EQ(wrong("apps/evidence/recorded_session.h", "\"apps/session/needle_session.h\""), 1u);
  EXPECT_EQ(wrong("apps/session/needle_session.h", "\"apps/cli/commands.h\""), 1u);
  EXPECT_EQ(wrong("apps/session/needle_session.h", "\"apps/study/run/session.h\""), 1u);
  EXPECT_EQ(wrong("apps/twin/virtual_bench.h", "\"haptics/materials/force_laws.h\""), 1u);
}

TEST(IncludeArrows, TasksKnowNeitherRecordNorReportNorTwinNorEachOther) {
  for (const char* other :
       {"\"apps/record/session_file.h\"", "\"apps/report/page/html.h\"",
        "\"apps/twin/virtual_bench.h\"", "\"apps/task_search/search_task.h\"",
        "\"apps/assess/search/search_trial.h\"", "\"apps/session/needle_session.h\""})
    EXPECT_EQ(wrong("apps/task_needle/task_file.h", other), 1u) << other;
  EXPECT_EQ(wrong("apps/assess/needle/passes.h", "\"apps/assess/search/search_trial.h\""), 1u);
  for (const char* report :
       {"apps/report/comparison/comparison_report.h", "apps/report/pulse/pulse_report.h"})
    EXPECT_EQ(wrong(report, "\"apps/report/search/search_report.h\""), 1u) << report;
}

TEST(IncludeArrows, OnlyTwinBenchAndProgramSeeTheTruth) {
  const std::string truth = "\"apps/twin/virtual_bench.h\"";
  for (const char* blind :
       {"apps/task_needle/needle_task.cpp", "apps/record/session_file.cpp",
        "apps/report/page/html.cpp", "apps/runtime/bus.h", "apps/station/station_file.cpp",
        "apps/assess/needle/passes.cpp", "apps/study/protocol.cpp", "apps/study/run/session.cpp",
        "apps/evidence/recorded_session.cpp", "apps/calibrate/recorded.cpp",
        "apps/doctor/station_check.cpp", "apps/console/place.cpp", "apps/live/port.cpp"})
    EXPECT_EQ(wrong(blind, truth), 1u) << blind;
  for (const char* seeing : {"apps/twin/operator.cpp", "apps/bench/loop_bench.cpp",
                             "apps/session/needle_session.h", "apps/bench/setup_accuracy.h"})
    EXPECT_EQ(wrong(seeing, truth), 0u) << seeing;
}

TEST(IncludeArrows, WhatIsAllowedPasses) {
  EXPECT_EQ(wrong("haptics/loop/tick.h", "\"anatomy/geometry/pose.h\""), 0u);
  EXPECT_EQ(wrong("haptics/loop/tick.h", "<cstdint>"), 0u);
  EXPECT_EQ(wrong("haptics/sensors/wrench_filter.h", "\"haptics/device.h\""), 0u);
  EXPECT_EQ(wrong("haptics/devices/falcon/falcon_driver.h", "\"haptics/device.h\""), 0u);
  EXPECT_EQ(wrong("haptics/devices/usb_transport.cpp", "<libusb.h>"), 0u);
  EXPECT_EQ(wrong("anatomy/import/decimate.cpp", "<vtkPolyData.h>"), 0u);
  EXPECT_EQ(wrong("anatomy/base/sha256.cpp", "<openssl/evp.h>"), 0u);
  EXPECT_EQ(wrong("apps/task_needle/task_file.h", "\"apps/task_needle/needle_task.h\""), 0u);
  EXPECT_EQ(wrong("apps/task_needle/task_file.h", "\"apps/assess/needle/passes.h\""), 0u);
  EXPECT_EQ(wrong("apps/report/study/study_report.h", "\"apps/study/analysis/exhibit.h\""), 0u);
  EXPECT_EQ(wrong("tests/haptics/tick_test.cpp", "\"apps/twin/operator.h\""), 0u);
}

TEST(IncludeArrows, WaysThroughOthersAreFound) {
  const SourceFile bus{"apps/runtime/bus.h", "#include \"apps/trial/scene.h\"\n"};
  const SourceFile trial{"apps/trial/scene.h", "#include \"apps/twin/hand.h\"\n"};
  const SourceFile twin{"apps/twin/hand.h", "#include <vector>\n"};
  ASSERT_EQ(wrongWays({bus, trial, twin}).size(), 1u);
  EXPECT_EQ(wrongWays({bus, trial, twin})[0],
            "apps/runtime/bus.h gets apps/twin/hand.h through apps/trial/scene.h");

  const SourceFile tick{"haptics/loop/tick.h", "#include \"anatomy/base/json_file.h\"\n"};
  const SourceFile json{"anatomy/base/json_file.h", "#include <nlohmann/json.hpp>\n"};
  ASSERT_EQ(wrongWays({tick, json}).size(), 1u);
  EXPECT_EQ(wrongWays({tick, json})[0],
            "haptics/loop/tick.h gets JSON through anatomy/base/json_file.h");
}

TEST(IncludeArrows, CommentsDoNotCountAndSpacesDoNotHide) {
  EXPECT_TRUE(
      wrongIncludes({"haptics/a.h", "// #include <vtkRenderer.h>\n/* #include <CLI/CLI.hpp>\n*/"})
          .empty());
  EXPECT_EQ(wrongIncludes({"haptics/a.h", "  #  include   <vtkRenderer.h>"}).size(), 1u);
  EXPECT_EQ(wrongIncludes({"haptics/a.h", "/* x */ #include <vtkRenderer.h>"}).size(), 1u);
}

}  // namespace
}  // namespace palpa::house

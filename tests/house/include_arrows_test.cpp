#include "include_arrows.h"

#include <gtest/gtest.h>

#include <set>

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

TEST(IncludeArrows, EveryLayerIsReal) {
  std::set<std::string> seen;
  for (const SourceFile& file : sourceTree(PALPA_SOURCE_DIR))
    for (const Layer& layer : layers())
      if (file.path.rfind(layer.folder.substr(0, layer.folder.find('*')), 0) == 0)
        seen.insert(layer.folder);
  seen.insert("apps/bench");  // measurements: allowed to come later
  for (const Layer& layer : layers()) EXPECT_TRUE(seen.count(layer.folder)) << layer.folder;
}

TEST(IncludeArrows, PlantedLibraryIsCaught) {
  EXPECT_EQ(wrong("anatomy/geometry/pose.h", "<opencv2/core.hpp>"), 1u);
  EXPECT_EQ(wrong("anatomy/patient.h", "<vtkRenderer.h>"), 1u);
  EXPECT_EQ(wrong("anatomy/patient.h", "<vtkPolyDataMapper.h>"), 1u);
  EXPECT_EQ(wrong("haptics/tick.h", "<vtkPolyData.h>"), 1u);
  EXPECT_EQ(wrong("haptics/tick.cpp", "<opencv2/core.hpp>"), 1u);
  EXPECT_EQ(wrong("haptics/materials/skin_law.h", "<nlohmann/json.hpp>"), 1u);
  EXPECT_EQ(wrong("haptics/tick.cpp", "<libusb.h>"), 1u);
  EXPECT_EQ(wrong("scene/hud.cpp", "<opencv2/imgproc.hpp>"), 1u);
  EXPECT_EQ(wrong("ar/board.cpp", "<vtkImageData.h>"), 1u);
  EXPECT_EQ(wrong("apps/assess/passes.h", "<opencv2/core.hpp>"), 1u);
  EXPECT_EQ(wrong("apps/runtime/bus.h", "<CLI/CLI.hpp>"), 1u);
  EXPECT_EQ(wrong("apps/task_needle/needle_task.cpp", "<sqlite3.h>"), 1u);
}

TEST(IncludeArrows, PlantedFolderIsCaught) {
  EXPECT_EQ(wrong("anatomy/geometry/pose.h", "\"anatomy/patient.h\""), 1u);
  EXPECT_EQ(wrong("anatomy/patient.h", "\"haptics/materials/skin_law.h\""), 1u);
  EXPECT_EQ(wrong("haptics/tick.cpp", "\"anatomy/patient.h\""), 1u);
  EXPECT_EQ(wrong("haptics/tick.cpp", "\"calibration/camera_model.h\""), 1u);
  EXPECT_EQ(wrong("haptics/materials/skin_law.cpp", "\"haptics/tick.h\""), 1u);
  EXPECT_EQ(wrong("haptics/tick.cpp", "\"haptics/sensors/force_sensor.h\""), 1u);
  EXPECT_EQ(wrong("haptics/sensors/net_ft_sensor.cpp", "\"apps/runtime/clock.h\""), 1u);
  EXPECT_EQ(wrong("haptics/tick.cpp", "\"haptics/devices/falcon_driver.h\""), 1u);
  EXPECT_EQ(wrong("calibration/camera_model.cpp", "\"ar/board.h\""), 1u);
  EXPECT_EQ(wrong("ar/board.cpp", "\"scene/hud.h\""), 1u);
  EXPECT_EQ(wrong("ar/board.cpp", "\"haptics/materials/skin_law.h\""), 1u);
  EXPECT_EQ(wrong("scene/hud.cpp", "\"calibration/camera_model.h\""), 1u);
  EXPECT_EQ(wrong("apps/runtime/bus.h", "\"apps/station/json_file.h\""), 1u);
  EXPECT_EQ(wrong("apps/assess/passes.h", "\"apps/record/uuid.h\""), 1u);
  EXPECT_EQ(wrong("apps/assess/passes.h", "\"apps/station/json_file.h\""), 1u);
  EXPECT_EQ(wrong("apps/task_needle/task_file.h", "\"apps/task_search/search.h\""), 1u);
  EXPECT_EQ(wrong("apps/task_needle/task_file.h", "\"apps/report/html.h\""), 1u);
}

TEST(IncludeArrows, OnlyTwinBenchAndProgramSeeTheTruth) {
  const std::string truth = "\"apps/twin/virtual_bench.h\"";
  for (const char* blind :
       {"apps/task_needle/needle_task.cpp", "apps/record/uuid.cpp", "apps/report/html.cpp",
        "apps/runtime/bus.h", "apps/station/station_file.cpp", "apps/assess/passes.cpp",
        "apps/study/cohort.cpp", "apps/console/page.cpp"})
    EXPECT_EQ(wrong(blind, truth), 1u) << blind;
  for (const char* seeing :
       {"apps/twin/operator.cpp", "apps/bench/loop.cpp", "apps/cli/needle_session.h"})
    EXPECT_EQ(wrong(seeing, truth), 0u) << seeing;
}

TEST(IncludeArrows, WhatIsAllowedPasses) {
  EXPECT_EQ(wrong("haptics/tick.h", "\"anatomy/geometry/pose.h\""), 0u);
  EXPECT_EQ(wrong("haptics/tick.h", "<cstdint>"), 0u);
  EXPECT_EQ(wrong("haptics/sensors/wrench_filter.h", "\"haptics/device.h\""), 0u);
  EXPECT_EQ(wrong("haptics/devices/falcon_driver.h", "\"haptics/device.h\""), 0u);
  EXPECT_EQ(wrong("haptics/devices/libusb_transport.cpp", "<libusb.h>"), 0u);
  EXPECT_EQ(wrong("anatomy/patient.cpp", "<vtkPolyData.h>"), 0u);
  EXPECT_EQ(wrong("apps/task_needle/task_file.h", "\"apps/task_needle/task_status.h\""), 0u);
  EXPECT_EQ(wrong("tests/haptics/tick_test.cpp", "\"apps/twin/operator.h\""), 0u);
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

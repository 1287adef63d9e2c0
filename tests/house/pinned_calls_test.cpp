#include <gtest/gtest.h>

#include <algorithm>
#include <regex>

#include "source_tree.h"

namespace palpa::house {
namespace {

/// What a replay computes again, and what judges: the same bits on every computer, so no function
/// of the C library that is rounded by the processor's taste. Statistics of a study are no evidence
/// and may ask a library; so may a driver, whose readings are recorded.
bool isPinned(const std::string& path) {
  const auto within = [&](std::initializer_list<const char*> places) {
    return std::any_of(places.begin(), places.end(),
                       [&](const char* place) { return path.rfind(place, 0) == 0; });
  };
  return within({"haptics/", "anatomy/geometry/", "anatomy/query/", "anatomy/shapes/",
                 "anatomy/patient", "anatomy/base/random.h", "calibration/expert_path",
                 "apps/assess/", "apps/task_", "apps/evidence/"}) &&
         !within({"haptics/devices/", "apps/assess/statistics/"});
}

/// Names of <cmath>, and what Eigen and OpenCV make of them.
std::vector<std::string> unpinnedCalls(const SourceFile& file) {
  static const std::regex kCall(
      "(^|[^A-Za-z0-9_:.>])(std::|::)?"
      "((exp|exp2|expm1|log|log2|log10|log1p|pow|cbrt|hypot|sin|cos|tan|asin|acos|atan|atan2|sinh|"
      "cosh|tanh|asinh|acosh|atanh|erf|erfc|tgamma|lgamma)[fl]?)\\("
      "|AngleAxis|Rotation2D|\\bslerp\\(|angularDistance|eulerAngles|computeDirect|Eigen/FFT|"
      "std::(polar|arg)\\(");
  std::vector<std::string> found;
  if (!file.isProduct() || !isPinned(file.path)) return found;
  const std::string code = withoutComments(file.text);
  for (std::sregex_iterator at(code.begin(), code.end(), kCall), end; at != end; ++at)
    found.push_back(file.path + " calls" + at->str() + ": anatomy/base/pinned_math.h has it");
  return found;
}

std::size_t unpinnedIn(const std::string& path, const std::string& code) {
  return unpinnedCalls({path, code}).size();
}

TEST(PinnedCalls, EvidenceAsksNoOtherFunctions) {
  std::size_t files = 0;
  for (const SourceFile& file : sourceTree(PALPA_SOURCE_DIR)) {
    files += file.isProduct() && isPinned(file.path);
    for (const std::string& line : unpinnedCalls(file)) ADD_FAILURE() << line;
  }
  EXPECT_GT(files, 150u) << "the folders have moved";
}

TEST(PinnedCalls, APlantedOneIsCaught) {
  for (const char* code :
       {"x = std::exp(y);", "x = exp(y);", "x = ::pow(y, 2);", "f(sinf(y));", "x = -atan2(y, x);",
        "Eigen::AngleAxisd(a, v)", "a.slerp(t, b)", "std::polar(1.0, t)", "return hypot(x, y);"})
    EXPECT_EQ(unpinnedIn("haptics/loop/a.cpp", code), 1u) << code;
}

TEST(PinnedCalls, OursAndThoseOfOtherFoldersAreFree) {
  for (const char* code : {"x = pinned::exp(y);", "x = std::sqrt(y);", "log.pow(2)",
                           "// std::exp(x)", "phase_sin(x)", "std::fmod(x, y)", "a->log(x)"})
    EXPECT_EQ(unpinnedIn("apps/assess/a.cpp", code), 0u) << code;
  for (const char* path : {"haptics/devices/a.cpp", "apps/assess/statistics/a.cpp", "scene/a.cpp",
                           "calibration/hand_eye.cpp", "tests/haptics/a.cpp"})
    EXPECT_EQ(unpinnedIn(path, "x = std::exp(y);"), 0u) << path;
}

}  // namespace
}  // namespace palpa::house

#pragma once

#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>

namespace palpa::test {

/// A folder of its own in the build folder, empty at the start of the test: of this test, since
/// tests run side by side. `suite`: the test's folder.
inline std::filesystem::path freshFolder(const std::string& suite, const std::string& name) {
  const testing::TestInfo* test = testing::UnitTest::GetInstance()->current_test_info();
  std::string whose = test ? std::string(test->test_suite_name()) + "." + test->name()
                           : "process-" + std::to_string(::getpid());
  std::replace(whose.begin(), whose.end(), '/', '-');  // of tests with parameters
  auto folder = std::filesystem::path(PALPA_BUILD_DIR) / "tests" / suite / "tmp" / whose / name;
  std::filesystem::remove_all(folder);
  std::filesystem::create_directories(folder);
  return folder;
}

inline std::string slurp(const std::filesystem::path& file) {
  std::ifstream stream(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(stream), {}};
}

}  // namespace palpa::test

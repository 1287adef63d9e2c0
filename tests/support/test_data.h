#pragma once

#include <cstdlib>
#include <filesystem>
#include <string>

/// Optional real pictures and anatomy: PALPA_TEST_DATA, else ../shared/data beside the checkout.
/// They are not part of the project; a test that needs one is skipped, with the reason, without it.
inline std::filesystem::path testData(const std::string& relative) {
  const char* given = std::getenv("PALPA_TEST_DATA");
  const std::filesystem::path root =
      given ? std::filesystem::path(given)
            : std::filesystem::path(PALPA_SOURCE_DIR) / ".." / "shared" / "data";
  return root / relative;
}

#define PALPA_NEED_DATA(path)         \
  if (!std::filesystem::exists(path)) \
  GTEST_SKIP() << "no real data at " << (path) << " (set PALPA_TEST_DATA to use it)"

#pragma once

#include <gtest/gtest.h>

#include <string>

#include "anatomy/base/error.h"

namespace palpa::test {

/// What an estimator says that cannot tell the answer, or anybody who refuses; empty where there is
/// one.
template <class F>
std::string complaint(F f) {
  try {
    f();
  } catch (const Error& error) {
    std::string words = error.what();
    EXPECT_EQ(words.find('\n'), std::string::npos) << words;
    return words;
  }
  return "";
}

inline bool says(const std::string& text, const std::string& words) {
  return text.find(words) != std::string::npos;
}

}  // namespace palpa::test

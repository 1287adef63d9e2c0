#pragma once

#include <gtest/gtest.h>

#include "apps/doctor/finding.h"
#include "apps/station/assets.h"
#include "apps/station/station_file.h"

/// Each fault that a station can have is put before the doctor's judges, and named; a healthy bench
/// is called well. Faults from outside: tests/cli/doctor_faults_test.cpp.
namespace palpa::doctor {

inline const station::Station& benchStation() {
  static const station::Station station =
      station::readStation(station::assetFile("stations/virtual_bench.json"));
  return station;
}

inline void expectSays(const Finding& finding, State state, const std::string& words) {
  EXPECT_EQ(finding.state, state) << finding.subject << ": " << finding.verdict;
  EXPECT_NE(finding.verdict.find(words), std::string::npos) << finding.verdict;
  EXPECT_EQ(finding.fix.empty(), state == State::well || state == State::absent) << finding.subject;
}

}  // namespace palpa::doctor

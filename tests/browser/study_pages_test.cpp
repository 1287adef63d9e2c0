#include <gtest/gtest.h>

#include "apps/report/study/study_report.h"
#include "tests/browser/page_faults.h"
#include "tests/report/synthetic_study.h"
#include "tests/support/files.h"

namespace palpa::report {
namespace {

/// Pages of both published studies and their tables, as a browser shows them.
TEST(StudyPages, HaveNoFaults) {
  if (const std::string why = palpa::test::Browser::whyNot(); !why.empty()) GTEST_SKIP() << why;
  palpa::test::Browser browser;
  const auto folder = palpa::test::freshFolder("browser", "studies");
  for (const auto& [name, result] : {std::pair{"pilot.html", test::pilotResult()},
                                     std::pair{"search.html", test::searchResult()}}) {
    writeStudyReport({result, {{"Protocol", "protocol.json", ""}}}, folder / name);
    for (const std::string& fault : palpa::test::faultsOf(browser, folder / name))
      ADD_FAILURE() << fault;
  }
}

}  // namespace
}  // namespace palpa::report

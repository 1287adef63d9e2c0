#pragma once

#include <gtest/gtest.h>

#include <cstdio>
#include <cstdlib>
#include <string>

#include "program.h"

/// The guide's scripts that check an export, run as a reader runs them.
namespace palpa::cli_test {

inline bool pythonIsThere() { return std::system("python3 --version > /dev/null 2>&1") == 0; }

struct ScriptVerdict {
  int ticks = 0;
  double worst_mN = 1e9;
  std::string said;
};

/// Of ticks.csv in this folder, of its first `rows`, by docs/`script`.
inline ScriptVerdict checkedBy(const std::string& script, const Folder& here, int rows) {
  const std::string run = "cd '" + here.path().string() + "' && head -n " +
                          std::to_string(rows + 1) + " ticks.csv > some.csv && cp " +
                          "ticks.laws.json some.laws.json && python3 '" + PALPA_SOURCE_DIR +
                          "/docs/" + script + "' some.csv > said.txt 2>&1";
  ScriptVerdict verdict;
  const int code = std::system(run.c_str());
  verdict.said = contentOf(here / "said.txt");
  EXPECT_EQ(code, 0) << verdict.said;
  EXPECT_EQ(std::sscanf(verdict.said.c_str(), "%d ticks, at most %lf mN", &verdict.ticks,
                        &verdict.worst_mN),
            2)
      << verdict.said;
  return verdict;
}

}  // namespace palpa::cli_test

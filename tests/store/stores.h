#pragma once

#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <memory>
#include <string>

#include "apps/record/store/record_store.h"
#include "tests/store/postgres_server.h"
#include "tests/store/trials.h"
#include "tests/support/files.h"

namespace palpa::record {

/// The same tests on both kinds of store.
class Store : public testing::TestWithParam<const char*> {
 protected:
  static bool onServer() { return std::string(GetParam()) == "PostgreSQL"; }

  void SetUp() override {
    std::string name = testing::UnitTest::GetInstance()->current_test_info()->name();
    for (char& c : name)
      if (c == '/') c = '_';
    folder = test::freshFolder("store", name);
    ::setenv("XDG_STATE_HOME", (folder / "state").c_str(), 1);  // where deletions are kept
    url = (folder / "records.sqlite").string();
    if (!onServer()) return;
    if (const std::string why = test::PostgresServer::whyNot(); !why.empty()) GTEST_SKIP() << why;
    static test::PostgresServer
        shared;  // seconds to make: one for the tests of a process, a database for each
    server = &shared;
    url = server->freshDatabase();
  }

  std::filesystem::path folder;
  test::PostgresServer* server = nullptr;  ///< null on SQLite
  std::string url;
};

}  // namespace palpa::record

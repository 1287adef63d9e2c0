#include "apps/session/output_folder.h"

#include <gtest/gtest.h>
#include <sys/stat.h>

#include <fstream>

#include "apps/record/session_file.h"
#include "tests/support/files.h"
#include "tests/support/setting.h"

namespace palpa::session {
namespace {

namespace fs = std::filesystem;

fs::path folderFor(const std::string& name) { return test::freshFolder("session", name); }

bool isEmpty(const fs::path& folder) { return fs::is_empty(folder); }

TEST(OutputFolder, WhatIsMadeIsItsOwnersAlone_WhatIsGivenStays) {
  const fs::path here = folderFor("rights");
  const mode_t mask = ::umask(022);
  fs::create_directory(here / "given");
  const fs::perms before = fs::status(here / "given").permissions();
  makeOutputFolder((here / "given").string(), "x");
  makeOutputFolder((here / "given/made/deeper").string(), "x");
  ::umask(mask);
  EXPECT_EQ(fs::status(here / "given").permissions(), before);
  for (const char* made : {"given/made", "given/made/deeper"})
    EXPECT_EQ(fs::status(here / made).permissions(), fs::perms::owner_all) << made;
  EXPECT_TRUE(isEmpty(here / "given/made/deeper")) << "the proof that it can be written to is left";
}

TEST(OutputFolder, OfACommandThatFailsNothingIsLeft) {
  const fs::path here = folderFor("failed");
  std::ofstream(here / "older") << "stays";
  for (const char* out : {"new/deep", "."}) {
    OutputFolder output((here / out).string(), "x");
    writeWhole(output.path() / "a.csv", "half of it", Lasts::no);
  }
  EXPECT_TRUE(fs::exists(here / "older"));
  fs::remove(here / "older");
  EXPECT_TRUE(isEmpty(here));
  {
    OutputFolder output((here / "kept").string(), "x");
    writeWhole(output.path() / "a.csv", "all of it", Lasts::no);
    output.keep();
  }
  EXPECT_TRUE(fs::exists(here / "kept/a.csv"));
}

record::SessionInfo plainInfo() {
  record::SessionInfo info;
  info.session_json = info.station_json = info.task_json = "{}";
  return info;
}

/// Nothing was felt or done in the first; in the second something was.
TEST(OutputFolder, EvidenceStaysOnceItHoldsATick) {
  const fs::path here = folderFor("evidence");
  const test::Setting state("XDG_STATE_HOME", here.c_str());
  {
    const OutputFolder output((here / "none").string(), "x");
    record::SessionWriter(output.path() / "session.palpa", plainInfo()).close();
  }
  EXPECT_FALSE(fs::exists(here / "none"));
  const auto fails = [&] {
    const OutputFolder output((here / "some").string(), "x");
    record::SessionWriter writer(output.path() / "session.palpa", plainInfo());
    writer.tick(haptics::FlightRecord{});
    writeWhole(output.path() / "view.png", "seen", Lasts::no);
  };
  fails();
  EXPECT_TRUE(fs::exists(here / "some/session.palpa"));
  EXPECT_TRUE(fs::exists(here / "some/view.png"));
  fs::create_directory(here / "older");
  record::SessionWriter(here / "older/session.palpa", plainInfo()).close();
  { const OutputFolder output((here / "older").string(), "x"); }
  EXPECT_TRUE(fs::exists(here / "older/session.palpa")) << "another session's";
}

}  // namespace
}  // namespace palpa::session

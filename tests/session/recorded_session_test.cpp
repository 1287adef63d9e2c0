#include "apps/evidence/recorded_session.h"

#include <gtest/gtest.h>

#include "anatomy/parametric/phantoms.h"
#include "anatomy/patient/patient_file.h"
#include "apps/station/assets.h"
#include "tests/record/synthetic_session.h"
#include "tests/support/setting.h"

/// A session is read from its one file, and says which part of it is damaged.
namespace palpa::evidence {
namespace {

namespace fs = std::filesystem;

class DamagedSession : public ::testing::Test {
 protected:
  /// Of a task without an expert path, at a block.
  DamagedSession() : info(record::test::syntheticInfo()) {
    info.session_json = R"({"X_DA": {"p_m": [0, 0, 0], "q_wxyz": [1, 0, 0, 0]},)"
                        R"( "simulated": true, "operator": "expert"})";
    info.task_json = task_needle::readTask(station::assetFile("tasks/bone_pin.json")).source;
    info.patient_glb = anatomy::glbOf(anatomy::phantomBlock({0.1, 0.1, 0.05}, "bone"), "the block");
    info.expert_path_json.clear();
  }

  /// What reading says against it; empty: nothing.
  std::string complaint() const {
    fs::remove(file);
    record::SessionWriter(file, info).close();
    try {
      const RecordedSession session(file);
    } catch (const Error& error) {
      return error.what();
    }
    return {};
  }
  std::string partNamed(const std::string& part) const { return file.string() + ", its " + part; }

  record::SessionInfo info;
  const fs::path file = test::freshFolder("session", "damaged") / "session.palpa";
};

TEST_F(DamagedSession, NamesTheFileAndThePart) {
  ASSERT_EQ(complaint(), "");
  const record::SessionInfo whole = info;
  info.patient_glb.resize(info.patient_glb.size() / 2);
  EXPECT_EQ(complaint().rfind(partNamed("patient: "), 0), 0u) << complaint();
  info = whole;
  info.task_json.resize(info.task_json.size() / 2);
  EXPECT_EQ(complaint().rfind(partNamed("task: "), 0), 0u) << complaint();
  info = whole;
  info.expert_path_json = "{}";
  EXPECT_EQ(complaint().rfind(partNamed("expert path: field \"format\" is missing"), 0), 0u)
      << complaint();
}

TEST_F(DamagedSession, NeedsNoPlaceForTemporaryFiles) {
  const test::Setting nowhere("TMPDIR", "/nowhere");
  EXPECT_EQ(complaint(), "");
}

}  // namespace
}  // namespace palpa::evidence

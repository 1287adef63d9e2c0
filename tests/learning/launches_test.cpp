#include "apps/learning/launches.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>

#include "anatomy/base/uuid.h"
#include "anatomy/base/whole_file.h"
#include "apps/os/file_access.h"
#include "tests/support/files.h"

namespace palpa::learning {
namespace {

namespace fs = std::filesystem;

Launch one(const std::string& trainee, const std::string& session = "s") {
  Launch launch;
  launch.id = newUuid();
  launch.platform = "campus";
  launch.trainee = trainee;
  launch.token = "a secret";
  launch.cmi5 = {.launch = launch.id,
                 .actor = nlohmann::json::object(),
                 .context = {{"extensions", {{kSessionId, session}}}},
                 .activity = "https://lms.example/4",
                 .registration = "5f2d6f8e-6e6d-4d3f-9a3c-2b1f0c9d8e7a"};
  launch.due = {{{"id", "1"}}};
  return launch;
}

TEST(Launches, AreKeptForTheirOwnerUntilTheyAreDone) {
  const fs::path folder = test::freshFolder("learning", "kept");
  Launches kept(folder);
  Launch launch = one("learner-1");
  kept.keep(launch);
  const fs::path file = folder / (launch.id + ".json");
  EXPECT_EQ(os::privacyOf(file), os::Privacy::own);
  ASSERT_EQ(Launches(folder).notDone().size(), 1u) << "after a restart, too";
  EXPECT_EQ(kept.find(launch.id)->token, "a secret");
  launch.over = true;
  launch.due.clear();
  kept.keep(launch);
  EXPECT_TRUE(kept.notDone().empty());
  EXPECT_EQ(readWhole(file)->find("a secret"), std::string::npos);
  EXPECT_FALSE(kept.find("../settings"));
}

TEST(Launches, OfOnePlatformSessionComeOnceAndRememberWhatWasTold) {
  Launches kept(test::freshFolder("learning", "told"));
  Launch first = one("learner-1");
  first.told = {.completed = true, .passed = false};
  kept.keep(first);
  EXPECT_TRUE(kept.has(one("learner-1").cmi5));
  const Launch second = one("learner-1", "another");
  EXPECT_FALSE(kept.has(second.cmi5));
  EXPECT_TRUE(kept.toldOf(second.cmi5).completed);
  EXPECT_FALSE(kept.toldOf(second.cmi5).passed);
}

TEST(Launches, GoWithTheirTrainee) {
  Launches kept(test::freshFolder("learning", "gone"));
  const Launch stays = one("learner-2");
  kept.keep(one("learner-1"));
  kept.keep(one("learner-1"));
  kept.keep(stays);
  EXPECT_EQ(kept.forget("learner-1"), 2);
  EXPECT_EQ(kept.forget("learner-1"), 0);
  EXPECT_TRUE(kept.find(stays.id));
}

TEST(Launches, ThatAreDamagedHoldUpNoOther) {
  const fs::path folder = test::freshFolder("learning", "damaged");
  Launches kept(folder);
  kept.keep(one("learner-1"));
  std::ofstream(folder / "half.json") << "{\"kind\": ";
  std::ofstream(folder / "other.json") << "{}";
  EXPECT_EQ(kept.notDone().size(), 1u);
}

}  // namespace
}  // namespace palpa::learning

#include "apps/record/store/delivery.h"

#include <fstream>

#include "apps/runtime/clock.h"
#include "tests/store/stores.h"

namespace palpa::record {
namespace {

class Delivery : public Store {};
INSTANTIATE_TEST_SUITE_P(Server, Delivery, testing::Values("PostgreSQL"),
                         [](const auto& p) { return std::string(p.param); });

TEST_P(Delivery, GivesUpInTheEndAndSaysThatNothingIsLost) {
  constexpr int kTrials = 25;
  std::vector<StoredTrial> trials;
  for (int i = 1; i <= kTrials; ++i) trials.push_back(trialOf(i, i));
  RecordStore(url).addTrainee(novice("T0"));
  server->kill();
  try {
    deliver(url, sessionOf("T0", "session-0"), trials, {2, runtime::kMillisecond});
    ADD_FAILURE() << "delivered to nobody";
  } catch (const StoreUnreachable& e) {
    EXPECT_NE(std::string(e.what()).find("kept on this station and sent later"), std::string::npos)
        << e.what();
  }
  server->start();
  EXPECT_EQ(deliver(url, sessionOf("T0", "session-0"), trials).added, kTrials);
  EXPECT_EQ(deliver(url, sessionOf("T0", "session-0"), trials).present, kTrials);
}

TEST(Pending, OutlivesTheProcess) {
  const auto folder = test::freshFolder("store", "pending") / "deep/pending";
  EXPECT_TRUE(PendingList(folder).sessions().empty());
  PendingList(folder).note({"b", "/x/b/session.palpa", "postgresql://host/db"});
  PendingList(folder).note({"a", "/x/a/session.palpa", "/r.sqlite"});
  PendingList(folder).note({"a", "/x/a/session.palpa", "/r.sqlite"});
  std::ofstream(folder / "torn.pending") << "";
  std::ofstream(folder / "other.txt") << "x\ny\n";
  const auto sessions = PendingList(folder).sessions();
  ASSERT_EQ(sessions.size(), 2u);
  EXPECT_EQ(sessions[0].uuid, "a");
  EXPECT_EQ(sessions[1].url, "postgresql://host/db");
  PendingList(folder).forget("a");
  PendingList(folder).forget("never noted");
  EXPECT_EQ(PendingList(folder).sessions().size(), 1u);
}

TEST(Pending, OfASessionThatGoesOnIsLeftAlone) {
  PendingList list(test::freshFolder("store", "held"));
  list.note({"a", "/x/a/session.palpa", "/r.sqlite"});
  EXPECT_FALSE(list.isHeld("a"));
  auto hold = list.hold("a");
  EXPECT_TRUE(list.isHeld("a"));
  hold.reset();
  EXPECT_FALSE(list.isHeld("a"));
  EXPECT_FALSE(list.isHeld("never noted"));
}

}  // namespace
}  // namespace palpa::record

// From the records to a learning record store, whatever happens in between: every statement there
// exactly once.
#include "apps/link/outbox.h"

#include <gtest/gtest.h>
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <fstream>

#include "anatomy/base/random.h"
#include "anatomy/base/uuid.h"
#include "apps/link/statement.h"
#include "apps/runtime/clock.h"
#include "tests/link/loopback_lrs.h"
#include "tests/link/trials.h"
#include "tests/support/counts.h"
#include "tests/support/files.h"

namespace palpa::link_test {
namespace {

constexpr link::Pace kQuick{12, 1'000'000};

class Tell : public testing::Test {
 protected:
  void SetUp() override {
    folder_ =
        test::freshFolder("link", testing::UnitTest::GetInstance()->current_test_info()->name());
    ::setenv("XDG_STATE_HOME", (folder_ / "state").c_str(), 1);  // where deletions are kept
    store_ = std::make_unique<record::RecordStore>((folder_ / "records.sqlite").string());
    for (const char* id : {"A", "B"}) store_->addTrainee(person(id));
    for (int i = 1; i <= kTrials / 2; ++i)
      store_->addTrial(sessionOf("A", 1), trialOf(i)),
          store_->addTrial(sessionOf("B", 2), trialOf(i));
    lrs_.start();
  }

  link::Route route() const { return {lrs_.url(), "records"}; }
  link::Queued queue(bool simulated = false) {
    return link::queueTrials(*store_, route(),
                             {store_->trainees(), simulated, "https://centre.example"}, *outbox());
  }
  std::unique_ptr<link::Outbox> outbox() const {
    return std::make_unique<link::Outbox>(folder_ / "state/xapi.sqlite");
  }

  link::Sent send(const link::Pace& pace = kQuick,
                  const link::Login& login = {"teacher", "secret"}) const {
    const link::Endpoint endpoint = link::endpointOf(lrs_.url(), false);
    link::LrsClient client(endpoint, login, {1, 1});
    return link::sendWaiting(*outbox(), endpoint, client, pace);
  }

  void expectAllOnce(std::size_t count = kTrials) const {
    const auto stored = lrs_.stored();
    EXPECT_EQ(stored.size(), count);
    for (const auto& [id, s] : stored) EXPECT_EQ(s.times, 1) << id;
    EXPECT_TRUE(lrs_.complaints().empty()) << lrs_.complaints().front();
    EXPECT_TRUE(outbox()->waiting(lrs_.url()).empty());
  }

  pid_t startSender() const {
    const pid_t child = ::fork();
    if (child != 0) return child;
    const std::string file = (folder_ / "state/xapi.sqlite").string(), url = lrs_.url();
    ::execl(PALPA_SENDER, PALPA_SENDER, file.c_str(), url.c_str(), nullptr);
    ::_exit(127);
  }

  static constexpr int kTrials = 20;
  std::filesystem::path folder_;
  std::unique_ptr<record::RecordStore> store_;
  LoopbackLrs lrs_;
};

TEST_F(Tell, EveryTrialOnceHoweverOften) {
  EXPECT_EQ(queue().added, kTrials);
  EXPECT_EQ(send().delivered, kTrials);
  EXPECT_EQ(queue().known, kTrials);
  EXPECT_EQ(send().delivered, 0);
  EXPECT_EQ(lrs_.puts(), kTrials);
  expectAllOnce();
  EXPECT_TRUE(lrs_.stored().contains(link::statementId(uuidOf(2), 7)));
}

TEST_F(Tell, ALostStateTellsAgainAndNothingIsThereTwice) {
  queue();
  send();
  std::filesystem::remove_all(folder_ / "state");
  queue();
  EXPECT_EQ(send().delivered, kTrials);  // 204 again
  std::filesystem::remove_all(folder_ / "state");
  lrs_.conflicts_on_same = true;
  queue();
  const link::Sent again = send();
  EXPECT_EQ(again.delivered, 0);
  EXPECT_EQ(again.present, kTrials);  // 409, and the same when read
  expectAllOnce();
}

TEST_F(Tell, OfflineItWaits) {
  lrs_.stop();
  queue();
  const link::Sent sent = send({2, 1'000'000});
  EXPECT_EQ(sent.delivered, 0);
  EXPECT_EQ(sent.left, static_cast<std::size_t>(kTrials));
  EXPECT_EQ(sent.trouble, "nobody answers there");
  lrs_.start();
  EXPECT_EQ(send().delivered, kTrials);
  expectAllOnce();
}

TEST_F(Tell, MishapsOfEveryKind) {
  using enum Mishap;
  lrs_.stop();
  RandomStream dice(7, "mishaps");
  std::vector<Mishap> plan;
  for (int i = 0; i < 40; ++i)
    plan.push_back(std::vector<Mishap>{none, drop_before, drop_after, error_500, login_page,
                                       unlike_an_lrs,
                                       too_many}[static_cast<std::size_t>(dice.uniform() * 7)]);
  plan[4] = slow;
  lrs_.mishap = [plan](int n) {
    return n < static_cast<int>(plan.size()) ? plan[static_cast<std::size_t>(n)] : none;
  };
  lrs_.start();
  queue();
  const link::Sent sent = send();
  EXPECT_EQ(sent.trouble, "");
  EXPECT_EQ(sent.delivered + sent.present, kTrials);
  EXPECT_GT(lrs_.puts(), kTrials + 10);
  expectAllOnce();
}

TEST_F(Tell, KilledSendersAndAServerThatComesAndGoes) {
  RandomStream dice(11, "kills");
  lrs_.stop();
  lrs_.mishap = [](int) {
    runtime::SteadyClock().sleepUntil(4 * runtime::kMillisecond);  // so that kills fall in between
    return Mishap::none;
  };
  lrs_.start();
  queue();
  const int kills = test::counted(6, 40);
  for (int i = 0; i < kills; ++i) {
    const int before = lrs_.puts();
    const pid_t sender = startSender();
    const runtime::SteadyClock waited;
    while (lrs_.puts() == before && waited.now() < 5 * runtime::kSecond &&
           !outbox()->waiting(lrs_.url()).empty())
      runtime::SteadyClock().sleepUntil(runtime::kMillisecond);
    runtime::SteadyClock().sleepUntil(static_cast<std::int64_t>(dice.uniform() * 12e6));
    if (i % 3 == 2) lrs_.stop();
    ::kill(sender, SIGKILL);
    ::waitpid(sender, nullptr, 0);
    if (i % 3 == 2) lrs_.start();
  }
  const pid_t last = startSender();
  int status = 0;
  ::waitpid(last, &status, 0);
  EXPECT_TRUE(WIFEXITED(status) && WEXITSTATUS(status) == 0) << status;
  expectAllOnce();
}

TEST_F(Tell, AWrongPasswordIsNamedAndLosesNothing) {
  queue();
  try {
    send(kQuick, {"teacher", "geheim"});
    ADD_FAILURE() << "was let in";
  } catch (const Error& e) {
    EXPECT_NE(std::string(e.what()).find("refuses user or password"), std::string::npos)
        << e.what();
    EXPECT_EQ(std::string(e.what()).find("geheim"), std::string::npos);
  }
  EXPECT_EQ(outbox()->waiting(lrs_.url()).size(), static_cast<std::size_t>(kTrials));
  EXPECT_EQ(lrs_.puts(), 1);  // not twenty times
}

TEST_F(Tell, AnotherStatementUnderTheSameIdIsNotOverwritten) {
  queue();
  nlohmann::json other =
      link::statementOf(sessionOf("A", 1), trialOf(3, 1), "https://centre.example");
  lrs_.keep(other);
  const link::Sent sent = send();
  EXPECT_EQ(sent.delivered, kTrials - 1);
  ASSERT_EQ(sent.refused.size(), 1u);
  EXPECT_EQ(sent.refused[0],
            "session " + uuidOf(1) + ", trial 3: another statement has this id already");
  EXPECT_EQ(sent.left, 1u);
  EXPECT_EQ(lrs_.stored().at(link::statementId(uuidOf(1), 3)).statement["result"]["score"]["raw"],
            1.0);
}

TEST_F(Tell, OneThatIsRefusedDoesNotKeepTheOthersBack) {
  outbox()->put(route(), {uuidOf(9), "", uuidOf(3), 1, "", R"({"id":"no statement"})"});
  queue();
  const link::Sent sent = send();
  EXPECT_EQ(sent.delivered, kTrials);
  ASSERT_EQ(sent.refused.size(), 1u);
  EXPECT_NE(sent.refused[0].find("it answers 400 (actor is missing)"), std::string::npos)
      << sent.refused[0];
}

TEST_F(Tell, WhoWasDeletedIsTakenBack) {
  queue();
  send();
  store_->deletePerson("A", "2026-04-01T00:00:00Z");
  EXPECT_EQ(link::takeBackDeleted(*store_, route(), *outbox()), kTrials / 2);
  EXPECT_EQ(link::takeBackDeleted(*store_, route(), *outbox()), 0);
  EXPECT_EQ(send().delivered, kTrials / 2);
  int voided = 0;
  for (const auto& [id, s] : lrs_.stored()) voided += s.voided;
  EXPECT_EQ(voided, kTrials / 2);
  EXPECT_TRUE(lrs_.stored().at(link::statementId(uuidOf(1), 1)).voided);
  expectAllOnce(kTrials + kTrials / 2);
  const std::string left = test::slurp(folder_ / "state/xapi.sqlite");
  EXPECT_EQ(left.find("\"name\":\"A\""), std::string::npos);  // nothing of the person stays here
}

TEST_F(Tell, WhoComesAnewUnderTheSamePseudonymIsToldOf) {
  queue();
  send();
  store_->deletePerson("A", "2026-04-01T00:00:00Z");
  store_->addTrainee(person("A"));
  record::StoredSession later = sessionOf("A", 7);
  later.started_utc = "2026-05-01T10:00:00Z";
  store_->addTrial(later, trialOf(1));
  EXPECT_EQ(queue().added, 1);
  EXPECT_EQ(link::takeBackDeleted(*store_, route(), *outbox()), kTrials / 2);
  send();
  EXPECT_FALSE(lrs_.stored().at(link::statementId(uuidOf(7), 1)).voided);
}

TEST_F(Tell, WhoIsDeletedBeforeAnythingWasSentIsNeverTold) {
  queue();
  store_->deletePerson("A", "2026-04-01T00:00:00Z");
  EXPECT_EQ(link::takeBackDeleted(*store_, route(), *outbox()), kTrials / 2);
  EXPECT_EQ(send().delivered, kTrials / 2);
  for (const auto& [id, s] : lrs_.stored()) EXPECT_EQ(s.statement["actor"]["account"]["name"], "B");
  expectAllOnce(kTrials / 2);
}

TEST_F(Tell, SimulatedAndVoidTrialsAreLeftOutAndCounted) {
  store_->addTrial(sessionOf("A", 3, true), trialOf(1));
  record::StoredTrial none = trialOf(2);
  none.outcome = "void";
  store_->addTrial(sessionOf("A", 4), none);
  record::StoredSession odd = sessionOf("A", 5);
  odd.uuid = "u5";
  store_->addTrial(odd, trialOf(1));
  const link::Queued queued = queue();
  EXPECT_EQ(queued.added, kTrials);
  EXPECT_EQ(queued.simulated, 1);
  EXPECT_EQ(queued.void_trials, 1);
  EXPECT_EQ(queued.no_uuid, 1);
  EXPECT_EQ(queue(true).added, 1);
}

TEST_F(Tell, AnotherRecordsDeletionsTouchNothing) {
  queue();
  send();
  record::RecordStore other((folder_ / "other.sqlite").string());
  other.addTrainee(person("A"));
  other.deletePerson("A", "2026-04-01T00:00:00Z");
  EXPECT_EQ(link::takeBackDeleted(other, {lrs_.url(), "other"}, *outbox()), 0);
}

}  // namespace
}  // namespace palpa::link_test

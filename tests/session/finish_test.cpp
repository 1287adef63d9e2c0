#include "apps/session/finish_session.h"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "anatomy/base/error.h"
#include "apps/session/session_facts.h"
#include "tests/record/synthetic_session.h"
#include "tests/session/quick_sessions.h"
#include "tests/support/setting.h"

/// Which sessions were left, and what their evidence says for the report.
namespace palpa::session {
namespace {

namespace fs = std::filesystem;

struct States {
  explicit States(const std::string& name)
      : here(freshPlace(name)), setting("XDG_STATE_HOME", (here / "state").c_str()) {}
  fs::path session(const std::string& name) const {
    fs::create_directories(here / name);
    return here / name;
  }
  const fs::path here;
  const test::Setting setting;
};

void touch(const fs::path& file) { writeWhole(file, "x", Lasts::no); }

void makeEvidence(const fs::path& folder) {
  record::SessionWriter(folder / "session.palpa", record::test::syntheticInfo()).close();
}

TEST(BegunSession, IsLeftWhenItEndsWithoutItsReport) {
  const States states("begun_left");
  const fs::path folder = states.session("A");
  {
    const BegunSession begun(folder);
    makeEvidence(folder);
    EXPECT_TRUE(unfinishedSessions().empty()) << "it runs";
    EXPECT_THROW(finishSession(folder, FinishAgain::no), UsageError);
    { const BegunSession second(folder); }  // refused by the evidence that is there
    EXPECT_TRUE(unfinishedSessions().empty()) << "the first one still runs";
  }
  EXPECT_EQ(unfinishedSessions(), std::vector<fs::path>{folder});
  touch(folder / "report.html");
  EXPECT_EQ(unfinishedSessions().size(), 1u) << "it owes its table";
  touch(folder / "trials.csv");
  EXPECT_TRUE(unfinishedSessions().empty());
}

TEST(BegunSession, IsForgottenWithItsReportAndWithItsEvidence) {
  const States states("begun_forgotten");
  const fs::path whole = states.session("A"), gone = states.session("B");
  {
    const BegunSession one(whole), other(gone);
    for (const fs::path& folder : {whole, gone}) makeEvidence(folder);
    touch(whole / "report.html"), touch(whole / "trials.csv");
  }
  fs::remove(gone / "session.palpa");
  EXPECT_TRUE(unfinishedSessions().empty());
  fs::remove(whole / "report.html");
  EXPECT_TRUE(unfinishedSessions().empty()) << "nothing is noted of it any more";
}

TEST(BegunSession, NeedsNoPlaceForIt) {
  const States states("begun_nowhere");
  const fs::path folder = states.session("A");
  touch(states.here / "file");
  const test::Setting nowhere("XDG_STATE_HOME", (states.here / "file").c_str());
  const BegunSession begun(folder);
  EXPECT_TRUE(unfinishedSessions().empty());
}

ReportHead exampleHead() {
  ReportHead head;
  head.title = "A task, right side";
  head.trainee = "simulated expert";
  head.user_id = "T017";
  head.simulated = head.assessed = true;
  head.force_note = "Scaled force";
  head.unit_note = "1 U";
  head.too_hard_N = 0.1;
  head.taxonomy = {{"What is seen", "real", ""}};
  head.station = {{"Station", "Bench", "bench-1"}, {"Time", "real", ""}};
  head.parts = {{"scan", "over the floor"}, {"stay", "in a pit"}};
  head.doses = {{"scan", 0, 0, 0, 0}, {"any part", 0, 0, 0, 0}};
  return head;
}

void expectSame(const std::vector<report::Fact>& a, const std::vector<report::Fact>& b) {
  ASSERT_EQ(a.size(), b.size());
  for (std::size_t i = 0; i < a.size(); ++i)
    EXPECT_TRUE(a[i].name == b[i].name && a[i].value == b[i].value && a[i].remark == b[i].remark);
}

TEST(ReportHead, IsReadAgainAsItWasWritten) {
  const ReportHead head = exampleHead();
  record::SessionInfo info;
  info.session_json = nlohmann::json{
      {"trainee", "T017"},
      {"simulated", true},
      {"assessed", true},
      {"report",
       jsonOf(head)}}.dump();
  const ReportHead again = headIn(info, "session.palpa");
  EXPECT_EQ(jsonOf(again), jsonOf(head));
  EXPECT_EQ(again.user_id, head.user_id);
  EXPECT_TRUE(again.simulated && again.assessed);
  EXPECT_EQ(again.too_hard_N, head.too_hard_N);
  EXPECT_EQ(again.parts, head.parts);
  expectSame(again.station, head.station);
}

TEST(ReportHead, OfOlderEvidenceIsWhatThereIs) {
  record::SessionInfo info;
  info.software = "palpa 0.9";
  info.session_json = R"({"trainee": "T017", "simulated": true, "operator": "expert"})";
  info.task_json = R"({"title": "A task"})";
  info.station_json = R"({"title": "Bench", "id": "bench-1"})";
  const ReportHead head = headIn(info, "session.palpa");
  EXPECT_EQ(head.title, "A task");
  EXPECT_EQ(head.trainee, "simulated expert");
  EXPECT_EQ(head.station.front().value, "Bench");
  EXPECT_EQ(head.station.at(2).value, "not told");
  info.session_json = R"({"report": {"title": 1}})";
  EXPECT_THROW(headIn(info, "session.palpa"), Error);
}

}  // namespace
}  // namespace palpa::session

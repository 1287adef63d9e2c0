// Consoles and sessions that are killed, and what is left of them. Last in name and order: it ends
// the session of the others.
#include <gtest/gtest.h>
#include <signal.h>

#include <algorithm>

#include "attacked.h"

namespace palpa::console_attack {
namespace {

using nlohmann::json;

class TheEnd : public Attacked {};

/// Killed in the middle of a trial and begun again: the session has gone on, is found, is told on,
/// is steered; its trial is finished and in the records; nothing anybody wrote is markup there.
TEST_F(TheEnd, AConsoleThatIsKilledFindsItsSessionAgain) {
  const std::string id = session();
  const auto before = console().events(id, "", until(40));
  ASSERT_GE(before.size(), 40u);
  const std::string key = console().pageKey();
  console().kill();
  console().begin();
  EXPECT_NE(console().pageKey(), key);
  EXPECT_EQ(console().get("/api/sessions/" + id).json()["state"], "running");
  const auto after = console().events(id, "40", until(40));
  ASSERT_GE(after.size(), 40u);
  expectNumbered(after, 41);
  for (std::size_t i = 40; i < before.size(); ++i) EXPECT_EQ(before[i], after[i - 40]);
  EXPECT_EQ(
      console().post("/api/sessions", {{"task", "paracentesis"}, {"operator", "expert"}}).status,
      409)
      << "a second one on the same station";
  EXPECT_EQ(console()
                .post("/api/sessions/" + id + "/command",
                      {{"command", "note"}, {"reason", kMarkup}, {"at_s", 1.5}})
                .status,
            202);

  const auto noted = [](const Event& e) {
    return e.data.value("event", "") == "note" && e.data.value("text", "") == kMarkup;
  };
  const auto trialOver = [](const Event& e) { return e.data.value("kind", "") == "trial_end"; };
  const auto all = console().events(id, "", [&](const std::vector<Event>& seen) {
    return std::any_of(seen.begin(), seen.end(), noted) &&
           std::any_of(seen.begin(), seen.end(), trialOver);
  });
  EXPECT_TRUE(std::any_of(all.begin(), all.end(), noted)) << "as it was written";
  EXPECT_TRUE(std::any_of(all.begin(), all.end(), trialOver));
  EXPECT_EQ(console().post("/api/sessions/" + id + "/command", {{"command", "leave"}}).status, 202);
  const auto end =
      console().events(id, std::to_string(all.back().id), [](const auto&) { return false; });
  ASSERT_FALSE(end.empty());
  EXPECT_EQ(end.back().data["kind"], "end");
  EXPECT_EQ(end.back().data["state"], "finished");
  const json over = console().get("/api/sessions/" + id).json();
  ASSERT_FALSE(over["results"].empty()) << over.dump();
  EXPECT_NE(over["results"][0]["outcome"], "interrupted");
  const json trainee = console().get("/api/trainees").json()[0];
  EXPECT_GE(trainee["trials"].get<int>(), 1);
  EXPECT_EQ(trainee["group"], kMarkup);

  const Answer report = console().get("/api/sessions/" + id + "/file/report.html"),
               table = console().get("/api/sessions/" + id + "/file/trials.csv");
  EXPECT_EQ(report.status, 200);
  EXPECT_NE(report.header("Content-Security-Policy").find("sandbox"), std::string::npos);
  EXPECT_EQ(report.header("X-Content-Type-Options"), "nosniff");
  EXPECT_EQ(report.body.find("<script"), std::string::npos);
  EXPECT_EQ(report.body.find("<img src=x"), std::string::npos);
  EXPECT_EQ(table.header("Content-Type"), "text/csv; charset=utf-8");
}

/// In every text field: kept as text, told as JSON, in reports no markup.
TEST_F(TheEnd, MarkupIsTextInReports) {
  const Answer trainees = console().get("/api/trainees");
  EXPECT_EQ(trainees.header("Content-Type"), "application/json");
  EXPECT_EQ(trainees.header("X-Content-Type-Options"), "nosniff");
  EXPECT_EQ(trainees.json()[0]["experience"], kMarkup);
  std::string group;
  for (const unsigned char c : std::string(kMarkup)) {
    char hex[4];
    std::snprintf(hex, sizeof hex, "%%%02X", c);
    group += hex;
  }
  for (const std::string& path : {std::string("/api/trainees/T017/report"),
                                  std::string("/api/cohort"), "/api/cohort?group=" + group}) {
    json made;
    ASSERT_TRUE(inTime([&] {
      return (made = console().get(path).json()).value("state", "") != "working";
    })) << path;
    if (made["state"] != "done") {
      EXPECT_NE(made["message"], "")
          << path;  // a trainee without trials has no report yet: said in words
      continue;
    }
    const Answer page = console().get(made["page"].get<std::string>());
    EXPECT_EQ(page.status, 200);
    EXPECT_NE(page.header("Content-Security-Policy").find("sandbox"), std::string::npos);
    EXPECT_EQ(page.body.find("<script"), std::string::npos) << path;
    EXPECT_EQ(page.body.find("<img src=x"), std::string::npos) << path;
    EXPECT_TRUE(path == "/api/cohort" || page.body.find("&lt;script") != std::string::npos)
        << path << ": nothing of it is shown";
  }
  for (const json& bad : {json{{"id", kMarkup}}, json{{"id", "T2"}, {"handedness", kMarkup}},
                          json{{"id", "T2"}, {"group", "a\nb"}},
                          json{{"id", "T2"}, {"experience", std::string(81, 'a')}},
                          json{{"id", "-x"}}, json{{"id", "T2"}, {"group", 5}}}) {
    const Answer answer = console().post("/api/trainees", bad);
    EXPECT_EQ(answer.status, 422) << bad.dump();
    EXPECT_EQ(answer.header("Content-Type"), "application/json");
  }
  for (const json& bad :
       {json{{"task", kMarkup}}, json{{"task", "paracentesis"}, {"trainee", kMarkup}},
        json{{"task", "paracentesis"}, {"operator", kMarkup}},
        json{{"task", "nothing-like-it"}, {"operator", "expert"}}}) {
    const int status = console().post("/api/sessions", bad).status;
    EXPECT_TRUE(status == 422 || status == 409) << bad.dump() << status;
  }
  for (const json& bad : {json{{"trainee", kMarkup}, {"operator", "expert"}},
                          json{{"trainee", "T017"}, {"operator", kMarkup}}})
    EXPECT_EQ(console().post("/api/studies/no-such-study/run", bad).status, 422);
  EXPECT_EQ(console().post("/api/calibration", {{"step", kMarkup}}).status, 422);
}

TEST_F(TheEnd, ASessionThatIsKilledIsSaidInWords) {
  const std::string id = session();
  ASSERT_GE(console().events(id, "", until(5)).size(), 5u);
  const json facts = json::parse(contentOf(console().home() / "sessions" / id / "console.json"));
  ASSERT_EQ(::kill(facts["pid"].get<int>(), SIGKILL), 0);
  const auto all = console().events(id, "", [](const auto&) { return false; });
  ASSERT_FALSE(all.empty());
  EXPECT_EQ(all.back().data["kind"], "end");
  EXPECT_EQ(all.back().data["state"], "interrupted");
  EXPECT_NE(all.back().data["message"].get<std::string>().find("was stopped"), std::string::npos)
      << all.back().data.dump();
  const Answer one = console().get("/api/sessions/" + id);
  EXPECT_EQ(one.status, 200);
  EXPECT_EQ(one.json()["state"], "interrupted");
  EXPECT_NE(one.json()["message"], "");
  EXPECT_EQ(console().post("/api/sessions/" + id + "/command", {{"command", "pause"}}).status, 409);

  const Answer asked = console().post("/api/sessions/" + id + "/finish", json::object());
  ASSERT_EQ(asked.status, 202) << asked.body;
  const std::string job = "/api/jobs/" + asked.json()["job"].get<std::string>();
  json made;
  ASSERT_TRUE(
      inTime([&] { return (made = console().get(job).json()).value("state", "") != "working"; }));
  EXPECT_EQ(made["state"], "done") << made.dump();
  const json finished = console().get("/api/sessions/" + id).json();
  EXPECT_EQ(finished["state"], "finished");
  EXPECT_EQ(finished["message"], "");
  EXPECT_EQ(console().get("/api/sessions/" + id + "/file/report.html").status, 200);
  EXPECT_EQ(console().post("/api/sessions/" + id + "/finish", json::object()).status, 409)
      << "nothing is owed any more";
}

}  // namespace
}  // namespace palpa::console_attack

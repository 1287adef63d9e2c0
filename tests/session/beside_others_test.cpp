#include <gtest/gtest.h>

#include <fstream>
#include <functional>

#include <nlohmann/json.hpp>

#include "apps/record/store/record_store.h"
#include "apps/session/session_records.h"
#include "apps/station/assets.h"
#include "tests/session/quick_sessions.h"
#include "tests/support/files.h"

/// Whom a report shows beside a session: experts as shipped, others as the records have them.
namespace palpa::session {
namespace {

using nlohmann::json;

/// Records of nine trainees, each with one session of three trials in the task of this file's id.
class Records {
 public:
  explicit Records(const std::string& name) : url_((freshPlace(name) / "r.sqlite").string()) {}

  void hold(const std::string& stored_as, const std::string& task_id,
            const json& more = json::object(), const std::string& study = "") {
    record::RecordStore store(url_);
    for (int i = 0; i < 9; ++i) {
      const std::string who = "T" + std::to_string(i);
      record::Trainee trainee;
      trainee.id = who;
      if (!store.trainee(who)) store.addTrainee(trainee);
      record::StoredSession session;
      session.uuid = task_id + who + std::to_string(held_);
      session.trainee = who;
      session.started_utc = "2027-01-10T09:00:00Z";
      session.task = stored_as;
      session.study = study;
      session.evidence = "/nowhere/" + who;
      json facts{{"task", task_id}};
      facts.update(more);
      session.facts_json = facts.dump();
      for (int n = 1; n <= 3; ++n) {
        record::StoredTrial trial;
        trial.number = n;
        trial.role = "scored";
        trial.outcome = "success";
        trial.score_json = "{}";
        trial.metrics = {{"success", 1}, {"time_s", 10.0 * (i + 1)}};
        store.addTrial(session, trial);
      }
    }
    ++held_;
  }
  const std::string& url() const { return url_; }

 private:
  std::string url_;
  int held_ = 0;
};

std::string taskText(const char* name) {
  return test::slurp(station::assetFile(std::string("tasks/") + name));
}

/// The group of this name beside a session by T0; null: none.
json beside(const Records& records, const std::string& task, const char* name,
            const std::function<void(SessionOptions&)>& as = {}) {
  SessionOptions options = quick(OperatorKind::person);
  options.records = records.url();
  options.trainee = "T0";
  if (as) as(options);
  meetOthers(options, false, task);
  for (const progress::Group& group : options.others)
    if (group.name == name) return jsonOf(group);
  return nullptr;
}

TEST(BesideOthers, OnlyWhoDidTheSameInTheSameWay) {
  const Records records = [] {
    Records some("beside");
    some.hold("palpation", "palpation-breast");
    return some;
  }();
  const std::string breast = taskText("palpation_breast.json"),
                    neck = taskText("palpation_neck.json");
  constexpr const char* kOthers = "others who train here";
  const json others = beside(records, breast, kOthers);
  ASSERT_FALSE(others.is_null());
  EXPECT_EQ(others.at("people"), 8) << "without who asks";
  EXPECT_EQ(others.at("figures").at("time_s").at(1), 55);  // of 20 to 90 s
  EXPECT_TRUE(beside(records, neck, kOthers).is_null()) << "another part of the body";
  EXPECT_TRUE(beside(records, breast, kOthers, [](SessionOptions& o) {
                o.force_feedback = false;
              }).is_null());
  EXPECT_TRUE(
      beside(records, breast, kOthers, [](SessionOptions& o) { o.augment = true; }).is_null());
  EXPECT_TRUE(
      beside(records, breast, kOthers, [](SessionOptions& o) { o.records = ""; }).is_null());
}

TEST(BesideOthers, WhoTakesPartInAStudyIsNoOther) {
  Records records("studies");
  records.hold("palpation", "palpation-breast", json::object(), "some-study");
  EXPECT_TRUE(
      beside(records, taskText("palpation_breast.json"), "others who train here").is_null());
}

TEST(BesideOthers, RecordsThatCannotBeReadHoldNoSessionUp) {
  Records records("unread");
  std::ofstream(records.url()) << "no database";
  EXPECT_TRUE(beside(records, taskText("paracentesis.json"), "others who train here").is_null());
}

TEST(BesideOthers, ExpertsAreThoseThatAreShipped) {
  const Records none("none");
  const json experts = beside(none, taskText("paracentesis.json"), "experts");
  ASSERT_FALSE(experts.is_null());
  EXPECT_EQ(experts.at("simulated"), true);
  const auto without = [](SessionOptions& o) { o.force_feedback = false; };
  EXPECT_TRUE(beside(none, taskText("paracentesis.json"), "experts", without).is_null())
      << "experts felt it";
  EXPECT_TRUE(beside(none, R"({"id": "somebodys_own", "engine": "needle"})", "experts").is_null());
}

// The report of a killed session is the same one: it was written down who stood beside.
TEST(BesideOthers, StandsInTheEvidence) {
  SessionOptions options = quick(OperatorKind::expert, 5);
  NeedleWorld world(options);
  world.station.camera_rate_Hz = 1;
  meetOthers(options, true, world.task.source);
  const std::filesystem::path folder = freshPlace("evidence");
  runNeedleSession(options, world, folder);
  const record::SessionReader session(folder / "session.palpa");
  const std::vector<progress::Group> groups = othersBeside(session.info());
  ASSERT_FALSE(groups.empty());
  EXPECT_EQ(groups.front().name, "experts");
  EXPECT_TRUE(groups.front().reach("total"));
}

}  // namespace
}  // namespace palpa::session

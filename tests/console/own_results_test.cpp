#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

#include "apps/record/store/record_store.h"
#include "tests/console/served.h"

/// A trainee's own results, asked for as a device of his or her own asks.
namespace palpa::console {
namespace {

namespace fs = std::filesystem;
constexpr char kToken[] = "the educator's token";

void leaveSession(const fs::path& home, const std::string& id, const std::string& trainee,
                  bool study) {
  const fs::path folder = home / "sessions" / id;
  fs::create_directories(folder);
  std::ofstream(folder / "console.json") << json{{"task", "paracentesis"},
                                                 {"title", "Access to the subclavian vein"},
                                                 {"trainee", trainee},
                                                 {"started_utc", "2026-11-30T10:00:00Z"},
                                                 {"assessed", false},
                                                 {"simulated", false},
                                                 {"study", study},
                                                 {"blind", false},
                                                 {"trials", 1},
                                                 {"pid", 0}};
  std::ofstream(folder / "report.html") << "report of " << trainee << " in " << id;
}

/// Somebody who asks, with the cookies that were given.
class Asking {
 public:
  explicit Asking(Served& console) : client_(console.client()) {
    const auto me = client_.Get("/api/me");
    key_ = json::parse(me->body).at("page_key");
  }
  httplib::Result get(const std::string& path) { return client_.Get(path, headers()); }
  httplib::Result post(const std::string& path, const json& body) {
    httplib::Headers all = headers();
    all.emplace("X-Palpa-Page", key_);
    all.emplace("X-Palpa-Write", randomKey());
    auto answer = client_.Post(path, all, body.dump(), "application/json");
    if (answer && answer->has_header("Set-Cookie")) {
      cookie_ = answer->get_header_value("Set-Cookie");
      cookie_.erase(cookie_.find(';'));
    }
    return answer;
  }

 private:
  httplib::Headers headers() const {
    return cookie_.empty() ? httplib::Headers{} : httplib::Headers{{"Cookie", cookie_}};
  }
  httplib::Client client_;
  std::string key_, cookie_;
};

class OwnResults : public testing::Test {
 protected:
  OwnResults() : place_("own") {
    for (const char* id : {"T017", "T018"}) {
      record::Trainee one;
      one.id = id;
      one.added_utc = one.consent_utc = "2026-11-01T10:00:00Z";
      record::RecordStore((place_ / "records.sqlite").string()).addTrainee(one);
    }
    leaveSession(home(), "A1", "T017", false);
    leaveSession(home(), "A2", "T017", true);
    leaveSession(home(), "A3", "T018", false);
  }
  fs::path home() const { return place_ / "home"; }

  test::ScratchFolder place_;
  test::ShortFolder sockets_;
};

TEST_F(OwnResults, AreReadByAPinAndNobodyElsesAre) {
  Served console(home(), sockets_.path(), kToken);
  Asking educator(console), trainee(console);
  EXPECT_EQ(educator.post("/api/trainees/T017/pin", json::object())->status, 401);
  ASSERT_EQ(educator.post("/api/enter", {{"token", kToken}})->status, 200);
  EXPECT_EQ(educator.post("/api/trainees/T099/pin", json::object())->status, 422);
  const auto shown = educator.post("/api/trainees/T017/pin", json::object());
  ASSERT_EQ(shown->status, 200);

  EXPECT_EQ(json::parse(trainee.get("/api/mine")->body)["trainee"], "");
  EXPECT_EQ(trainee.post("/api/mine/enter", {{"pin", 12}})->status, 403);
  ASSERT_EQ(trainee.post("/api/mine/enter", {{"pin", json::parse(shown->body)["pin"]}})->status,
            200);
  const json mine = json::parse(trainee.get("/api/mine")->body);
  EXPECT_EQ(mine["trainee"], "T017");
  ASSERT_EQ(mine["sessions"].size(), 1u) << "not the study's, not anybody else's";
  EXPECT_EQ(mine["sessions"][0]["id"], "A1");
  EXPECT_EQ(mine["sessions"][0]["title"], "Access to the subclavian vein");

  const auto report = trainee.get("/api/mine/A1/file/report.html");
  EXPECT_EQ(report->body, "report of T017 in A1");
  EXPECT_EQ(report->get_header_value("Content-Security-Policy").rfind("sandbox", 0), 0u);
  for (const char* path : {"/api/mine/A2/file/report.html", "/api/mine/A3/file/report.html",
                           "/api/mine/nobodys/file/report.html"})
    EXPECT_EQ(trainee.get(path)->status, 404) << path;
  for (const char* path : {"/api/sessions", "/api/sessions/A1/file/report.html", "/api/trainees"})
    EXPECT_EQ(trainee.get(path)->status, 401) << path;
  EXPECT_EQ(trainee.post("/api/mine/leave", json::object())->status, 200);
}

TEST_F(OwnResults, AreNotShownOfWhoIsInTheRecordsNoMore) {
  Served console(home(), sockets_.path(), kToken);
  Asking educator(console), trainee(console);
  educator.post("/api/enter", {{"token", kToken}});
  const json shown = json::parse(educator.post("/api/trainees/T018/pin", json::object())->body);
  ASSERT_EQ(trainee.post("/api/mine/enter", {{"pin", shown["pin"]}})->status, 200);
  ASSERT_EQ(trainee.get("/api/mine/A3/file/report.html")->status, 200);
  record::RecordStore((place_ / "records.sqlite").string())
      .deletePerson("T018", "2026-11-30T12:00:00Z");
  EXPECT_EQ(json::parse(trainee.get("/api/mine")->body)["trainee"], "");
  EXPECT_EQ(trainee.get("/api/mine/A3/file/report.html")->status, 404);
}

TEST_F(OwnResults, NeedAConsoleThatOthersCanComeTo) {
  Served console(home(), sockets_.path());
  EXPECT_EQ(Asking(console).post("/api/trainees/T017/pin", json::object())->status, 422);
  EXPECT_FALSE(console.get("/api/me")["open_to_others"].get<bool>());
}

}  // namespace
}  // namespace palpa::console

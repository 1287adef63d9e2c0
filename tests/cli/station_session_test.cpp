#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <opencv2/imgcodecs.hpp>
#include <sstream>

#include "apps/record/session_file.h"
#include "apps/runtime/clock.h"
#include "csv_rows.h"
#include "program.h"

/// Sessions on other stations than the virtual bench as it is shipped, and on other loops.
namespace palpa::cli_test {
namespace {

nlohmann::json benchStation() {
  return nlohmann::json::parse(contentOf(PALPA_SOURCE_DIR "/assets/stations/virtual_bench.json"));
}

/// Its camera takes fewer pictures, where nothing is said of when.
nlohmann::json benchWithFewPictures() {
  return nlohmann::json::parse(contentOf(quickStation("virtual_bench.json")));
}

/// A quick session of whoever the station is for.
std::vector<std::string> ofTheStation(std::vector<std::string> more) {
  more.insert(more.begin(), "subclavian");
  return quickly(more);
}

std::string totalOf(const std::filesystem::path& csv) {
  const std::string text = contentOf(csv);
  const std::size_t comma = text.rfind(',');
  return text.substr(comma + 1);
}

/// One ordinary session that the others are compared with.
struct Ordinary {
  Folder here;
  Ordinary() { outcome = palpa(session({"--seed", kShortTrial, "--out", "A"}), here.path()); }
  Outcome outcome;
};
Ordinary& ordinary() {
  static Ordinary one;
  return one;
}

/// Whatever becomes of the camera: the hand feels the same, the session ends as it would have, and
/// the record says what was lost from when to when.
TEST(StationSession, NothingThatBefallsTheCameraStopsASession) {
  nlohmann::json station = benchStation();
  nlohmann::json& faults = station["twin"]["camera_faults"];
  const std::vector<std::pair<std::string, std::string>> kinds{{"hidden", "lost the board"},
                                                               {"black", "is black"},
                                                               {"frozen", "stands still: look"},
                                                               {"wrong_size", "another size"},
                                                               {"gone", "is gone"}};
  double t = 0.8;
  for (const auto& [kind, words] : kinds) {
    faults.push_back({{"kind", kind}, {"from_s", t}, {"to_s", t + 1}});
    t += 1.4;
  }
  faults.push_back({{"kind", "ended"}, {"from_s", t}, {"to_s", t + 1}});
  Folder here;
  const std::string file = here.file("faulty.json", station.dump());
  const Outcome outcome =
      palpa(session({"--station", file, "--seed", kShortTrial, "--out", "A"}), here.path());
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_EQ(contentOf(here / "A/trials.csv"), contentOf(ordinary().here / "A/trials.csv"));
  const std::string report = contentOf(here / "A/report.html");
  std::vector<runtime::Event> events;
  for (const runtime::Event& event : record::SessionReader(here / "A/session.palpa").events())
    if (event.kind == "camera") events.push_back(event);
  std::size_t at = 0;
  double begins = 0.8;
  for (const auto& [kind, words] : kinds) {
    while (at < events.size() && !says(events[at].text, words)) ++at;
    ASSERT_LT(at, events.size()) << kind;
    EXPECT_NEAR(1e-9 * static_cast<double>(events[at].t_ns), begins + 0.4, 0.4)
        << kind;  // a frozen picture is one after half a second
    EXPECT_TRUE(says(report, words)) << kind;
    while (at < events.size() && events[at].value > 0) ++at;
    ASSERT_LT(at, events.size()) << kind;
    EXPECT_NEAR(1e-9 * static_cast<double>(events[at].t_ns), begins + 1 + 0.6, 0.6)
        << kind;  // one that failed is asked again once a second
    begins += 1.4;
  }
  EXPECT_TRUE(says(events.back().text, "have ended")) << events.back().text;
}

nlohmann::json withPhantomBoard() {
  nlohmann::json station = benchStation();
  station["boards"] = {
      {{"name", "phantom"},
       {"columns", 2},
       {"rows", 2},
       {"tag_size_mm", 25},
       {"spacing_mm", 6},
       {"first_id", 200},
       {"X_WB", {{"position_mm", {160, 10, 0}}, {"rotation_vector_deg", {0, 0, 20}}}}}};
  return station;
}

/// A phantom that is pushed is told, on the screen and in the record; what is drawn and felt stays,
/// and so does the score.
TEST(StationSession, APhantomThatMovesIsTold) {
  Folder here;
  nlohmann::json station = withPhantomBoard();
  station["twin"]["board_moves"] = {{{"board", "phantom"}, {"from_s", 4}, {"by_mm", {8, 6, 0}}}};
  here.file("station.json", station.dump());
  const Outcome outcome = palpa(
      session({"--seed", kShortTrial, "--station", "station.json", "--out", "A"}), here.path());
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_EQ(contentOf(here / "A/trials.csv"), contentOf(ordinary().here / "A/trials.csv"));
  std::vector<runtime::Event> told;
  for (const runtime::Event& event : record::SessionReader(here / "A/session.palpa").events())
    if (event.kind == "camera" && event.value > 0) told.push_back(event);
  ASSERT_EQ(told.size(), 1u);
  EXPECT_TRUE(says(told[0].text, "the phantom has moved by 10 mm")) << told[0].text;
  EXPECT_GE(told[0].t_ns, 4'000'000'000);
  EXPECT_LT(told[0].t_ns, 4'500'000'000);
}

/// A real thing in front hides what is drawn behind it: there the camera's picture is seen.
TEST(StationSession, RealThingsHideWhatIsDrawnBehindThem) {
  Folder here;
  const auto picture = [&](const std::string& name, const nlohmann::json& things) {
    nlohmann::json station = withPhantomBoard();
    station["real_things"] = things;
    here.file(name + ".json", station.dump());
    Running session({"subclavian", "--fast", "--quiet", "--operator", "expert", "--seed",
                     kShortTrial, "--station", name + ".json", "--out", name},
                    here.path());
    const std::filesystem::path file = here / (name + "/view-01-01-start.png");
    const runtime::SteadyClock clock;
    while (!session.ended() && !std::filesystem::exists(file))
      clock.sleepUntil(clock.now() + 20 * runtime::kMillisecond);
    session.interrupt();  // what comes later is not looked at
    return cv::imread(file.string());
  };
  here.file("plate.obj", "v -450 -450 0\nv 450 -450 0\nv 450 450 0\nv -450 450 0\nf 1 2 3 4\n");
  const nlohmann::json over_patient{
      {"mesh", "plate.obj"},
      {"unit", "mm"},
      {"on", "table"},
      {"X", {{"position_mm", {0, 260, 200}}, {"rotation_vector_deg", {0, 0, 0}}}}};
  nlohmann::json under_board = over_patient;
  under_board["on"] = "phantom";
  under_board["X"]["position_mm"] = {0, 0, -20};
  const cv::Mat bare = picture("bare", nlohmann::json::array()),
                hidden = picture("hidden", {over_patient, under_board});
  ASSERT_FALSE(bare.empty() || hidden.empty());
  ASSERT_EQ(bare.size(), hidden.size());
  const auto coloured = [](const cv::Mat& view) {  // the camera's picture is gray
    const cv::Rect large(0, 60, view.cols * 65 / 100, view.rows / 2);
    std::vector<cv::Mat> bgr;
    cv::split(view(large), bgr);
    return cv::countNonZero(bgr[2] - bgr[0] > 15);
  };
  EXPECT_GT(coloured(bare), 40'000);
  EXPECT_LT(coloured(hidden), coloured(bare) / 3);
}

TEST(StationSession, BoardsAndThingsThatCannotBeAreRefused) {
  Folder here;
  const auto refused = [&](const std::string& words, const auto& spoil) {
    nlohmann::json station = withPhantomBoard();
    station["real_things"] = {
        {{"mesh", "plate.obj"},
         {"unit", "mm"},
         {"on", "phantom"},
         {"X", {{"position_mm", {0, 0, 0}}, {"rotation_vector_deg", {0, 0, 0}}}}}};
    spoil(station);
    here.file("station.json", station.dump());
    const Outcome outcome =
        palpa(session({"--station", "station.json", "--out", "A"}), here.path());
    EXPECT_NE(outcome.exit_code, 0) << words;
    EXPECT_EQ(outcome.errLines(), 1) << outcome.err;
    EXPECT_TRUE(says(outcome.err, words)) << outcome.err;
  };
  using nlohmann::json;
  refused("plate.obj", [](json&) {});  // is not there
  refused("another board has", [](json& s) { s["boards"][0]["first_id"] = 20; });
  refused("which another board has, too", [](json& s) { s["boards"][0]["name"] = "table"; });
  refused("known are table, tool", [](json& s) { s["real_things"][0]["on"] = "shelf"; });
  refused("known are m, cm, mm", [](json& s) { s["real_things"][0]["unit"] = "inch"; });
  refused("must be a list", [](json& s) { s["boards"] = 3; });
  refused("tolerance_mm", [](json& s) { s["boards"][0]["tolerance_mm"] = 0; });
  refused("is not a board with an X_WB", [](json& s) {
    s["real_things"] = json::array();
    s["twin"]["board_moves"] = {{{"board", "lid"}, {"from_s", 1}, {"by_mm", {1, 0, 0}}}};
  });
}

/// What a session kept is a film that a session can be held on: the board is where it was.
TEST(StationSession, ARecordedVideoIsACameraAgain) {
  Folder here;
  Outcome outcome =
      palpa(session({"--seed", kShortTrial, "--record-video", "--out", "A"}), here.path());
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_EQ(contentOf(here / "A/trials.csv"), contentOf(ordinary().here / "A/trials.csv"));
  here.file("lens.yml", benchLens());
  outcome = palpa(session({"--seed", kShortTrial, "--camera", "A/camera.mjpeg", "--intrinsics",
                           "lens.yml", "--board", "tags:6x4:0.030:0.0075", "--out", "B"}),
                  here.path());
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  std::size_t lost = 0;
  for (const runtime::Event& event : record::SessionReader(here / "B/session.palpa").events())
    if (event.kind == "camera" && event.value > 0) {
      ++lost;
      EXPECT_TRUE(says(event.text, "ended") || says(event.text, "does not see")) << event.text;
    }
  EXPECT_LE(lost, 2u);  // before the first picture, and where the film ends
}

TEST(StationSession, AGuidedTrialIsNotScored) {
  Folder here;
  const Outcome outcome =
      palpa(session({"--seed", kShortTrial, "--guide", "on", "--out", "A"}), here.path());
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_TRUE(says(outcome.out, "not scored")) << outcome.out;
  EXPECT_EQ(contentOf(here / "A/trials.csv").find("T000"), std::string::npos);
}

TEST(StationSession, ACameraFaultThatIsNoneIsRefused) {
  for (const char* fault : {R"({"kind": "tired", "from_s": 1, "to_s": 2})",
                            R"({"kind": "black", "from_s": 3, "to_s": 2})",
                            R"({"kind": "black", "from_s": -1, "to_s": 2})"}) {
    nlohmann::json station = benchStation();
    station["twin"]["camera_faults"].push_back(nlohmann::json::parse(fault));
    Folder here;
    const Outcome outcome =
        palpa(session({"--station", here.file("faulty.json", station.dump()), "--out", "A"}),
              here.path());
    EXPECT_EQ(outcome.exit_code, 2) << fault;
    EXPECT_TRUE(says(outcome.err, "camera_faults")) << outcome.err;
  }
}

TEST(StationSession, ARecordedHandScoresWhatItScored) {
  ASSERT_EQ(ordinary().outcome.exit_code, 0) << ordinary().outcome.err;
  nlohmann::json station = benchWithFewPictures();
  station["device"]["driver"] = "replay";
  station["device"]["recording"] = (ordinary().here / "A/session.palpa").string();
  Folder here;
  const std::string file = here.file("replay.json", station.dump());
  const Outcome again =
      palpa(ofTheStation({"--station", file, "--seed", kShortTrial, "--out", "B"}), here.path());
  ASSERT_EQ(again.exit_code, 0) << again.err;
  EXPECT_EQ(totalOf(here / "B/trials.csv"), totalOf(ordinary().here / "A/trials.csv"));
  EXPECT_NE(contentOf(here / "B/report.html").find("recorded hand"), std::string::npos);
  const std::string recorded = (ordinary().here / "A/session.palpa").string();
  ASSERT_EQ(palpa({"export", recorded, "--out", "a.csv"}, here.path()).exit_code, 0);
  ASSERT_EQ(palpa({"export", "B/session.palpa", "--out", "b.csv"}, here.path()).exit_code, 0);
  const std::string felt = contentOf(here / "a.csv"), again_felt = contentOf(here / "b.csv");
  EXPECT_GT(felt.size(), 1'000'000u);
  EXPECT_EQ(felt, again_felt) << "every tick: the same force";
  const Outcome refused = palpa(session({"--station", file, "--out", "C"}), here.path());
  EXPECT_EQ(refused.exit_code, 2);
  EXPECT_NE(refused.err.find("device/driver"), std::string::npos);
  EXPECT_EQ(refused.errLines(), 1);
}

TEST(StationSession, RealDevicesAreForPersons) {
  nlohmann::json mouse = benchStation();
  mouse["device"]["driver"] = "mouse";
  Folder here;
  for (const std::string& file : {here.file("mouse.json", mouse.dump()),
                                  std::string(PALPA_SOURCE_DIR "/assets/stations/falcon.json")}) {
    const Outcome o = palpa(session({"--station", file}), here.path());
    EXPECT_EQ(o.exit_code, 2) << file;
    EXPECT_NE(o.err.find("simulated operator cannot hold"), std::string::npos) << o.err;
    const Outcome alone = palpa(ofTheStation({"--station", file}), here.path());
    EXPECT_EQ(alone.exit_code, 2) << file << " is held by a person, who needs time and a window";
    EXPECT_EQ(alone.errLines(), 1);
  }
}

TEST(StationSession, AFasterLoopAndTheFullMeshComeToTheSameVerdict) {
  ASSERT_EQ(ordinary().outcome.exit_code, 0) << ordinary().outcome.err;
  const double total = std::stod(totalOf(ordinary().here / "A/trials.csv"));
  for (const std::vector<std::string>& how : {std::vector<std::string>{"--rate", "4000"},
                                              std::vector<std::string>{"--geometry", "exact"}}) {
    Folder here;
    std::vector<std::string> arguments{"--seed", kShortTrial, "--out", "A"};
    arguments.insert(arguments.end(), how.begin(), how.end());
    const Outcome o = palpa(session(arguments), here.path());
    ASSERT_EQ(o.exit_code, 0) << o.err;
    // The operator answers what he feels, so small differences of force lead to small ones of the
    // score.
    EXPECT_NEAR(std::stod(totalOf(here / "A/trials.csv")), total, 0.05 * total) << how[0];
    EXPECT_EQ(palpa({"replay", "A/session.palpa"}, here.path()).exit_code, 0) << how[0];
  }
  Folder here;
  EXPECT_EQ(palpa({"subclavian", "--geometry", "exact", "--operator", "expert", "--no-views"},
                  here.path())
                .exit_code,
            2)
      << "the full mesh takes longer than a tick: virtual time only";
}

TEST(StationSession, AForceSensorIsRecordedWithEveryTick) {
  nlohmann::json station = benchWithFewPictures();
  station["force_sensor"] = {
      {"driver", "virtual"},
      {"name", "six axes"},
      {"max_force_N", {40, 40, 120}},
      {"X_ES", {{"position_mm", {0, 0, 30}}, {"rotation_vector_deg", {0, 0, 0}}}},
      {"cutoff_Hz", 30},
      {"tool", {{"mass_g", 30}, {"centre_mm", {0, 0, 40}}}},
      {"bias", {{"force_N", {0.2, -0.1, 0.4}}, {"torque_Nm", {0, 0, 0}}}}};
  station["twin"]["force_sensor"] = {
      {"tool_mass_spread_percent", 2}, {"centre_spread_mm", 0.5}, {"bias_spread_N", 0.01},
      {"bias_spread_Nm", 0.0005},      {"noise_N", 0.01},         {"noise_Nm", 0.0003}};
  Folder here;
  const std::string file = here.file("station.json", station.dump());
  const Outcome o =
      palpa(session({"--station", file, "--seed", kShortTrial, "--out", "A"}), here.path());
  ASSERT_EQ(o.exit_code, 0) << o.err;
  ASSERT_EQ(palpa({"export", "A/session.palpa", "--out", "t.csv"}, here.path()).exit_code, 0);
  std::istringstream csv(contentOf(here / "t.csv"));
  std::string line;
  std::getline(csv, line);
  const std::vector<std::string> header = cellsOf(line);
  const auto at = [&](const char* name) {
    return std::find(header.begin(), header.end(), name) - header.begin();
  };
  int valid = 0, ticks = 0;
  double squares = 0;
  for (; std::getline(csv, line); ++ticks) {
    const std::vector<std::string> row = cellsOf(line);
    if (row.at(static_cast<std::size_t>(at("sensor"))) != "valid") continue;
    ++valid;
    for (const char* axis : {"f_sensed_D_x_N", "f_sensed_D_y_N", "f_sensed_D_z_N"})
      squares += std::pow(std::stod(row.at(static_cast<std::size_t>(at(axis)))), 2);
  }
  EXPECT_GT(ticks, 5000);
  EXPECT_GT(valid, ticks - 20);
  // Nothing real is touched: what is left of a 30 g tool (0.3 N) is calibration, noise and the
  // encoders' steps.
  EXPECT_LT(std::sqrt(squares / valid), 0.06);
  EXPECT_EQ(palpa({"replay", "A/session.palpa"}, here.path()).exit_code, 0);
}

TEST(StationSession, WhatADeviceLacksIsSaidInOneLine) {
  const std::pair<const char*, nlohmann::json> wrong[] = {{"device/driver", "gamepad"},
                                                          {"device/max_force_N", "much"},
                                                          {"device/continuous_force_N", 50}};
  for (const auto& [field, value] : wrong) {
    nlohmann::json station = benchStation();
    station[nlohmann::json::json_pointer("/" + std::string(field))] = value;
    Folder here;
    const Outcome o =
        palpa(session({"--station", here.file("s.json", station.dump())}), here.path());
    EXPECT_EQ(o.exit_code, 2) << field;
    EXPECT_EQ(o.errLines(), 1) << o.err;
    EXPECT_NE(o.err.find(field), std::string::npos) << o.err;
  }
}

}  // namespace
}  // namespace palpa::cli_test

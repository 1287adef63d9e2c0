#include <fstream>

#include "apps/doctor/station_check.h"
#include "apps/record/store/migrations.h"
#include "apps/record/store/record_store.h"
#include "says.h"
#include "tests/support/files.h"

namespace palpa::doctor {
namespace {

namespace fs = std::filesystem;

TEST(DoctorsStation, AFileThatCannotBeReadIsNamed) {
  const fs::path folder = test::freshFolder("doctor", "station");
  Findings findings;
  EXPECT_FALSE(readStation(folder / "nowhere.json", &findings));
  std::ofstream(folder / "damaged.json") << "{\"version\": 1,";
  EXPECT_FALSE(readStation(folder / "damaged.json", &findings));
  EXPECT_TRUE(readStation(station::assetFile("stations/virtual_bench.json"), &findings));
  ASSERT_EQ(findings.size(), 3u);
  for (std::size_t i = 0; i < 2; ++i) {
    EXPECT_EQ(findings[i].state, State::ill);
    EXPECT_FALSE(findings[i].fix.empty()) << findings[i].verdict;
  }
  EXPECT_EQ(findings[2].state, State::well);
}

station::AppliedCalibration calibration(const std::string& kind) {
  station::AppliedCalibration c;
  c.file.kind = station::calibrationKindNamed(kind).value();
  c.file.station = benchStation().id;
  c.file.date = "2026-03-01T12:30:00Z";
  c.file.valid_days = 90;
  c.file.verdict = "pass";
  c.sha256 = c.sha256_wanted = kind;
  return c;
}

TEST(DoctorsStation, EachCalibrationIsJudgedByItself) {
  station::Station station = benchStation();
  const std::string now = "2026-04-01T00:00:00Z";
  const auto judgedOne = [&](const std::function<void(station::AppliedCalibration&)>& change,
                             const std::string& at) {
    station.calibrations = {calibration("camera"), calibration("tool"),
                            calibration("registration")};
    station.calibrations[1].file.rests_on = {{"camera", "camera"}};
    change(station.calibrations[1]);
    const Findings findings = judgeCalibrations(station, at);
    EXPECT_EQ(findings.size(), 3u);
    EXPECT_EQ(findings[0].state, at == now ? State::well : State::note);
    return findings[1];
  };
  expectSays(judgedOne([](auto&) {}, now), State::well, "of 2026-03-01, good for 90 days");
  expectSays(judgedOne([](auto& c) { c.file.verdict = "fail: the tip is off by 3 mm"; }, now),
             State::note, "off by 3 mm");
  expectSays(judgedOne([](auto& c) { c.file.station = "another"; }, now), State::note,
             "belongs to station");
  expectSays(judgedOne([](auto& c) { c.sha256 = "changed"; }, now), State::note, "was replaced");
  expectSays(judgedOne([](auto& c) { c.file.rests_on[0].sha256 = "older"; }, now), State::note,
             "another camera calibration");
  expectSays(judgedOne([](auto& c) { c.file.date = "2027-01-01T00:00:00Z"; }, now), State::note,
             "still to come");
  expectSays(judgedOne([](auto&) {}, "2026-12-01T00:00:00Z"), State::note, "is outdated");
}

TEST(DoctorsRecords, WhatIsWrongWithThemIsNamedAndNothingIsMade) {
  const fs::path folder = test::freshFolder("doctor", "records");
  const std::string file = (folder / "records.sqlite").string();
  expectSays(askRecords(file, 0), State::well, "none so far");
  EXPECT_FALSE(fs::exists(file));
  { record::RecordStore store(file); }
  expectSays(askRecords(file, 0), State::well, "0 trainees in");
  expectSays(askRecords(file, 2), State::note, "2 sessions wait");
  std::ofstream(folder / "damaged.sqlite") << "this is no database at all";
  expectSays(askRecords((folder / "damaged.sqlite").string(), 0), State::note,
             "is not a records file");
  expectSays(askRecords("postgresql://nobody@127.0.0.1:9/none", 0), State::note, "127.0.0.1");
}

/// An empty file stays empty, an older one old: whoever only asks uses nothing.
TEST(DoctorsRecords, AreLookedAtAndNotUsed) {
  const fs::path folder = test::freshFolder("doctor", "looked_at");
  const std::string file = (folder / "records.sqlite").string();
  std::ofstream(file).close();
  expectSays(askRecords(file, 0), State::note, "is empty");
  EXPECT_EQ(fs::file_size(file), 0u);
  {
    const auto connection = record::connect(file);
    record::migrate(*connection, 1);
  }
  const std::string older = test::slurp(file);
  expectSays(askRecords(file, 0), State::note, "will be brought to the newest version");
  EXPECT_EQ(test::slurp(file), older);
  { record::connect(file)->query("UPDATE palpa_schema SET version=99"); }
  expectSays(askRecords(file, 0), State::note, "newer version of Palpa");
  EXPECT_EQ(std::distance(fs::directory_iterator(folder), {}), 1);
}

TEST(DoctorsPedal, IsThereOrIsNamed) {
  station::Station station = benchStation();
  expectSays(askPedal(station), State::absent, "none");
  station.stop_pedal = "/dev/null";
  expectSays(askPedal(station), State::ill, "has no keys");
  station.stop_pedal = "/dev/input/by-id/nowhere";
  expectSays(askPedal(station), State::ill, "is not there");
}

TEST(DoctorsBoard, ThePrintIsMeasuredOrHasBeen) {
  station::Station station = benchStation();
  expectSays(judgePrint(station, 0), State::well, "simulated");
  expectSays(judgePrint(station, 99.8), State::well, "99.8 mm");
  expectSays(judgePrint(station, 98.9), State::note, "1.1 % too small");
  expectSays(judgePrint(station, 95.2), State::ill, "4.8 % too small");
  expectSays(judgePrint(station, 103), State::ill, "3.0 % too large");
  station.camera_setup.driver = station::CameraDriver::webcam;
  expectSays(judgePrint(station, 0), State::note, "nobody has measured it");
  station.calibrations = {calibration("registration")};
  expectSays(judgePrint(station, 0), State::note, "nobody has measured it");
  station::addPose(station.calibrations[0].file, "X_EM", Pose::Identity());
  expectSays(judgePrint(station, 0), State::well, "at the registration of 2026-03-01");
  station.calibrations[0].file.verdict = "fail: it does not fit";
  expectSays(judgePrint(station, 0), State::note, "nobody has measured it");
}

}  // namespace
}  // namespace palpa::doctor

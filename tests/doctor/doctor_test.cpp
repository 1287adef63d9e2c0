#include <gtest/gtest.h>

#include <cstdlib>
#include <fstream>
#include <nlohmann/json.hpp>
#include <opencv2/imgproc.hpp>

#include "anatomy/geometry/error.h"
#include "apps/doctor/clock_check.h"
#include "apps/doctor/computer_check.h"
#include "apps/doctor/device_check.h"
#include "apps/doctor/picture_facts.h"
#include "apps/doctor/station_check.h"
#include "apps/record/store/migrations.h"
#include "apps/record/store/record_store.h"
#include "apps/station/assets.h"
#include "apps/twin/camera_faults.h"
#include "apps/twin/setup_bench.h"
#include "tests/support/files.h"

/// Each fault that a station can have is put before the doctor, and named; a healthy bench is called well.
namespace palpa::doctor {
namespace {

namespace fs = std::filesystem;

const station::Station& benchStation() {
  static const station::Station station = station::readStation(station::assetFile("stations/virtual_bench.json"));
  return station;
}

/// The bench's pictures, spoilt by `change`; taken once for all tests.
Findings lookedAt(const std::function<std::optional<ar::Frame>(ar::Frame)>& change, int count = 12) {
  static const std::vector<ar::Frame> frames = [] {
    twin::SetupBench bench(benchStation(), 3);
    std::vector<ar::Frame> taken;
    while (taken.size() < 12)
      if (const auto moment = bench.next(); moment && moment->picture)
        if (auto frame = moment->picture()) taken.push_back(*frame);
    return taken;
  }();
  const station::Station& s = benchStation();
  const auto board = ar::makeBoard(s.board, s.decimate);
  std::size_t next = 0;
  const auto grab = [&]() -> std::optional<ar::Frame> {
    if (next == frames.size()) return std::nullopt;
    ar::Frame frame = frames[next++];
    frame.image = frame.image.clone();
    return change(frame);
  };
  return judgePictures(lookAt(grab, count, *board, s.camera), s.camera_rate_Hz, s.camera);
}

Findings spoiltBy(twin::CameraFault::Kind kind) {
  return lookedAt([kind](ar::Frame frame) { return twin::spoilt(std::move(frame), {kind, 0, 1e9}); });
}

void expectSays(const Finding& finding, State state, const std::string& words) {
  EXPECT_EQ(finding.state, state) << finding.subject << ": " << finding.verdict;
  EXPECT_NE(finding.verdict.find(words), std::string::npos) << finding.verdict;
  EXPECT_EQ(finding.fix.empty(), state == State::well || state == State::absent) << finding.subject;
}

TEST(DoctorsPictures, OfAHealthyBenchAreWell) {
  for (const Finding& finding : lookedAt([](ar::Frame frame) { return std::optional(frame); })) {
    EXPECT_EQ(finding.state, State::well) << finding.subject << ": " << finding.verdict;
    RecordProperty(finding.subject, finding.verdict);
  }
}

TEST(DoctorsPictures, EveryFaultIsNamed) {
  using Kind = twin::CameraFault::Kind;
  expectSays(spoiltBy(Kind::black)[0], State::ill, "too dark");
  expectSays(spoiltBy(Kind::wrong_size)[0], State::ill, "does not give pictures of");
  expectSays(spoiltBy(Kind::ended)[0], State::ill, "no pictures");
  EXPECT_EQ(spoiltBy(Kind::gone)[0].state, State::ill);
  expectSays(spoiltBy(Kind::hidden)[1], State::ill, "is not seen");
  std::optional<ar::Frame> first;
  expectSays(lookedAt([&first](ar::Frame frame) {
               if (!first) first = frame;
               frame.image = first->image;
               return std::optional(frame);
             })[0],
             State::ill, "same picture");
  expectSays(lookedAt([](ar::Frame frame) {
               frame.image.convertTo(frame.image, -1, 1, 140);
               return std::optional(frame);
             })[0],
             State::ill, "too bright");
  expectSays(lookedAt([](ar::Frame frame) {
               cv::GaussianBlur(frame.image, frame.image, {}, 1.5);
               return std::optional(frame);
             })[0],
             State::note, "out of focus");
  expectSays(lookedAt([](ar::Frame frame) {
               frame.t_exposure_ns *= 3;
               return std::optional(frame);
             })[0],
             State::note, "pictures a second where");
  int n = 0;
  expectSays(lookedAt([&n](ar::Frame frame) {
               if (n++ % 2) frame.image.setTo(128);
               return std::optional(frame);
             })[1],
             State::note, "in 6 of 12 pictures only");
}

/// Another lens than the station's file says.
TEST(DoctorsPictures, AForeignCameraDoesNotFit) {
  const Findings found = lookedAt([](ar::Frame frame) {
    cv::Mat middle = frame.image.clone();
    for (int v = 0; v < middle.rows; ++v)   // bends what is straight
      cv::remap(frame.image.rowRange(v, v + 1), middle.rowRange(v, v + 1), [&] {
        cv::Mat x(1, middle.cols, CV_32F);
        for (int u = 0; u < middle.cols; ++u) x.at<float>(0, u) = static_cast<float>(u) + 8.F * static_cast<float>(std::sin(0.02 * v + 0.01 * u));
        return x;
      }(), cv::Mat::zeros(1, middle.cols, CV_32F), cv::INTER_LINEAR);
    frame.image = middle;
    return std::optional(frame);
  });
  EXPECT_NE(found[1].state, State::well) << found[1].verdict;
}

TEST(DoctorsDevice, EveryProblemOfAFalconIsNamed) {
  using haptics::FalconProblem;
  using haptics::FalconState;
  haptics::FalconStatus status;
  status.state = FalconState::ready;
  status.exchanges = 1000;
  expectSays(judgeFalcon(status), State::well, "knows where its grip is");
  status.missed = 100;
  expectSays(judgeFalcon(status), State::note, "had no answer");
  status.state = FalconState::homing;
  expectSays(judgeFalcon(status), State::note, "does not know where its grip is");
  status.state = FalconState::opening;
  expectSays(judgeFalcon(status), State::ill, "does not answer");
  for (const auto& [problem, words] : {std::pair{FalconProblem::absent, "is not there"}, {FalconProblem::denied, "may not be used by this user"}, {FalconProblem::busy, "in use by another program"},
                                       {FalconProblem::needs_firmware, "no firmware"}, {FalconProblem::upload_failed, "did not take the firmware"}, {FalconProblem::silent, "stopped answering"}}) {
    status.problem = problem;
    expectSays(judgeFalcon(status), State::ill, words);
  }
}

TEST(DoctorsDevice, FirmwareThatIsNotThereOrNoneIsNamed) {
  const fs::path folder = test::freshFolder("doctor", "firmware");
  station::DeviceSetup setup;
  setup.driver = station::DeviceDriver::falcon;
  EXPECT_EQ(askFirmware(setup).state, State::absent);
  setup.firmware = folder / "falcon.bin";
  expectSays(askFirmware(setup), State::ill, setup.firmware.string());
  std::ofstream(setup.firmware) << "a page that a browser saved";
  expectSays(askFirmware(setup), State::ill, setup.firmware.string());
  std::ofstream(setup.firmware) << std::string(8492, 'F');
  expectSays(askFirmware(setup), State::well, "8492 bytes");
}

/// As udev reads them: a file in an earlier folder hides one of its name.
TEST(DoctorsDevice, TheRuleOfUdevIsLookedForWhereUdevLooks) {
  const fs::path top = test::freshFolder("doctor", "udev"), etc = top / "etc", lib = top / "lib";
  const std::vector<fs::path> folders{etc, top / "nowhere", lib};
  expectSays(askUdevRule(folders), State::note, "there is none");
  fs::create_directories(etc);
  fs::create_directories(lib);
  std::ofstream(etc / "50-other.rules") << "ATTR{idVendor}==\"0403\", ATTR{idProduct}==\"6001\", GROUP=\"plugdev\"\n# 0403 cb48\n";
  expectSays(askUdevRule(folders), State::note, "there is none");
  fs::copy(station::assetFile("udev/60-palpa-falcon.rules"), lib);
  expectSays(askUdevRule(folders), State::well, (lib / "60-palpa-falcon.rules").string());
  std::ofstream{etc / "60-palpa-falcon.rules"};
  expectSays(askUdevRule(folders), State::note, "there is none");
  std::ofstream(etc / "60-palpa-falcon.rules") << "ATTR{idVendor}==\"0403\", ATTR{idProduct}==\"cb48\", MODE=\"0600\"\n";
  expectSays(askUdevRule(folders), State::note, "nobody but root");
}

TEST(DoctorsSensor, SilenceLossAndFaultsAreNamed) {
  expectSays(judgeSensor({500, 0, 0, 0.5, ""}), State::well, "1000 samples a second");
  expectSays(judgeSensor({0, 0, 0, 0.5, ""}), State::ill, "no samples");
  expectSays(judgeSensor({500, 30, 0, 0.5, ""}), State::note, "30 samples were lost");
  expectSays(judgeSensor({500, 0, 400, 0.5, ""}), State::ill, "overloaded or broken");
  station::Station station = benchStation();
  EXPECT_EQ(askSensor(station).state, station.force_sensor ? State::well : State::absent);
  station.force_sensor.emplace();
  station.force_sensor->driver = station::ForceSensorSetup::Driver::net_ft;
  station.force_sensor->net_ft.address = "127.0.0.1";   // nobody answers there
  station.force_sensor->net_ft.port = 9;
  station.force_sensor->net_ft.answer_tries = 1;
  EXPECT_EQ(askSensor(station).state, State::ill);
}

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
  c.file.kind = kind;
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
  const auto judgedOne = [&](const std::function<void(station::AppliedCalibration&)>& change, const std::string& at) {
    station.calibrations = {calibration("camera"), calibration("tool"), calibration("registration")};
    station.calibrations[1].file.rests_on = {{"camera", "camera"}};
    change(station.calibrations[1]);
    const Findings findings = judgeCalibrations(station, at);
    EXPECT_EQ(findings.size(), 3u);
    EXPECT_EQ(findings[0].state, at == now ? State::well : State::note);
    return findings[1];
  };
  expectSays(judgedOne([](auto&) {}, now), State::well, "of 2026-03-01, good for 90 days");
  expectSays(judgedOne([](auto& c) { c.file.verdict = "fail: the tip is off by 3 mm"; }, now), State::note, "off by 3 mm");
  expectSays(judgedOne([](auto& c) { c.file.station = "another"; }, now), State::note, "belongs to station");
  expectSays(judgedOne([](auto& c) { c.sha256 = "changed"; }, now), State::note, "was replaced");
  expectSays(judgedOne([](auto& c) { c.file.rests_on[0].sha256 = "older"; }, now), State::note, "another camera calibration");
  expectSays(judgedOne([](auto& c) { c.file.date = "2027-01-01T00:00:00Z"; }, now), State::note, "still to come");
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
  expectSays(askRecords((folder / "damaged.sqlite").string(), 0), State::note, "is no records file");
  expectSays(askRecords("postgresql://nobody@127.0.0.1:9/none", 0), State::note, "127.0.0.1");
}

/// An empty file stays empty, an older one old: whoever only asks uses nothing.
TEST(DoctorsRecords, AreLookedAtAndNotUsed) {
  const fs::path folder = test::freshFolder("doctor", "looked_at");
  const std::string file = (folder / "records.sqlite").string();
  std::ofstream{file};
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

TEST(DoctorsBoard, ThePrintIsMeasuredOrHasBeen) {
  station::Station station = benchStation();
  expectSays(judgePrint(station, 0), State::well, "simulated");
  expectSays(judgePrint(station, 99.8), State::well, "99.8 mm");
  expectSays(judgePrint(station, 98.9), State::note, "1.1 % too small");
  expectSays(judgePrint(station, 95.2), State::ill, "4.8 % too small");
  expectSays(judgePrint(station, 103), State::ill, "3.0 % too large");
  station.camera_setup.driver = station::CameraSetup::Driver::webcam;
  expectSays(judgePrint(station, 0), State::note, "nobody has measured it");
  station.calibrations = {calibration("registration")};
  expectSays(judgePrint(station, 0), State::note, "nobody has measured it");
  station::addPose(station.calibrations[0].file, "X_EM", Pose::Identity());
  expectSays(judgePrint(station, 0), State::well, "at the registration of 2026-03-01");
  station.calibrations[0].file.verdict = "fail: it does not fit";
  expectSays(judgePrint(station, 0), State::note, "nobody has measured it");
}

TEST(DoctorsComputer, ClocksThatDoNotAgreeAreNamed) {
  expectSays(judgeClocks({1, 1, 0.2, true}, {}, true), State::well, "kept by a time server");
  expectSays(judgeClocks({1, 1, 0.2, false}, {}, false), State::well, "the date goes with them");
  expectSays(judgeClocks({1, 1, 0.2, false}, {}, true), State::note, "no time server");
  expectSays(judgeClocks({1, 1, -3600'000, true}, {}, false), State::note, "was set by -3600000 ms");
  expectSays(judgeClocks({4'000'000, 1, 0, true}, {}, false), State::note, "steps by 4.0 ms");
  const ClockWatch watch;
  runtime::SteadyClock().sleepUntil(20 * runtime::kMillisecond);
  EXPECT_GT(watch.facts().seconds, 0.02);
  EXPECT_GT(watch.facts().resolution_ns, 0);
}

/// A real camera dates its pictures by the computer's clock; pictures that go back or come from elsewhere are told.
TEST(DoctorsPictures, TimesThatCannotBeAreNamed) {
  const station::Station& s = benchStation();
  const auto board = ar::makeBoard(s.board, s.decimate);
  const runtime::SteadyClock clock;
  const std::int64_t start = -clock.ofMonotonic(0);   // of CLOCK_MONOTONIC
  const auto seen = [&](const std::function<std::int64_t(int)>& stamp) {
    int n = 0;
    const auto grab = [&]() -> std::optional<ar::Frame> { return ar::Frame{static_cast<std::uint64_t>(n), stamp(n++), cv::Mat(480, 640, CV_8UC1, cv::Scalar(128)), "test"}; };
    return judgeClocks({}, lookAt(grab, 5, *board, s.camera, &clock), false);
  };
  runtime::SteadyClock().sleepUntil(10 * runtime::kMillisecond);
  expectSays(seen([&](int n) { return start + n * runtime::kMillisecond; }), State::well, "date");
  expectSays(seen([&](int n) { return start + (n == 3 ? 0 : n * runtime::kMillisecond); }), State::note, "go back in 1 of 5");
  expectSays(seen([&](int n) { return start - 100 * runtime::kSecond + n; }), State::note, "5 of 5 pictures by another clock");
  expectSays(seen([&](int n) { return start + 900 * runtime::kSecond + n; }), State::note, "5 of 5 pictures by another clock");
}

TEST(DoctorsPictures, WhatACameraDoesNotLetBeFixedIsNamed) {
  PictureFacts facts;
  facts.pictures = facts.seen = 10, facts.seconds = 0.6, facts.bright = 200, facts.edge_px = 2;
  facts.remark = "the camera does not let its exposure be fixed";
  expectSays(judgePictures(facts, 15, benchStation().camera)[0], State::note, "exposure be fixed");
}

TEST(DoctorsComputer, LoopDiskAndDateAreJudged) {
  expectSays(judgeLoop({"SCHED_FIFO", 1000, 40}, true), State::well, "in real time");
  expectSays(judgeLoop({"normal priority: SCHED_FIFO refused (Operation not permitted)", 1000, 40}, true), State::note, "normal priority");
  expectSays(judgeLoop({"SCHED_FIFO", 640, 900}, true), State::note, "will stutter");
  expectSays(judgeLoop({"SCHED_FIFO", 640, 900}, false), State::well, "virtual bench");
  expectSays(judgeLoop({"SCHED_FIFO", 1000, 40, "memory not locked: refused (Cannot allocate memory)"}, true), State::note, "put out to disk");
  EXPECT_GT(measureLoop().rate_Hz, 100);
  expectSays(judgeDisk({"/data", true, 50'000'000'000}), State::well, "50.0 GB free");
  expectSays(judgeDisk({"/data", true, 1'000'000'000}), State::note, "enough for some 80 trials");
  expectSays(judgeDisk({"/data", true, 100'000'000}), State::ill, "0.1 GB free");
  expectSays(judgeDisk({"/data", false, 50'000'000'000}), State::ill, "may not be written");
  EXPECT_GT(measureDisk("not/there/yet").free_bytes, 0u);
  expectSays(judgeDate("1970-01-01T00:03:00Z", "2026-01-01T00:00:00Z"), State::ill, "1970-01-01");
  expectSays(judgeDate("2027-01-01T00:03:00Z", "2026-01-01T00:00:00Z"), State::well, "2027-01-01 00:03");
}

TEST(DoctorsComputer, DrawingAndHeadset) {
  expectSays(askDrawing([] { return std::string("surfaceless EGL"); }), State::well, "surfaceless EGL");
  expectSays(askDrawing([]() -> std::string { throw Error("cannot be made", "OpenGL context", "Install a driver"); }), State::ill, "cannot be made");
  const fs::path folder = test::freshFolder("doctor", "headset");
  const auto runtime = [&](const std::string& text) {
    std::ofstream(folder / "runtime.json") << text;
    return judgeHeadset(folder / "runtime.json");
  };
  expectSays(judgeHeadset({}), State::absent, "no OpenXR runtime");
  expectSays(judgeHeadset(folder / "nowhere.json"), State::note, "cannot be read");
  expectSays(runtime("{"), State::note, "damaged");
  expectSays(runtime(R"({"runtime": {}})"), State::note, "names no library");
  expectSays(runtime(R"({"runtime": {"library_path": "./libxr.so"}})"), State::note, "not where its file says");
  std::ofstream(folder / "libxr.so") << "";
  expectSays(runtime(R"({"runtime": {"library_path": "./libxr.so"}})"), State::well, "libxr.so");
}

/// The variable as it was again at the end.
class Environment {
 public:
  Environment(const char* name, const char* value) : name_(name) {
    if (const char* before = std::getenv(name)) before_ = before;
    ::setenv(name, value, 1);
  }
  ~Environment() {
    if (before_) ::setenv(name_, before_->c_str(), 1);
    else ::unsetenv(name_);
  }

 private:
  const char* name_;
  std::optional<std::string> before_;
};

TEST(DoctorsComputer, ALanguageThatIsNotInstalledIsNamed) {
  {
    const Environment language("LC_ALL", "xx_YY.UTF-8");
    expectSays(askLocale(), State::note, "xx_YY");
  }
  {
    const Environment language("LC_ALL", "C.UTF-8");
    expectSays(askLocale(), State::well, "C.UTF-8");
  }
  EXPECT_EQ(askAssets().state, State::well);
}

TEST(Doctor, SaysWhetherASessionCanStart) {
  const Findings fine{{"a", State::well, "x"}, {"b", State::note, "y", "z"}, {"c", State::absent, "none"}};
  EXPECT_TRUE(canStart(fine));
  Findings ill = fine;
  ill.push_back({"d", State::ill, "broken <&\"", "mend"});
  EXPECT_FALSE(canStart(ill));
  const nlohmann::json json = nlohmann::json::parse(toJson(ill));
  EXPECT_EQ(json["can_start"], false);
  ASSERT_EQ(json["findings"].size(), 4u);
  EXPECT_EQ(json["findings"][3], (nlohmann::json{{"subject", "d"}, {"state", "ill"}, {"verdict", "broken <&\""}, {"fix", "mend"}}));
  const Finding torn = troubled("x", State::ill, "file a: is damaged. Restore it. Then go on");
  EXPECT_EQ(torn.verdict, "file a: is damaged");
  EXPECT_EQ(torn.fix, "Restore it. Then go on");
}

}  // namespace
}  // namespace palpa::doctor

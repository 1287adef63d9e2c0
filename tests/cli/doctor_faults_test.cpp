#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <fstream>
#include <opencv2/imgproc.hpp>

#include "apps/record/store/delivery.h"
#include "apps/record/store/migrations.h"
#include "apps/record/store/record_store.h"
#include "broken_bench.h"

/// Faults of a bench, each as far outside the program as can be: damaged files, spoilt pictures, a
/// sensor on the network, a system that refuses. The doctor names each, says what to do, and names
/// nothing else.
namespace palpa::cli_test {
namespace {

struct Fault {
  const char* name;
  const char* subject;
  const char* state;
  const char* words;  ///< of the verdict
  const char* fix;    ///< of what to do
  std::function<void(BrokenBench&)> inject;
  std::vector<std::string> also = {};  ///< subjects that must say something as well
};

void PrintTo(const Fault& fault, std::ostream* out) { *out << fault.name; }

const std::vector<std::string> kOfAFalcon{
    "haptic device", "permission (udev rule)", "calibrations",
    "forces (haptic loop)"};  // of the shipped station; that the computer may not refuse real time

const nlohmann::json kHere{{"position_mm", {0, 0, 0}}, {"rotation_vector_deg", {0, 0, 0}}};

void blur(cv::Mat& picture, int) { cv::GaussianBlur(picture, picture, {}, 1.6); }

void records(BrokenBench& b, const std::string& bytes) { b.here().file("records.sqlite", bytes); }

void recordsOf(BrokenBench& b, int version) {
  const auto connection = record::connect((b.here() / "records.sqlite").string());
  record::migrate(*connection, std::min(version, record::newestSchema()));
  if (version > record::newestSchema())
    connection->query("UPDATE palpa_schema SET version=" + std::to_string(version));
}

void falcon(BrokenBench& b) {
  b.station([](nlohmann::json&) {}, "falcon.json");
}

const std::vector<Fault>& pictureFaults() {
  static const std::vector<Fault> all{
      {"NoCamera",
       "camera",
       "ill",
       "/dev/video99",
       "Plug it in",
       [](BrokenBench& b) {
         b.station([](nlohmann::json& s) {
           s["camera"]["driver"] = "webcam", s["camera"]["device"] = "/dev/video99",
           s["camera"]["exposure_ms"] = 10;
         });
       },
       {"board", "board's print"}},
      {"DarkPictures",
       "camera",
       "ill",
       "too dark",
       "Take the cap off",
       [](BrokenBench& b) { b.pictures([](cv::Mat& p, int) { p *= 0.25; }); },
       {"board"}},
      {"BurntPictures",
       "camera",
       "ill",
       "too bright",
       "exposure_ms",
       [](BrokenBench& b) { b.pictures([](cv::Mat& p, int) { p.convertTo(p, -1, 1, 140); }); },
       {"board"}},
      {"BlurredPictures", "camera", "note", "out of focus", "Turn the lens's focus",
       [](BrokenBench& b) { b.pictures(blur); }},
      {"FrozenPictures", "camera", "ill", "same picture over and over", "Unplug the camera",
       [](BrokenBench& b) {
         b.pictures([first = cv::Mat()](cv::Mat& p, int i) mutable {
           i == 0 ? first = p.clone() : p = first;
         });
       }},
      {"PicturesOfAnotherSize",
       "camera",
       "ill",
       "640 x 480",
       "Calibrate this camera",
       [](BrokenBench& b) { b.pictures([](cv::Mat& p, int) {
                              cv::resize(p, p, {320, 240});
                            }); },
       {"board"}},
      {"DamagedPicture", "camera", "ill", "103.png", "",
       [](BrokenBench& b) {
         b.pictures([](cv::Mat&, int) {});
         std::ofstream(b.here() / "shots/103.png") << "torn";
       }},
      {"SlowPictures", "camera", "note", "5.0 pictures a second where 15.0", "USB port",
       [](BrokenBench& b) { b.film([](int i) { return i * std::int64_t{200'000'000}; }); }},
      {"TimesThatGoBack", "clocks", "note", "go back in 1 of 12", "Unplug the camera",
       [](BrokenBench& b) {
         b.film([](int i) { return (i == 5 ? 3 : i) * std::int64_t{66'666'667}; });
       }},
      {"CoveredBoard", "board", "ill", "is not seen", "Put the printed board",
       [](BrokenBench& b) {
         b.pictures([](cv::Mat& p, int i) { p.setTo(cv::Scalar::all(120 + i)); });
       }},
      {"BoardCoveredNowAndThen", "board", "note", "in 6 of 12 pictures only", "Move what hides it",
       [](BrokenBench& b) {
         b.pictures([](cv::Mat& p, int i) {
           if (i % 2) p.setTo(cv::Scalar::all(120 + i));
         });
       }},
      {"AnotherBoard", "board", "ill", "is not seen", "palpa board print",
       [](BrokenBench& b) {
         b.pictures([](cv::Mat&, int) {}),
             b.station([](nlohmann::json& s) { s["board"]["first_id"] = 300; });
       }},
      {"BoardThatBends", "board", "ill", "does not fit", "flat and undamaged",
       [](BrokenBench& b) {
         b.pictures([](cv::Mat& p, int) {
           cv::Mat x(p.size(), CV_32F), y(p.size(), CV_32F);
           for (int v = 0; v < p.rows; ++v)
             for (int u = 0; u < p.cols; ++u)
               x.at<float>(v, u) =
                   static_cast<float>(u) + 8.F * static_cast<float>(std::sin(0.02 * v + 0.01 * u)),
                              y.at<float>(v, u) = static_cast<float>(v);
           cv::remap(p.clone(), p, x, y, cv::INTER_LINEAR);
         });
       }},
      {"BoardPrintedTooSmall", "board's print", "ill", "4.0 % too small", "100 %",
       [](BrokenBench& b) { b.ask("--bar", "96"); }}};
  return all;
}

const std::vector<Fault>& deviceFaults() {
  static const std::vector<Fault> all{
      {"NoFalcon", "haptic device", "ill", "is not there", "Plug in", falcon, kOfAFalcon},
      {"FalconOfAnotherUser", "haptic device", "ill", "may not be used by this user", "udev",
       [](BrokenBench& b) { falcon(b), b.computer("usb denied"); }, kOfAFalcon},
      {"FalconInUse", "haptic device", "ill", "in use by another program", "Close that program",
       [](BrokenBench& b) { falcon(b), b.computer("usb busy"); }, kOfAFalcon},
      {"FalconWithoutFirmware", "haptic device", "ill", "has no firmware", "firmware file",
       [](BrokenBench& b) { falcon(b), b.computer("usb mute"); }, kOfAFalcon},
      {"FirmwareThatIsNotThere", "firmware", "ill", "falcon.bin", "",
       [](BrokenBench& b) {
         b.station([](nlohmann::json& s) { s["device"]["firmware"] = "falcon.bin"; },
                   "falcon.json");
       },
       kOfAFalcon},
      {"FirmwareThatIsNone", "firmware", "ill", "falcon.bin", "",
       [](BrokenBench& b) {
         b.here().file("falcon.bin", "<html>"),
             b.station([](nlohmann::json& s) { s["device"]["firmware"] = "falcon.bin"; },
                       "falcon.json");
       },
       kOfAFalcon},
      {"NoRealTime", "forces (haptic loop)", "note", "normal priority", "limits.d",
       [](BrokenBench& b) { falcon(b), b.computer("no real time"); }, kOfAFalcon},
      {"NoLockedMemory", "forces (haptic loop)", "note", "put out to disk", "limits.d",
       [](BrokenBench& b) { falcon(b), b.computer("no locked memory"); }, kOfAFalcon},
      {"BusyComputer", "forces (haptic loop)", "note", "will stutter", "lose",
       [](BrokenBench& b) { falcon(b), b.computer("busy computer"); }, kOfAFalcon},
      {"SilentForceSensor", "force sensor", "ill", "127.0.0.1", "",
       [](BrokenBench& b) { b.sensorAt(9); }},
      {"SilentTrackingSystem", "tracking system", "ill", "does not answer at 127.0.0.1, port 9",
       "PlusServer",
       [](BrokenBench& b) {
         b.station([](nlohmann::json& s) {
           s["tracker"] = {{"driver", "plus"}, {"host", "127.0.0.1"},
                           {"port", 9},        {"transform", "ReferenceToCamera"},
                           {"X_CK", kHere},    {"X_RW", kHere}};
         });
       }},
      {"LossyForceSensor", "force sensor", "note", "samples were lost", "cable of its own",
       [](BrokenBench& b) { b.sensor(3, 0); }},
      {"BrokenForceSensor", "force sensor", "ill", "overloaded or broken", "Take the load off",
       [](BrokenBench& b) { b.sensor(1, 0x80000000); }}};
  return all;
}

const std::vector<Fault>& stationFaults() {
  static const std::vector<Fault> all{
      {"StationFileThatIsNotThere", "station", "ill", "nowhere.json", "",
       [](BrokenBench& b) { b.ask("--station", "nowhere.json"); }},
      {"DamagedStationFile", "station", "ill", "damaged.json", "",
       [](BrokenBench& b) {
         b.ask("--station", b.here().file("damaged.json", "{\"version\": 1,"));
       }},
      {"StationFileWithAnImpossibleFigure", "station", "ill", "device/max_force_N", "",
       [](BrokenBench& b) {
         b.station([](nlohmann::json& s) { s["device"]["max_force_N"] = -3; });
       }},
      {"FailedCalibration", "tool calibration", "note", "the tip is 3 mm off", "palpa calibrate",
       [](BrokenBench& b) { b.calibration([](auto& c) { c.verdict = "the tip is 3 mm off"; }); }},
      {"OutdatedCalibration", "tool calibration", "note", "is outdated", "palpa calibrate",
       [](BrokenBench& b) { b.calibration([](auto& c) { c.valid_days = 1; }); }},
      {"CalibrationOfTheFuture", "tool calibration", "note", "still to come", "palpa calibrate",
       [](BrokenBench& b) { b.calibration([](auto& c) { c.date = "2199-03-01T12:30:00Z"; }); }},
      {"CalibrationOfAnotherStation", "tool calibration", "note", "belongs to station",
       "palpa calibrate",
       [](BrokenBench& b) { b.calibration([](auto& c) { c.station = "another"; }); }},
      {"ReplacedCalibration", "tool calibration", "note", "was replaced", "palpa calibrate",
       [](BrokenBench& b) {
         const auto path = b.calibration([](auto&) {});
         station::CalibrationFile other = station::readCalibration(path);
         other.date = "2026-04-01T12:30:00Z";
         station::writeCalibration(other, path);
       }},
      {"CalibrationThatRestsOnAnother", "tool calibration", "note", "another camera calibration",
       "palpa calibrate",
       [](BrokenBench& b) { b.calibration([](auto& c) {
                              c.rests_on = {{"camera", "abc"}};
                            }); }},
      {"DamagedCalibration", "station", "ill", "tool.json", "",
       [](BrokenBench& b) { std::ofstream(b.calibration([](auto&) {}), std::ios::app) << "x"; }},
      {"CalibrationFileThatIsGone", "station", "ill", "tool.json", "",
       [](BrokenBench& b) { std::filesystem::remove(b.calibration([](auto&) {})); }},
      {"NoCalibration", "calibrations", "note", "", "palpa calibrate", [](BrokenBench& b) {
         b.station([](nlohmann::json& s) { s["calibration"]["verdict"] = "never calibrated"; });
       }}};
  return all;
}

const std::vector<Fault>& computerFaults() {
  static const std::vector<Fault> all{
      {"DataThatAreNotThere", "program's files", "ill", "PALPA_ASSETS", "Correct PALPA_ASSETS",
       [](BrokenBench& b) { b.set("PALPA_ASSETS", b.here().path().string()); }},
      {"NoOpenGL", "pictures", "ill", "no way to draw", "--no-views",
       [](BrokenBench& b) { b.set("__EGL_VENDOR_LIBRARY_DIRS", b.here().path().string()); }},
      {"DamagedOpenXR", "headset", "note", "is damaged", "OpenXR runtime again",
       [](BrokenBench& b) { b.set("XR_RUNTIME_JSON", b.here().file("runtime.json", "{")); }},
      {"OpenXRThatIsGone", "headset", "note", "not where its file says", "OpenXR runtime again",
       [](BrokenBench& b) {
         std::filesystem::create_directories(b.here() / "config/openxr/1");
         b.here().file(
             "config/openxr/1/active_runtime.json",
             R"({"file_format_version": "1.0.0", "runtime": {"library_path": "./libgone.so"}})");
       }},
      {"DamagedRecords", "records", "note", "is not a records file", "backup",
       [](BrokenBench& b) {
         records(b, "this is no database, and long enough to be told from one");
       }},
      {"EmptyRecords", "records", "note", "is empty", "palpa records restore",
       [](BrokenBench& b) { records(b, ""); }},
      {"OlderRecords", "records", "note", "brought to the newest version", "palpa records migrate",
       [](BrokenBench& b) { recordsOf(b, 1); }},
      {"NewerRecords", "records", "note", "newer version of Palpa", "Update Palpa",
       [](BrokenBench& b) { recordsOf(b, 99); }},
      {"RecordsServerThatIsAway",
       "records",
       "note",
       "127.0.0.1",
       "Check network and server",
       [](BrokenBench& b) { b.records("postgresql://nobody@127.0.0.1:9/none"); },
       {"clocks"}},  // that a time server keeps this computer's date is not said
      {"SessionThatWaits", "records", "note", "one session waits", "palpa records deliver",
       [](BrokenBench& b) {
         recordsOf(b, record::newestSchema());
         record::PendingList(b.here() / "state/palpa/pending")
             .note({"3f1c0a52-7f0e-4a27-9c55-2f4f5d7a1b11", b.here() / "session.palpa",
                    (b.here() / "records.sqlite").string()});
       }},
      {"FullDisk", "disk", "ill", "0.0 GB free", "Free the disk",
       [](BrokenBench& b) { b.computer("full disk"); }},
      {"NearlyFullDisk", "disk", "note", "0.7 GB free", "before a course",
       [](BrokenBench& b) { b.computer("nearly full disk"); }},
      {"ReadOnlyDisk", "disk", "ill", "may not be written", "--out",
       [](BrokenBench& b) { b.computer("read-only disk"); }},
      {"DateOfLongAgo",
       "date",
       "ill",
       "1973",
       "Set the computer's date",
       [](BrokenBench& b) { b.computer("date of long ago"); },
       {"clocks"}},
      {"DateThatIsSetMeanwhile", "clocks", "note", "date was set by", "timedatectl",
       [](BrokenBench& b) { b.computer("date is set"); }},
      {"CoarseClock", "clocks", "note", "steps by 4.0 ms", "high-resolution",
       [](BrokenBench& b) { b.computer("coarse clock"); }},
      {"DatesOfSeveralStations",
       "clocks",
       "note",
       "no time server",
       "timedatectl",
       [](BrokenBench& b) {
         b.computer("no time server"), b.records("postgresql://nobody@127.0.0.1:9/none");
       },
       {"records"}},
      {"UnknownLanguage", "language", "note", "xx_YY", "LC_ALL",
       [](BrokenBench& b) { b.set("LC_ALL", "xx_YY.UTF-8"); }}};
  return all;
}

class DoctorFault : public testing::TestWithParam<Fault> {};

TEST_P(DoctorFault, IsNamedWithWhatToDoAndNothingElse) {
  const Fault& fault = GetParam();
  BrokenBench bench;
  fault.inject(bench);
  const std::filesystem::path kept = bench.here() / "records.sqlite";
  const bool were_kept = std::filesystem::exists(kept);
  const std::string before = were_kept ? contentOf(kept) : "";
  const Outcome outcome = bench.outcome();
  const nlohmann::json answer = nlohmann::json::parse(outcome.out, nullptr, false);
  ASSERT_FALSE(answer.is_discarded()) << outcome.out << outcome.err;
  bool named = false, ill = false;
  for (const nlohmann::json& finding : answer["findings"]) {
    ill |= finding["state"] == "ill";
    if (finding["subject"] != fault.subject) {
      const bool expected = std::count(fault.also.begin(), fault.also.end(),
                                       finding["subject"].get<std::string>()) > 0;
      EXPECT_TRUE(expected || finding["state"] == "well" || finding["state"] == "none")
          << finding.dump(1);
      continue;
    }
    named = true;
    EXPECT_EQ(finding["state"], fault.state) << finding.dump(1);
    EXPECT_TRUE(says(finding["verdict"], fault.words)) << finding.dump(1);
    EXPECT_NE(finding["fix"], "") << finding.dump(1);
    EXPECT_TRUE(says(finding["fix"], fault.fix)) << finding.dump(1);
  }
  EXPECT_TRUE(named) << answer.dump(1);
  EXPECT_EQ(answer["can_start"], !ill);
  EXPECT_EQ(outcome.exit_code, ill ? 1 : 0) << outcome.err;
  EXPECT_EQ(std::filesystem::exists(kept), were_kept);
  EXPECT_EQ(were_kept ? contentOf(kept) : "", before) << "not a byte of the records may change";
}

/// The same benches with nothing broken on them: it is the fault that is named.
TEST(DoctorFaults, WithoutThemTheSameBenchesAreWell) {
  const std::vector<std::function<void(BrokenBench&)>> benches{
      [](BrokenBench& b) { b.pictures([](cv::Mat&, int) {}), b.calibration([](auto&) {}); },
      [](BrokenBench& b) {
        b.film([](int i) { return i * std::int64_t{66'666'667}; }), b.ask("--bar", "99.8"),
            recordsOf(b, record::newestSchema());
      },
      [](BrokenBench& b) { b.sensor(1, 0), b.computer("none of them"); }};
  for (const auto& prepare : benches) {
    BrokenBench bench;
    prepare(bench);
    const Outcome outcome = bench.outcome();
    EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
    const nlohmann::json answer = nlohmann::json::parse(outcome.out, nullptr, false);
    ASSERT_FALSE(answer.is_discarded()) << outcome.err;
    EXPECT_GE(answer["findings"].size(), 14u);
    for (const nlohmann::json& finding : answer["findings"])
      EXPECT_TRUE(finding["state"] == "well" || finding["state"] == "none") << finding.dump(1);
  }
}

std::string nameOf(const testing::TestParamInfo<Fault>& info) { return info.param.name; }
INSTANTIATE_TEST_SUITE_P(Pictures, DoctorFault, testing::ValuesIn(pictureFaults()), nameOf);
INSTANTIATE_TEST_SUITE_P(Devices, DoctorFault, testing::ValuesIn(deviceFaults()), nameOf);
INSTANTIATE_TEST_SUITE_P(Station, DoctorFault, testing::ValuesIn(stationFaults()), nameOf);
INSTANTIATE_TEST_SUITE_P(Computer, DoctorFault, testing::ValuesIn(computerFaults()), nameOf);

}  // namespace
}  // namespace palpa::cli_test

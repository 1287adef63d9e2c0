#include "broken_bench.h"

#include <cstdlib>
#include <fstream>
#include <opencv2/imgcodecs.hpp>

#include "anatomy/base/sha256.h"
#include "apps/runtime/clock.h"
#include "apps/station/assets.h"
#include "apps/station/calibrations.h"
#include "apps/twin/setup_bench.h"

namespace palpa::cli_test {
namespace {

constexpr int kFrames = 12;

nlohmann::json shippedStation(const std::string& name) {
  return nlohmann::json::parse(
      contentOf(std::string(PALPA_SOURCE_DIR) + "/assets/stations/" + name));
}

/// What the bench's camera sees before anybody does anything.
std::vector<cv::Mat> benchPictures() {
  twin::SetupBench bench(station::readStation(station::assetFile("stations/virtual_bench.json")),
                         3);
  std::vector<cv::Mat> taken;
  while (taken.size() < kFrames)
    if (const auto moment = bench.next(); moment && moment->picture)
      if (const auto frame = moment->picture()) taken.push_back(frame->image.clone());
  return taken;
}

}  // namespace

BrokenBench::BrokenBench() {
  set("LC_ALL", "C.UTF-8");  // of this computer's own state only what a test is about
  set("XDG_STATE_HOME", (here_ / "state").string());
  set("XDG_CONFIG_HOME", (here_ / "config").string());
}

BrokenBench::~BrokenBench() {
  over_ = true;
  if (sender_.joinable()) sender_.join();
  for (const std::string& variable : variables_) ::unsetenv(variable.c_str());
}

void BrokenBench::ask(const std::string& option, const std::string& value) {
  arguments_.push_back(option);
  arguments_.push_back(value);
}

void BrokenBench::set(const std::string& variable, const std::string& value) {
  ::setenv(variable.c_str(), value.c_str(), 1);
  variables_.push_back(variable);
}

void BrokenBench::computer(const std::string& fault) {
  set("LD_PRELOAD", PALPA_TEST_FAULTS);
  set("PALPA_FAULT", fault);
}

void BrokenBench::station(const std::function<void(nlohmann::json&)>& change,
                          const std::string& shipped) {
  nlohmann::json station = shippedStation(shipped);
  change(station);
  ask("--station", here_.file("station.json", station.dump()));
}

void BrokenBench::pictures(const std::function<void(cv::Mat&, int)>& change) {
  std::filesystem::create_directory(here_ / "shots");
  int i = 0;
  for (cv::Mat& picture : benchPictures()) {
    change(picture, i);
    cv::imwrite((here_ / ("shots/" + std::to_string(100 + i++) + ".png")).string(), picture);
  }
  ask("--camera", (here_ / "shots").string() + "/*.png");
}

void BrokenBench::film(const std::function<std::int64_t(int)>& exposed_ns) {
  std::ofstream film(here_ / "film.mjpeg", std::ios::binary), table(here_ / "film.mjpeg.csv");
  table << "number,t_exposure_ns\n";
  int i = 0;
  for (const cv::Mat& picture : benchPictures()) {
    std::vector<std::uint8_t> jpeg;
    cv::imencode(".jpg", picture, jpeg, {cv::IMWRITE_JPEG_QUALITY, 98});
    film.write(reinterpret_cast<const char*>(jpeg.data()),
               static_cast<std::streamsize>(jpeg.size()));
    table << i << ',' << exposed_ns(i) << '\n';
    ++i;
  }
  ask("--camera", (here_ / "film.mjpeg").string());
}

void BrokenBench::sensor(std::uint32_t step, std::uint32_t status) {
  sensor_ = std::make_unique<haptics::FakeNetFt>(haptics::recordBytes(1, 100, status));
  sender_ = std::thread([this, step, status] {
    const runtime::SteadyClock clock;
    while (!over_ && sensor_->requests().empty())
      clock.sleepUntil(clock.now() + runtime::kMillisecond);
    std::uint32_t number = 1;  // what it answered to the request
    for (std::int64_t due = clock.now() + 5 * runtime::kMillisecond; !over_;
         due += runtime::kMillisecond) {
      clock.sleepUntil(due);
      number += step;
      sensor_->send(haptics::recordBytes(number, 100 + number, status));
    }
  });
  sensorAt(sensor_->port());
}

nlohmann::json BrokenBench::netFtAt(int port) {
  const nlohmann::json nowhere = {0, 0, 0};
  return {{"driver", "net_ft"},
          {"name", "six axes"},
          {"address", "127.0.0.1"},
          {"port", port},
          {"counts_per_N", 1000000},
          {"counts_per_Nm", 1000000},
          {"max_force_N", {40, 40, 120}},
          {"cutoff_Hz", 60},
          {"X_ES", {{"position_mm", {0, 0, 80}}, {"rotation_vector_deg", nowhere}}},
          {"tool", {{"mass_g", 30}, {"centre_mm", {0, 0, 20}}}},
          {"bias", {{"force_N", nowhere}, {"torque_Nm", nowhere}}}};
}

void BrokenBench::sensorAt(int port) {
  station([&](nlohmann::json& s) { s["force_sensor"] = netFtAt(port); });
}

std::filesystem::path BrokenBench::calibration(
    const std::function<void(station::CalibrationFile&)>& change) {
  station::AppliedCalibration tool;
  station::CalibrationFile& file = tool.file;
  file.kind = station::CalibrationKind::tool, file.station = "virtual-bench",
  file.date = "2026-03-01T12:30:00Z", file.made_by = "palpa calibrate tool",
  file.valid_days = 36'500, file.verdict = "pass";
  station::addPose(file, "X_ET", makePose(Mat3::Identity(), Vec3(0, 0, 0.11)));
  for (const char* name :
       {"turn_x_rad", "turn_y_rad", "turn_z_rad", "shift_x_m", "shift_y_m", "shift_z_m"})
    file.coordinates.push_back(name);
  file.covariance = 1e-9 * Eigen::MatrixXd::Identity(6, 6);
  file.residuals = {"m", 1e-4, {1e-4, 1e-4}, {}};
  file.data = {300, 300, "recorded files", {}};
  file.checks = {{"the tip's uncertainty", 0.01, 0.25, "mm"}};
  change(file);
  tool.path = here_ / "tool.json";
  station::writeCalibration(file, tool.path);
  tool.sha256 = sha256OfFile(tool.path);
  station([&](nlohmann::json& s) { s["calibrations"] = station::toJson({tool}, here_.path()); });
  return tool.path;
}

Outcome BrokenBench::outcome() const {
  std::vector<std::string> arguments{"doctor", "--json", "--records", records_};
  arguments.insert(arguments.end(), arguments_.begin(), arguments_.end());
  return palpa(arguments, here_.path());
}

}  // namespace palpa::cli_test

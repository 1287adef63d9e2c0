#pragma once

#include <atomic>
#include <functional>
#include <memory>
#include <nlohmann/json.hpp>
#include <opencv2/core.hpp>
#include <string>
#include <thread>
#include <vector>

#include "apps/station/calibration_file.h"
#include "program.h"
#include "tests/sensors/fake_net_ft.h"

namespace palpa::cli_test {

/// A bench on which something is broken before `palpa doctor` is asked: files, pictures, a sensor
/// on the loopback, the system's own answers.
class BrokenBench {
 public:
  /// A Net F/T at this port of this computer, as a station's file names it.
  static nlohmann::json netFtAt(int port);

  BrokenBench();
  ~BrokenBench();
  BrokenBench(const BrokenBench&) = delete;
  BrokenBench& operator=(const BrokenBench&) = delete;

  const Folder& here() const { return here_; }
  void ask(const std::string& option, const std::string& value);  ///< of doctor
  /// In place of records.sqlite in its folder
  void records(const std::string& url) { records_ = url; }
  void set(const std::string& variable,
           const std::string& value);  ///< of the environment, to this bench's end

  /// One of the answers of tests/computer_faults.
  void computer(const std::string& fault);
  /// The virtual bench's station file with a change, or a shipped one.
  void station(const std::function<void(nlohmann::json&)>& change,
               const std::string& shipped = "virtual_bench.json");
  /// The bench's pictures in place of its camera's, spoilt by `change` (0: the first of twelve), as
  /// files.
  void pictures(const std::function<void(cv::Mat&, int)>& change);
  /// The same as a film whose pictures were exposed at these times.
  void film(const std::function<std::int64_t(int)>& exposed_ns);
  /// A Net F/T that sends a thousand records a second: every `step`th number, with this status.
  void sensor(std::uint32_t step, std::uint32_t status);
  void sensorAt(int port);  ///< where nobody need answer
  /// A tool calibration, in order but for `change`, to which the station's file refers; its file.
  std::filesystem::path calibration(const std::function<void(station::CalibrationFile&)>& change);

  Outcome outcome() const;

 private:
  Folder here_;
  std::string records_ = "records.sqlite";
  std::vector<std::string> arguments_;
  std::vector<std::string> variables_;
  std::unique_ptr<haptics::FakeNetFt> sensor_;
  std::thread sender_;
  std::atomic<bool> over_{false};
};

}  // namespace palpa::cli_test

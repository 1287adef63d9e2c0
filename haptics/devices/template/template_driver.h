#pragma once

#include <cstdint>
#include <string>

#include "haptics/devices/driver.h"
#include "haptics/devices/serial_line.h"
#include "haptics/latest_value.h"

namespace palpa::haptics {

/// What keeps it from going on; 0 is nothing.
enum class TemplateProblem : std::uint8_t { none, absent, denied, silent, line };

/// 2 N, 600 N/m, 1 um: of a device that does not exist.
DeviceCapabilities templateCapabilities();

/// A made-up stylus on a serial port, to begin a driver from. Once in every exchange the host sends
/// "FX FY FZ", the force in whole millinewtons, and the device answers "X Y Z HOMED", its place in
/// whole micrometres in D and whether that is known: 1 or 0.
class TemplateDriver final : public Driver {
 public:
  explicit TemplateDriver(std::string port) : line_(std::move(port)) {}

  const DeviceCapabilities& capabilities() const override { return capabilities_; }
  DeviceReading read(std::int64_t) noexcept override { return readings_.read(); }
  void command(std::int64_t now_ns, const Packed3& f_D) noexcept override {
    commands_.write({now_ns, f_D});
  }

  void open() noexcept override;
  std::int64_t step(std::int64_t now_ns) noexcept override;
  void close() noexcept override;
  DriverStatus status() noexcept override { return statuses_.read(); }
  std::string words(const DriverStatus& status) const override;

 private:
  struct ForceCommand {
    std::int64_t t_ns = 0;
    Packed3 f_D{0, 0, 0};
  };
  void connect(std::int64_t now_ns) noexcept;
  void exchange(std::int64_t now_ns) noexcept;
  Packed3 forceNow(std::int64_t now_ns) noexcept;
  bool take(std::string_view answer, std::int64_t now_ns) noexcept;
  void miss(std::int64_t now_ns, SerialStatus status) noexcept;
  void publish() noexcept;

  const DeviceCapabilities capabilities_ = templateCapabilities();
  SerialLine line_;
  DriverStatus status_;  // these: the device thread's
  DeviceReading reading_;
  std::int64_t due_ns_ = 0;
  int missed_in_a_row_ = 0;
  bool answered_ = false;
  LatestValue<DeviceReading> readings_;
  LatestValue<ForceCommand> commands_;
  LatestValue<DriverStatus> statuses_;
};

}  // namespace palpa::haptics

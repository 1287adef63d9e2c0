#pragma once

#include <deque>

#include "falcon_twin.h"
#include "haptics/devices/usb_transport.h"

namespace palpa::test {

/// The twin behind the driver's own transport: every request answered at once, faults on demand.
class ScriptedUsb final : public haptics::UsbTransport {
 public:
  using Status = haptics::UsbStatus;
  explicit ScriptedUsb(FalconTwin& twin) : twin_(twin) {}

  Status open_answer = Status::ok;
  std::deque<Status> in_faults;  ///< the next reads fail so
  bool plugged = true;
  int opened = 0, closed = 0, controls = 0;

  void unplug() { plugged = open_ = false; }

  Status open() noexcept override {
    open_ = plugged && open_answer == Status::ok;
    opened += open_;
    return plugged ? open_answer : Status::gone;
  }
  void close() noexcept override {
    closed += open_;
    open_ = false;
  }
  Status control(const haptics::UsbControl& request, unsigned) noexcept override {
    if (!open_) return Status::gone;
    ++controls;
    const std::scoped_lock lock(twin_.mutex);
    twin_.control(request.request, request.value);
    return Status::ok;
  }
  Status bulkOut(std::span<const std::uint8_t> bytes, unsigned) noexcept override {
    if (!open_) return Status::gone;
    const std::scoped_lock lock(twin_.mutex);
    twin_.out(bytes);
    return Status::ok;
  }
  Status bulkIn(std::span<std::uint8_t> into, std::size_t& got, unsigned) noexcept override {
    got = 0;
    if (!open_) return Status::gone;
    if (!in_faults.empty()) {
      const Status fault = in_faults.front();
      in_faults.pop_front();
      return fault;
    }
    const std::scoped_lock lock(twin_.mutex);
    const Bytes packet = twin_.in();
    got = std::min(packet.size(), into.size());
    std::copy_n(packet.begin(), got, into.begin());
    return Status::ok;
  }

 private:
  FalconTwin& twin_;
  bool open_ = false;
};

}  // namespace palpa::test

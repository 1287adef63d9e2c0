#pragma once

#include <umockdev.h>

#include <atomic>
#include <deque>
#include <memory>
#include <string>

#include "tests/devices/falcon_twin.h"

struct usbdevfs_urb;

namespace palpa::test {

/// The twin as a device of an emulated kernel: what libusb asks of /dev/bus/usb is answered here,
/// in umockdev's thread. Make it before anything of libusb.
class EmulatedUsb {
 public:
  /// Why it cannot work in this process; empty: it can.
  static const char* missing();

  /// `place`: 1, 2, ...: which port it is plugged into.
  explicit EmulatedUsb(FalconTwin& twin, int place = 1);
  ~EmulatedUsb();  // NOLINT(bugprone-exception-escape)
  EmulatedUsb(const EmulatedUsb&) = delete;
  EmulatedUsb& operator=(const EmulatedUsb&) = delete;

  void plugIn();
  void unplug();

  std::atomic<int> stalls{0};             ///< so many of the next reads stall
  std::atomic<int> silences{0};           ///< so many of the next reads are not answered at all
  std::atomic<bool> held{false};          ///< another program has the interface
  std::atomic<bool> kernel_driver{true};  ///< the kernel's serial driver has it
  std::atomic<int> cleared_halts{0};
  std::atomic<int> claims{0}, releases{0};

 private:
  /// A request of libusb that has not been handed back yet.
  struct Request {
    UMockdevIoctlData* urb = nullptr;
    UMockdevIoctlData* bytes = nullptr;
    bool done = false;
    usbdevfs_urb& header() const;
  };
  static gboolean handle(UMockdevIoctlBase*, UMockdevIoctlClient* client, EmulatedUsb* self);
  void answer(UMockdevIoctlClient* client);
  int bindKernelDriver(UMockdevIoctlData* argument);
  int submit(UMockdevIoctlData* argument);
  int reap(UMockdevIoctlData* argument);
  int discard(UMockdevIoctlData* argument);
  void carryOut(Request& request);
  void giveBack(const std::deque<Request>::iterator& request);

  FalconTwin& twin_;
  std::string node_, sys_path_, description_;
  std::shared_ptr<UMockdevTestbed> testbed_;
  std::atomic<bool> claimed_{false};
  UMockdevIoctlBase* ioctls_;
  std::atomic<bool> plugged_{false};
  std::deque<Request> requests_;  // umockdev's thread only
};

}  // namespace palpa::test

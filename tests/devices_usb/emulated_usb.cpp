#include "emulated_usb.h"

// First: the next one needs its macros.
#include <sys/ioctl.h>

#include <linux/usbdevice_fs.h>

#include <algorithm>
#include <cerrno>
#include <cstddef>
#include <cstdlib>
#include <cstring>
#include <stdexcept>
#include <string>

namespace palpa::test {
namespace {

// Device 0403:cb48; one configuration, one interface, bulk endpoints 0x81 and 0x02 of 64 bytes.
const std::string kDescriptors =
    "12010002000000400304"
    "48CB"
    "00060102"
    "0001"
    "0902200001010080"
    "2D"
    "0904000002FFFFFF00"
    "07058102400000"
    "07050202400000";

std::string describe(const std::string& node, const std::string& sys_path, int number) {
  return "P: " + sys_path.substr(4) + "\nN: " + node.substr(5) + "=" + kDescriptors +
         "\nE: DEVNAME=" + node +
         "\nE: DEVTYPE=usb_device\nE: SUBSYSTEM=usb\nE: BUSNUM=001\nE: DEVNUM=00" +
         std::to_string(number) +
         "\nA: bConfigurationValue=1\\n\nA: busnum=1\\n\nA: devnum=" + std::to_string(number) +
         "\\n\nA: speed=12\\n\nH: descriptors=" + kDescriptors + "\n";
}

/// One for all devices that are plugged in at a time.
std::shared_ptr<UMockdevTestbed> sharedTestbed() {
  static std::weak_ptr<UMockdevTestbed> shared;
  std::shared_ptr<UMockdevTestbed> testbed = shared.lock();
  if (!testbed) {
    testbed.reset(umockdev_testbed_new(), [](UMockdevTestbed* t) { g_object_unref(t); });
    shared = testbed;
  }
  return testbed;
}

void need(bool done, GError* error) {
  if (!done) throw std::runtime_error(error ? error->message : "umockdev refused");
}

}  // namespace

const char* EmulatedUsb::missing() {
  const char* preloaded = std::getenv("LD_PRELOAD");
  return preloaded && std::strstr(preloaded, "umockdev") ? "" : "umockdev-wrapper is missing";
}

usbdevfs_urb& EmulatedUsb::Request::header() const {
  return *reinterpret_cast<usbdevfs_urb*>(urb->data);
}

EmulatedUsb::EmulatedUsb(FalconTwin& twin, int place)
    : twin_(twin),
      node_("/dev/bus/usb/001/00" + std::to_string(1 + place)),
      sys_path_("/sys/devices/falcon/usb1/1-" + std::to_string(place)),
      description_(describe(node_, sys_path_, 1 + place)),
      testbed_(sharedTestbed()),
      ioctls_(umockdev_ioctl_base_new()) {
  g_signal_connect(ioctls_, "handle-ioctl", G_CALLBACK(&EmulatedUsb::handle), this);
  plugIn();
}

// A fault of the emulation ends the test program.
EmulatedUsb::~EmulatedUsb() {  // NOLINT(bugprone-exception-escape)
  if (plugged_) unplug();
  testbed_.reset();
  while (!requests_.empty()) giveBack(requests_.begin());
  g_object_unref(ioctls_);
}

void EmulatedUsb::plugIn() {
  GError* error = nullptr;
  need(umockdev_testbed_add_from_string(testbed_.get(), description_.c_str(), &error), error);
  need(umockdev_testbed_attach_ioctl(testbed_.get(), node_.c_str(), ioctls_, &error), error);
  plugged_ = true;
  umockdev_testbed_uevent(testbed_.get(), sys_path_.c_str(), "add");
}

void EmulatedUsb::unplug() {
  plugged_ = claimed_ = false;
  GError* error = nullptr;
  need(umockdev_testbed_detach_ioctl(testbed_.get(), node_.c_str(), &error), error);
  umockdev_testbed_uevent(testbed_.get(), sys_path_.c_str(), "remove");
  umockdev_testbed_remove_device(testbed_.get(), sys_path_.c_str());
}

gboolean EmulatedUsb::handle(UMockdevIoctlBase*, UMockdevIoctlClient* client, EmulatedUsb* self) {
  self->answer(client);
  return TRUE;
}

void EmulatedUsb::answer(UMockdevIoctlClient* client) {
  UMockdevIoctlData* argument = umockdev_ioctl_client_get_arg(client);
  int error = 0;
  const auto request = umockdev_ioctl_client_get_request(client);
  if (!plugged_ && request != USBDEVFS_REAPURBNDELAY && request != USBDEVFS_DISCARDURB) {
    umockdev_ioctl_client_complete(client, -1, ENODEV);
    return;
  }
  switch (request) {
    case USBDEVFS_SUBMITURB:
      error = submit(argument);
      break;
    case USBDEVFS_REAPURB:
    case USBDEVFS_REAPURBNDELAY:
      error = reap(argument);
      break;
    case USBDEVFS_DISCARDURB:
      error = discard(argument);
      break;
    case USBDEVFS_CLEAR_HALT:
      ++cleared_halts;
      break;
    case USBDEVFS_CLAIMINTERFACE:
      error = held || kernel_driver || claimed_.exchange(true) ? EBUSY : 0;
      claims += error == 0;
      break;
    case USBDEVFS_IOCTL:
      error = bindKernelDriver(argument);
      break;
    case USBDEVFS_RELEASEINTERFACE:
      claimed_ = false;
      ++releases;
      break;
    case USBDEVFS_GETDRIVER:
      error = ENODATA;
      break;
    case USBDEVFS_GET_CAPABILITIES:
    case USBDEVFS_SETINTERFACE:
    case USBDEVFS_RESET:
      break;
    default:
      error = ENOTTY;
  }
  umockdev_ioctl_client_complete(client, error ? -1 : 0, error);
}

int EmulatedUsb::bindKernelDriver(UMockdevIoctlData* argument) {
  UMockdevIoctlData* data =
      umockdev_ioctl_data_resolve(argument, 0, sizeof(usbdevfs_ioctl), nullptr);
  const int code = reinterpret_cast<const usbdevfs_ioctl*>(data->data)->ioctl_code;
  umockdev_ioctl_data_unref(data);
  const bool bind = code == static_cast<int>(USBDEVFS_CONNECT);
  return kernel_driver.exchange(bind) == bind ? ENODATA : 0;
}

int EmulatedUsb::submit(UMockdevIoctlData* argument) {
  Request request;
  request.urb = umockdev_ioctl_data_resolve(argument, 0, sizeof(usbdevfs_urb), nullptr);
  request.bytes =
      umockdev_ioctl_data_resolve(request.urb, offsetof(usbdevfs_urb, buffer),
                                  static_cast<gsize>(request.header().buffer_length), nullptr);
  carryOut(request);
  requests_.push_back(request);
  return 0;
}

void EmulatedUsb::carryOut(Request& request) {
  usbdevfs_urb& urb = request.header();
  std::uint8_t* bytes = request.bytes->data;
  const auto size = static_cast<std::size_t>(urb.buffer_length);
  urb.status = 0;
  request.done = true;
  const std::scoped_lock lock(twin_.mutex);
  if (urb.type == USBDEVFS_URB_TYPE_CONTROL) {
    twin_.control(bytes[1], bytes[2] + 256 * bytes[3]);
    urb.actual_length = 0;
  } else if (!(urb.endpoint & 0x80)) {
    twin_.out({bytes, size});
    urb.actual_length = urb.buffer_length;
  } else if (silences > 0) {
    --silences;
    request.done = false;
  } else if (stalls > 0) {
    --stalls;
    urb.status = -EPIPE;
  } else {
    const Bytes packet = twin_.in();
    std::copy(packet.begin(), packet.end(), bytes);
    urb.actual_length = static_cast<int>(packet.size());
  }
}

int EmulatedUsb::reap(UMockdevIoctlData* argument) {
  const auto found =
      std::find_if(requests_.begin(), requests_.end(), [](auto& r) { return r.done; });
  if (found == requests_.end()) return plugged_ ? EAGAIN : ENODEV;
  UMockdevIoctlData* pointer = umockdev_ioctl_data_resolve(argument, 0, sizeof(void*), nullptr);
  umockdev_ioctl_data_set_ptr(pointer, 0, found->urb);
  umockdev_ioctl_data_unref(pointer);
  giveBack(found);
  return 0;
}

int EmulatedUsb::discard(UMockdevIoctlData* argument) {
  gulong address = 0;
  std::memcpy(&address, argument->data, sizeof address);
  for (Request& request : requests_)
    if (request.urb->client_addr == address) {
      request.header().status = -ENOENT;
      request.done = true;
      return 0;
    }
  return EINVAL;
}

void EmulatedUsb::giveBack(const std::deque<Request>::iterator& request) {
  umockdev_ioctl_data_unref(request->bytes);
  umockdev_ioctl_data_unref(request->urb);
  requests_.erase(request);
}

}  // namespace palpa::test

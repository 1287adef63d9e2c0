#include "apps/os/pedal.h"

#include <fcntl.h>
#include <linux/input.h>
#include <sys/ioctl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>

#include "anatomy/base/error.h"
#include "anatomy/base/whole_file.h"

namespace palpa::os {

namespace {

/// The kernel's device of something with keys or buttons.
bool hasKeys(int device) {
  std::array<unsigned char, KEY_MAX / 8 + 1> keys{};
  return ::ioctl(device, EVIOCGBIT(EV_KEY, keys.size()), keys.data()) >= 0 &&
         std::any_of(keys.begin(), keys.end(), [](unsigned char some) { return some != 0; });
}

bool isPipe(int device) {
  struct stat facts {};
  return ::fstat(device, &facts) == 0 && S_ISFIFO(facts.st_mode);
}

}  // namespace

Pedal::Pedal(const std::string& device, Use use)
    : descriptor_(::open(device.c_str(), O_RDONLY | O_NONBLOCK | O_CLOEXEC)) {
  const std::string what = "the stop pedal " + device;
  if (descriptor_ < 0) {
    const int why = errno;
    throw Error(why == ENOENT ? "is not there" : "cannot be opened: " + fileTrouble(why).why, what,
                why == EACCES ? "Let this user read it: sudo adduser $USER input, and log in again"
                              : "Plug it in, or correct stop_pedal in the station's file");
  }
  if (isPipe(descriptor_)) return;
  const bool keys = hasKeys(descriptor_);
  if (keys && (use == Use::look || ::ioctl(descriptor_, EVIOCGRAB, 1) == 0)) return;
  letGo();
  throw Error(keys ? "is taken by another program, so that it is not heard here" : "has no keys",
              what,
              keys ? "End that program (another session, or one that remaps keys)"
                   : "Name the pedal's own device, /dev/input/by-id/...-event-kbd");
}

Pedal::~Pedal() { letGo(); }

void Pedal::letGo() {
  if (descriptor_ >= 0) ::close(descriptor_);
  descriptor_ = -1;
}

bool Pedal::pressed() {
  constexpr int kDown = 1;  // 0: up; 2: held, and repeated
  bool any = false;
  std::array<input_event, 16> events{};
  while (descriptor_ >= 0) {
    const ssize_t bytes = ::read(descriptor_, events.data(), sizeof events);
    if (bytes < 0 && errno == EINTR) continue;
    if (bytes < 0 && errno == EAGAIN) return any;
    if (bytes <= 0) {  // pulled out
      letGo();
      return true;
    }
    for (std::size_t i = 0; i < static_cast<std::size_t>(bytes) / sizeof(input_event); ++i)
      any = any || (events[i].type == EV_KEY && events[i].value == kDown) ||
            (events[i].type == EV_SYN && events[i].code == SYN_DROPPED);  // one may be among them
  }
  return any;
}

}  // namespace palpa::os

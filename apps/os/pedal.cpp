#include "apps/os/pedal.h"

#include <fcntl.h>
#include <linux/input.h>
#include <sys/ioctl.h>
#include <unistd.h>

#include <array>
#include <cerrno>

#include "anatomy/base/error.h"
#include "anatomy/base/whole_file.h"

namespace palpa::os {

Pedal::Pedal(const std::string& device)
    : descriptor_(::open(device.c_str(), O_RDONLY | O_NONBLOCK | O_CLOEXEC)) {
  if (descriptor_ < 0) {
    const int why = errno;
    throw Error(why == ENOENT ? "is not there" : "cannot be opened: " + fileTrouble(why).why,
                "the stop pedal " + device,
                why == EACCES ? "Let this user read it: sudo adduser $USER input, and log in again"
                              : "Plug it in, or correct stop_pedal in the station's file");
  }
  ::ioctl(descriptor_, EVIOCGRAB, 1);  // refused: somebody else hears it, too
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
      any = any || (events[i].type == EV_KEY && events[i].value == kDown);
  }
  return any;
}

}  // namespace palpa::os

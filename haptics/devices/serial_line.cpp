#include "haptics/devices/serial_line.h"

#include <fcntl.h>
#include <poll.h>
#include <termios.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>

namespace palpa::haptics {
namespace {

constexpr std::size_t kLongest = 255;
constexpr int kSend_ms = 5;

SerialStatus serialStatusOf(int error) {
  switch (error) {
    case ENOENT:
    case ENODEV:
    case ENXIO:
    case EIO:
      return SerialStatus::gone;
    case EACCES:
    case EPERM:
      return SerialStatus::denied;
    default:
      return SerialStatus::other;
  }
}

bool waits(int port, short what, int timeout_ms) {
  pollfd one{port, what, 0};
  return ::poll(&one, 1, timeout_ms) > 0 && (one.revents & what) != 0;
}

}  // namespace

SerialStatus SerialLine::open() noexcept {
  close();
  port_number_ = ::open(port_.c_str(), O_RDWR | O_NOCTTY | O_NONBLOCK | O_CLOEXEC);
  if (port_number_ < 0) return serialStatusOf(errno);
  termios settings{};
  if (::tcgetattr(port_number_, &settings) == 0) {
    ::cfmakeraw(&settings);
    ::cfsetspeed(&settings, B115200);
    ::tcsetattr(port_number_, TCSANOW, &settings);
    ::tcflush(port_number_, TCIOFLUSH);
  }
  size_ = taken_ = 0;
  return SerialStatus::ok;
}

void SerialLine::close() noexcept {
  if (port_number_ >= 0) ::close(port_number_);
  port_number_ = -1;
}

SerialStatus SerialLine::send(std::string_view line) noexcept {
  if (port_number_ < 0 || line.size() > kLongest) return SerialStatus::other;
  char bytes[kLongest + 1];
  std::memcpy(bytes, line.data(), line.size());
  bytes[line.size()] = '\n';
  for (std::size_t sent = 0; sent < line.size() + 1;) {
    const ssize_t count = ::write(port_number_, bytes + sent, line.size() + 1 - sent);
    if (count > 0) {
      sent += static_cast<std::size_t>(count);
      continue;
    }
    if (count < 0 && errno != EAGAIN && errno != EINTR) return serialStatusOf(errno);
    if (!waits(port_number_, POLLOUT, kSend_ms)) return SerialStatus::timeout;
  }
  return SerialStatus::ok;
}

/// A whole line of what has come. One that is too long is passed over.
bool SerialLine::takeLine(std::string_view& line) noexcept {
  std::copy(bytes_ + taken_, bytes_ + size_, bytes_);
  size_ -= taken_;
  taken_ = 0;
  const char* const end = std::find(bytes_, bytes_ + size_, '\n');
  if (end == bytes_ + size_) {
    if (size_ == sizeof bytes_) size_ = 0;
    return false;
  }
  const auto length = static_cast<std::size_t>(end - bytes_);
  taken_ = length + 1;
  line = {bytes_, length > 0 && bytes_[length - 1] == '\r' ? length - 1 : length};
  return true;
}

SerialStatus SerialLine::receive(std::string_view& line, int timeout_ms) noexcept {
  line = {};
  if (port_number_ < 0) return SerialStatus::other;
  while (!takeLine(line)) {
    if (!waits(port_number_, POLLIN, timeout_ms)) {
      pollfd one{port_number_, POLLIN, 0};
      const bool gone = ::poll(&one, 1, 0) > 0 && (one.revents & (POLLHUP | POLLERR | POLLNVAL));
      return gone ? SerialStatus::gone : SerialStatus::timeout;
    }
    const ssize_t count = ::read(port_number_, bytes_ + size_, sizeof bytes_ - size_);
    if (count == 0) return SerialStatus::gone;
    if (count < 0 && errno != EAGAIN && errno != EINTR) return serialStatusOf(errno);
    if (count > 0) size_ += static_cast<std::size_t>(count);
  }
  return SerialStatus::ok;
}

}  // namespace palpa::haptics

#include <dlfcn.h>
#include <libusb.h>
#include <pthread.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <sys/statvfs.h>
#include <sys/timex.h>
#include <sys/uio.h>
#include <unistd.h>

#include <atomic>
#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <ctime>

#include "falcon_on_a_cable.h"
#include "hung_calls.h"

/// Answers of the system and of libusb with one thing wrong: PALPA_FAULT says which. Everything
/// else goes through to whom it was meant for.
namespace {

bool isFault(const char* name) {
  const char* wanted = std::getenv("PALPA_FAULT");
  return wanted && std::strcmp(wanted, name) == 0;
}

template <class Function>
Function* original(const char* name) {
  return reinterpret_cast<Function*>(dlsym(RTLD_NEXT, name));
}

constexpr time_t kLongAgo = 100'000'000;     // 1973
constexpr time_t kFarAhead = 7'258'118'400;  // 2200
std::atomic<long> writes{0};                 // to files that are no streams of the program

/// Whether the drive has refused: from the PALPA_FAULT_AFTER-th write on, and for ever.
bool driveHasFailed() {
  static const char* after = std::getenv("PALPA_FAULT_AFTER");
  static const long most = after ? std::atol(after) : 0;
  return writes > most;
}

/// 0, or what a write to this file, or its way to the drive, is answered.
int driveError(int file, bool is_write) {
  const bool is_broken = isFault("broken drive");
  if (file <= STDERR_FILENO || !(is_broken || isFault("drive fills"))) return 0;
  struct stat status {};
  if (fstat(file, &status) != 0 || !S_ISREG(status.st_mode)) return 0;
  if (is_write) ++writes;
  if (!driveHasFailed()) return 0;
  return is_broken ? EIO : is_write ? ENOSPC : 0;
}

template <class Result>
Result refused(int error) {
  errno = error;
  return -1;
}

bool hasUsbDevice() {
  return isFault("usb denied") || isFault("usb busy") || isFault("usb mute") ||
         palpa::test::hasFalcon();
}
thread_local timespec promised;  // what a thread was promised when it went to sleep
thread_local bool wakes = false;
bool wakesInTime() { return isFault("no real time") || isFault("no locked memory"); }
int device, handle;  // only their places are used

}  // namespace

extern "C" {

// Dates.
int clock_gettime(clockid_t clock, timespec* t) noexcept {
  static auto* real = original<int(clockid_t, timespec*)>("clock_gettime");
  const int result = real(clock, t);
  if (clock == CLOCK_MONOTONIC && wakes) *t = promised;  // a busy computer is another fault
  wakes = false;
  if (clock != CLOCK_REALTIME) return result;
  static std::atomic<int> asked{0};
  if (isFault("date of long ago")) t->tv_sec = kLongAgo;
  if (isFault("date is set")) t->tv_sec += 7 * asked++;
  if (isFault("date jumps")) t->tv_sec = asked++ % 2 ? kLongAgo : kFarAhead;
  return result;
}

time_t time(time_t* where) noexcept {
  static auto* real = original<time_t(time_t*)>("time");
  const time_t now = isFault("date of long ago") ? kLongAgo : real(nullptr);
  if (where) *where = now;
  return now;
}

int adjtimex(timex* asked) noexcept {
  static auto* real = original<int(timex*)>("adjtimex");
  return isFault("no time server") ? TIME_ERROR : real(asked);
}

int clock_getres(clockid_t clock, timespec* t) noexcept {
  static auto* real = original<int(clockid_t, timespec*)>("clock_getres");
  const int result = real(clock, t);
  if (t && isFault("coarse clock")) *t = {0, 4'000'000};
  return result;
}

// The haptic loop.
int pthread_setschedparam(pthread_t thread, int policy, const sched_param* param) noexcept {
  static auto* real = original<int(pthread_t, int, const sched_param*)>("pthread_setschedparam");
  if (isFault("no locked memory")) return 0;
  return isFault("no real time") ? EPERM : real(thread, policy, param);
}

int mlockall(int flags) noexcept {
  static auto* real = original<int(int)>("mlockall");
  if (!isFault("no locked memory")) return real(flags);
  errno = ENOMEM;
  return -1;
}

int clock_nanosleep(clockid_t clock, int flags, const timespec* until, timespec* left) {
  static auto* real = original<int(clockid_t, int, const timespec*, timespec*)>("clock_nanosleep");
  const int result = real(clock, flags, until, left);
  wakes = wakesInTime() && clock == CLOCK_MONOTONIC && flags == TIMER_ABSTIME;
  if (wakes) promised = *until;
  const timespec more{0, 3'000'000};
  if (isFault("busy computer")) real(CLOCK_MONOTONIC, 0, &more, nullptr);
  return result;
}

// The disk.
int statvfs(const char* path, struct statvfs* answer) noexcept {
  static auto* real = original<int(const char*, struct statvfs*)>("statvfs");
  const int result = real(path, answer);
  if (result == 0 && isFault("full disk")) answer->f_bavail = 50'000'000 / answer->f_frsize;
  if (result == 0 && isFault("nearly full disk")) answer->f_bavail = 700'000'000 / answer->f_frsize;
  return result;
}

int access(const char* path, int mode) noexcept {
  static auto* real = original<int(const char*, int)>("access");
  if (!(mode & W_OK) || !isFault("read-only disk")) return real(path, mode);
  errno = EROFS;
  return -1;
}

// A drive that fails while a program writes, or that is full then.
ssize_t write(int file, const void* bytes, size_t count) {
  static auto* real = original<ssize_t(int, const void*, size_t)>("write");
  palpa::test::waitWhileHung(file);
  const int error = driveError(file, true);
  return error ? refused<ssize_t>(error) : real(file, bytes, count);
}

ssize_t writev(int file, const iovec* parts, int count) {
  static auto* real = original<ssize_t(int, const iovec*, int)>("writev");
  palpa::test::waitWhileHung(file);
  const int error = driveError(file, true);
  return error ? refused<ssize_t>(error) : real(file, parts, count);
}

ssize_t pwrite(int file, const void* bytes, size_t count, off_t at) {
  static auto* real = original<ssize_t(int, const void*, size_t, off_t)>("pwrite");
  palpa::test::waitWhileHung(file);
  const int error = driveError(file, true);
  return error ? refused<ssize_t>(error) : real(file, bytes, count, at);
}

ssize_t pwrite64(int file, const void* bytes, size_t count, off64_t at) {
  static auto* real = original<ssize_t(int, const void*, size_t, off64_t)>("pwrite64");
  palpa::test::waitWhileHung(file);
  const int error = driveError(file, true);
  return error ? refused<ssize_t>(error) : real(file, bytes, count, at);
}

int fsync(int file) {
  static auto* real = original<int(int)>("fsync");
  palpa::test::waitWhileHung(file);
  const int error = driveError(file, false);
  return error ? refused<int>(error) : real(file);
}

int fdatasync(int file) {
  static auto* real = original<int(int)>("fdatasync");
  palpa::test::waitWhileHung(file);
  const int error = driveError(file, false);
  return error ? refused<int>(error) : real(file);
}

// A Falcon on a cable: its kernel node belongs to somebody else, or another program has it, or it
// says nothing; or all is well with it.
ssize_t libusb_get_device_list(libusb_context* context, libusb_device*** list) {
  static auto* real =
      original<ssize_t(libusb_context*, libusb_device***)>("libusb_get_device_list");
  if (!hasUsbDevice()) return real(context, list);
  *list = static_cast<libusb_device**>(std::calloc(2, sizeof(libusb_device*)));
  (*list)[0] = reinterpret_cast<libusb_device*>(&device);
  return 1;
}
void libusb_free_device_list(libusb_device** list, int unref) {
  static auto* real = original<void(libusb_device**, int)>("libusb_free_device_list");
  hasUsbDevice() ? std::free(list) : real(list, unref);
}
int libusb_get_device_descriptor(libusb_device* one, libusb_device_descriptor* descriptor) {
  static auto* real =
      original<int(libusb_device*, libusb_device_descriptor*)>("libusb_get_device_descriptor");
  if (!hasUsbDevice()) return real(one, descriptor);
  *descriptor = {};
  descriptor->idVendor = 0x0403;
  descriptor->idProduct = 0xcb48;
  return LIBUSB_SUCCESS;
}
int libusb_open(libusb_device* one, libusb_device_handle** opened) {
  static auto* real = original<int(libusb_device*, libusb_device_handle**)>("libusb_open");
  if (!hasUsbDevice()) return real(one, opened);
  *opened = reinterpret_cast<libusb_device_handle*>(&handle);
  return isFault("usb denied") ? LIBUSB_ERROR_ACCESS : LIBUSB_SUCCESS;
}
int libusb_set_auto_detach_kernel_driver(libusb_device_handle* opened, int enable) {
  static auto* real =
      original<int(libusb_device_handle*, int)>("libusb_set_auto_detach_kernel_driver");
  return hasUsbDevice() ? LIBUSB_SUCCESS : real(opened, enable);
}
int libusb_claim_interface(libusb_device_handle* opened, int interface) {
  static auto* real = original<int(libusb_device_handle*, int)>("libusb_claim_interface");
  if (!hasUsbDevice()) return real(opened, interface);
  return isFault("usb busy") ? LIBUSB_ERROR_BUSY : LIBUSB_SUCCESS;
}
int libusb_release_interface(libusb_device_handle* opened, int interface) {
  static auto* real = original<int(libusb_device_handle*, int)>("libusb_release_interface");
  return hasUsbDevice() ? LIBUSB_SUCCESS : real(opened, interface);
}
void libusb_close(libusb_device_handle* opened) {
  static auto* real = original<void(libusb_device_handle*)>("libusb_close");
  if (!hasUsbDevice()) real(opened);
}
int libusb_control_transfer(libusb_device_handle* opened, std::uint8_t type, std::uint8_t request,
                            std::uint16_t value, std::uint16_t index, unsigned char* data,
                            std::uint16_t length, unsigned timeout) {
  static auto* real =
      original<int(libusb_device_handle*, std::uint8_t, std::uint8_t, std::uint16_t, std::uint16_t,
                   unsigned char*, std::uint16_t, unsigned)>("libusb_control_transfer");
  if (palpa::test::hasFalcon()) palpa::test::falconControl(request, value);
  return hasUsbDevice() ? length : real(opened, type, request, value, index, data, length, timeout);
}
int libusb_bulk_transfer(libusb_device_handle* opened, unsigned char endpoint, unsigned char* data,
                         int length, int* moved, unsigned timeout) {
  static auto* real =
      original<int(libusb_device_handle*, unsigned char, unsigned char*, int, int*, unsigned)>(
          "libusb_bulk_transfer");
  if (!hasUsbDevice()) return real(opened, endpoint, data, length, moved, timeout);
  palpa::test::waitWhileHung("usb");
  const bool in = endpoint & LIBUSB_ENDPOINT_IN;
  if (palpa::test::hasFalcon()) {
    const std::span<std::uint8_t> bytes(data, static_cast<std::size_t>(length));
    if (!in) palpa::test::falconOut(bytes);
    *moved = in ? palpa::test::falconIn(bytes) : length;
    return LIBUSB_SUCCESS;
  }
  *moved = in ? 0 : length;
  return in ? LIBUSB_ERROR_TIMEOUT : LIBUSB_SUCCESS;
}
}

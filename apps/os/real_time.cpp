#include "apps/os/real_time.h"

#include <linux/capability.h>
#include <malloc.h>
#include <pthread.h>
#include <sched.h>
#include <sys/mman.h>
#include <sys/resource.h>
#include <sys/syscall.h>
#include <unistd.h>

#include <cerrno>
#include <system_error>
#include <utility>

#include "anatomy/base/error.h"
#include "anatomy/base/whole_file.h"

namespace palpa::os {
namespace {

// Over normal threads and most of the kernel's own, under its watchdogs.
constexpr int kFifoPriority = 80;
constexpr int kServerNice = 15;
constexpr int kMemoryPools = 2;
constexpr int kLargeMemory = 512 * 1024, kSpareMemory = 16 * 1024 * 1024;  // bytes
constexpr std::size_t kStack = 256 * 1024;  // a tick uses a few KiB of the 8 MiB
constexpr std::size_t kPage = 4096;         // the smallest there is
constexpr std::size_t kSmallStack = 2 << 20;

std::string because(int error) {
  if (error == EPERM) return " (this user may not)";
  if (error == EINVAL) return " (this computer has none)";
  return " (" + fileTrouble(error).why + ")";
}

bool mayLockWithoutBound() {
  rlimit limit{};
  if (getrlimit(RLIMIT_MEMLOCK, &limit) == 0 && limit.rlim_cur == RLIM_INFINITY) return true;
  __user_cap_header_struct header{_LINUX_CAPABILITY_VERSION_3, 0};
  __user_cap_data_struct data[_LINUX_CAPABILITY_U32S_3]{};
  return syscall(SYS_capget, &header, data) == 0 && (data[0].effective >> CAP_IPC_LOCK & 1u);
}

std::string askForFifo() {
  sched_param param{};
  param.sched_priority = kFifoPriority;
  const int error = pthread_setschedparam(pthread_self(), SCHED_FIFO, &param);
  return error == 0 ? "SCHED_FIFO" : "normal priority: SCHED_FIFO refused" + because(error);
}

std::string askForCpu(int cpu) {
  cpu_set_t set;
  CPU_ZERO(&set);
  if (cpu >= CPU_SETSIZE) return "CPU " + std::to_string(cpu) + " refused" + because(EINVAL);
  CPU_SET(static_cast<std::size_t>(cpu), &set);
  const int error = pthread_setaffinity_np(pthread_self(), sizeof set, &set);
  return "CPU " + std::to_string(cpu) + (error == 0 ? "" : " refused" + because(error));
}

[[gnu::noinline]] void touchStack() {
  [[maybe_unused]] volatile unsigned char stack[kStack];
  for (std::size_t i = 0; i < kStack; i += kPage) stack[i] = 0;
}

}  // namespace

MemoryLock::MemoryLock() {
  const bool whole = mayLockWithoutBound();
  locked_ = mlockall(whole ? MCL_CURRENT | MCL_FUTURE : MCL_CURRENT) == 0;
  if (!locked_)
    words_ = "memory not locked: refused" +
             (errno == ENOMEM ? " (beyond this user's limit, ulimit -l)" : because(errno));
  else if (whole)
    words_ = "memory locked";
  else
    words_ = "memory of the start locked: the limit (ulimit -l) leaves out what comes later";
}

MemoryLock::~MemoryLock() {
  if (locked_) munlockall();
}

std::string becomeRealTime(int cpu) {
  touchStack();
  std::string words = askForFifo();
  if (cpu >= 0) words += "; " + askForCpu(cpu);
  return words;
}

std::thread startThread(std::function<void()> work) {
  try {
    return std::thread(std::move(work));
  } catch (const std::system_error&) {
    throw Error("gives no further threads", "this computer",
                "End other programs, or raise the limit (ulimit -u)");
  }
}

void keepStacksSmall() {
  pthread_attr_t usual;
  if (pthread_getattr_default_np(&usual) != 0) return;
  if (pthread_attr_setstacksize(&usual, kSmallStack) == 0) pthread_setattr_default_np(&usual);
  pthread_attr_destroy(&usual);
}

void shareMemoryPools() { mallopt(M_ARENA_MAX, kMemoryPools); }

void giveLargeMemoryBack() {
  mallopt(M_MMAP_THRESHOLD, kLargeMemory);
  // With the first, the C library no longer chooses this by itself: at its 128 kB, what small
  // pieces need would be fetched and given back at every picture.
  mallopt(M_TRIM_THRESHOLD, kSpareMemory);
}

void giveFreeMemoryBack() { malloc_trim(0); }

void giveWay() { setpriority(PRIO_PROCESS, static_cast<id_t>(syscall(SYS_gettid)), kServerNice); }

}  // namespace palpa::os

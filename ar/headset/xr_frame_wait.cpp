#include "ar/headset/xr_frame_wait.h"

#include <dlfcn.h>
#include <link.h>

#include <condition_variable>
#include <mutex>
#include <string>
#include <thread>
#include <vector>

namespace palpa::ar {

void keepLibrariesLoaded() {
  std::vector<std::string> names;
  dl_iterate_phdr(
      [](dl_phdr_info* info, std::size_t, void* to) {
        if (info->dlpi_name && *info->dlpi_name)
          static_cast<std::vector<std::string>*>(to)->emplace_back(info->dlpi_name);
        return 0;
      },
      &names);
  for (const std::string& name : names)
    dlopen(name.c_str(),
           RTLD_LAZY | RTLD_NOLOAD |
               RTLD_NODELETE);  // the handle is never given back, which is what keeps it
}

namespace {

constexpr std::chrono::milliseconds kPatienceForFrame(100);

}  // namespace

/// idle -> asked (by next) -> done (by the thread) -> idle.
struct XrFrameWait::Shared {
  enum class At { idle, asked, done, over };
  std::mutex mutex;
  std::condition_variable changed;
  At at = At::idle;
  XrSession session = XR_NULL_HANDLE;
  XrResult result = XR_SUCCESS;
  XrFrameState state{XR_TYPE_FRAME_STATE, nullptr, 0, 0, XR_FALSE};

  void run() {
    std::unique_lock lock(mutex);
    for (;;) {
      changed.wait(lock, [this] { return at == At::asked || at == At::over; });
      if (at == At::over) return;
      XrFrameState timing{XR_TYPE_FRAME_STATE, nullptr, 0, 0, XR_FALSE};
      lock.unlock();
      const XrResult answer = xrWaitFrame(session, nullptr, &timing);
      lock.lock();
      if (at == At::over) return;
      result = answer;
      state = timing;
      at = At::done;
      changed.notify_all();
    }
  }
};

XrFrameWait::XrFrameWait(XrSession session) : shared_(std::make_shared<Shared>()) {
  shared_->session = session;
  std::thread([shared = shared_] { shared->run(); }).detach();
}

XrFrameWait::~XrFrameWait() {
  const std::lock_guard lock(shared_->mutex);
  shared_->at = Shared::At::over;
  shared_->changed.notify_all();
}

bool XrFrameWait::settled() {
  std::unique_lock lock(shared_->mutex);
  return shared_->changed.wait_for(lock, 10 * kPatienceForFrame,
                                   [this] { return shared_->at != Shared::At::asked; });
}

void XrFrameWait::forget() {
  settled();
  const std::lock_guard lock(shared_->mutex);
  if (shared_->at == Shared::At::done) shared_->at = Shared::At::idle;
}

std::optional<XrFrameState> XrFrameWait::next() {
  std::unique_lock lock(shared_->mutex);
  if (shared_->at == Shared::At::idle) {
    shared_->at = Shared::At::asked;
    shared_->changed.notify_all();
  }
  if (!shared_->changed.wait_for(lock, kPatienceForFrame,
                                 [this] { return shared_->at == Shared::At::done; }))
    return std::nullopt;
  shared_->at = Shared::At::idle;
  xrCheck(shared_->result, "xrWaitFrame");
  return shared_->state;
}

}  // namespace palpa::ar

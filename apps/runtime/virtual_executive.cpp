#include <algorithm>

#include "apps/runtime/executive.h"

namespace palpa::runtime {
namespace {

class VirtualClock final : public Clock {
 public:
  std::int64_t now() const noexcept override { return now_ns; }
  std::int64_t now_ns = 0;
};

class VirtualExecutive final : public Executive {
 public:
  TimeMode mode() const override { return TimeMode::virtual_time; }
  const Clock& clock() const override { return clock_; }
  void add(Activity& activity, const ThreadPolicy& policy) override {
    entries_.push_back({0, policy.priority, &activity});
  }
  void stop() noexcept override { stopped_ = true; }

  void run() override {
    try {
      steps();
    } catch (...) {
      endAll();
      throw;
    }
    endAll();
  }

 private:
  void endAll() noexcept {
    for (const Entry& entry : entries_) entry.activity->end();
  }

  void steps() {
    stopped_ = false;
    while (!stopped_) {
      // A handful of activities: a scan is simpler than a heap, and the order is plain to see.
      const auto next =
          std::min_element(entries_.begin(), entries_.end(), [](const Entry& a, const Entry& b) {
            return a.due_ns != b.due_ns ? a.due_ns < b.due_ns : a.priority < b.priority;
          });
      if (next == entries_.end() || next->due_ns == kNever) return;
      clock_.now_ns = std::max(clock_.now_ns, next->due_ns);
      next->due_ns = next->activity->step(clock_.now_ns);
    }
  }

  struct Entry {
    std::int64_t due_ns;
    int priority;
    Activity* activity;
  };
  VirtualClock clock_;
  std::vector<Entry> entries_;
  bool stopped_ = false;
};

}  // namespace

std::unique_ptr<Executive> makeVirtualExecutive() { return std::make_unique<VirtualExecutive>(); }

}  // namespace palpa::runtime

#include <algorithm>
#include <exception>
#include <mutex>
#include <optional>
#include <thread>

#include "apps/runtime/executive.h"
#include "apps/runtime/real_time.h"

namespace palpa::runtime {
namespace {

class RealExecutive final : public Executive {
 public:
  TimeMode mode() const override { return TimeMode::real; }
  const Clock& clock() const override { return clock_; }
  void add(Activity& activity, const ThreadPolicy& policy) override {
    auto entry = std::make_unique<Entry>();
    entry->activity = &activity;
    entry->policy = policy;
    entries_.push_back(std::move(entry));
  }
  void stop() noexcept override { stopped_.store(true); }

  void run() override {
    stopped_.store(false);
    std::optional<MemoryLock> memory;
    if (std::any_of(entries_.begin(), entries_.end(),
                    [](const auto& e) { return e->policy.real_time; }))
      memory.emplace();
    std::vector<std::thread> threads;
    for (auto& entry : entries_)
      if (!entry->policy.on_caller) threads.emplace_back([this, &entry] { loop(*entry); });
    for (auto& entry : entries_)
      if (entry->policy.on_caller) loop(*entry);
    for (auto& thread : threads) thread.join();
    for (auto& entry : entries_)
      if (memory && entry->policy.real_time) entry->scheduling += "; " + memory->words();
    if (failure_) std::rethrow_exception(failure_);
  }

  std::vector<Lateness> lateness() const override {
    std::vector<Lateness> all;
    for (const auto& e : entries_) {
      const Spread late = spreadOf(e->late);
      all.push_back({e->activity->name(), e->late.count(), late.median_us, late.p99_us,
                     late.p999_us, late.max_us, spreadOf(e->cost), e->missed, e->scheduling,
                     e->late});
    }
    return all;
  }

 private:
  struct Entry {
    Activity* activity = nullptr;
    ThreadPolicy policy;
    TimeHistogram late, cost;
    std::uint64_t missed = 0;
    std::string scheduling = "normal priority";
  };

  void loop(Entry& entry) {
    try {
      if (entry.policy.real_time) entry.scheduling = becomeRealTime(entry.policy.cpu);
      const std::int64_t period = entry.activity->period_ns();
      std::int64_t due = clock_.now();
      while (!stopped_.load(std::memory_order_relaxed)) {
        clock_.sleepUntil(due);
        const std::int64_t now = clock_.now();
        const std::int64_t next = entry.activity->step(now);
        entry.cost.add(clock_.now() - now);
        entry.late.add(now - due);
        entry.missed += period > 0 && now - due > period;
        if (next == kNever) break;
        due = next;
      }
    } catch (...) {
      const std::lock_guard lock(failure_mutex_);
      if (!failure_) failure_ = std::current_exception();
      stop();
    }
    entry.activity->end();
  }

  SteadyClock clock_;
  std::vector<std::unique_ptr<Entry>> entries_;
  std::atomic<bool> stopped_{false};
  std::mutex failure_mutex_;
  std::exception_ptr failure_;
};

}  // namespace

std::unique_ptr<Executive> makeRealExecutive() { return std::make_unique<RealExecutive>(); }

}  // namespace palpa::runtime

#include <pthread.h>
#include <sched.h>

#include <algorithm>
#include <cstring>
#include <exception>
#include <mutex>
#include <thread>

#include "apps/runtime/executive.h"

namespace palpa::runtime {
namespace {

/// Histogram of lateness with fixed bins, so that a real-time thread can fill it: 1 us wide up to
/// 20 ms, the last bin for all beyond.
class LatenessHistogram {
 public:
  void add(std::int64_t late_ns) noexcept {
    const std::int64_t us = std::clamp<std::int64_t>(late_ns / 1000, 0, kBins - 1);
    ++bins_[static_cast<std::size_t>(us)];
    ++count_;
    max_us_ = std::max(max_us_, static_cast<double>(late_ns) * 1e-3);
  }
  double quantile(double q) const {
    std::uint64_t below = 0;
    for (std::size_t i = 0; i < bins_.size(); ++i)
      if ((below += bins_[i]) > q * static_cast<double>(count_)) return static_cast<double>(i);
    return max_us_;
  }
  std::uint64_t count() const { return count_; }
  double max_us() const { return max_us_; }

 private:
  static constexpr std::int64_t kBins = 20'001;
  std::vector<std::uint32_t> bins_ = std::vector<std::uint32_t>(kBins);
  std::uint64_t count_ = 0;
  double max_us_ = 0;
};

std::string askForFifo() {
  sched_param param{};
  param.sched_priority = 80;
  const int error = pthread_setschedparam(pthread_self(), SCHED_FIFO, &param);
  return error == 0 ? "SCHED_FIFO" : std::string("normal priority: SCHED_FIFO refused (") +
                                         std::strerror(error) + ")";
}

class RealExecutive final : public Executive {
 public:
  TimeMode mode() const override { return TimeMode::real; }
  const Clock& clock() const override { return clock_; }
  void add(Activity& activity, const ThreadPolicy& policy) override {
    entries_.push_back(std::make_unique<Entry>(Entry{&activity, policy, {}, "normal priority"}));
  }
  void stop() noexcept override { stopped_.store(true); }

  void run() override {
    stopped_.store(false);
    std::vector<std::thread> threads;
    for (auto& entry : entries_)
      if (!entry->policy.on_caller) threads.emplace_back([this, &entry] { loop(*entry); });
    for (auto& entry : entries_)
      if (entry->policy.on_caller) loop(*entry);
    for (auto& thread : threads) thread.join();
    if (failure_) std::rethrow_exception(failure_);
  }

  std::vector<Lateness> lateness() const override {
    std::vector<Lateness> all;
    for (const auto& e : entries_)
      all.push_back({e->activity->name(), e->late.count(), e->late.quantile(0.5),
                     e->late.quantile(0.99), e->late.max_us(), e->scheduling});
    return all;
  }

 private:
  struct Entry {
    Activity* activity;
    ThreadPolicy policy;
    LatenessHistogram late;
    std::string scheduling;
  };

  void loop(Entry& entry) {
    try {
      if (entry.policy.real_time) entry.scheduling = askForFifo();
      std::int64_t due = clock_.now();
      while (!stopped_.load(std::memory_order_relaxed)) {
        clock_.sleepUntil(due);
        const std::int64_t now = clock_.now();
        entry.late.add(now - due);
        due = entry.activity->step(now);
        if (due == kNever) return;
      }
    } catch (...) {
      const std::lock_guard lock(failure_mutex_);
      if (!failure_) failure_ = std::current_exception();
      stop();
    }
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

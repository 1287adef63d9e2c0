#pragma once

#include <cstddef>
#include <functional>
#include <new>
#include <optional>
#include <string>
#include <type_traits>

namespace palpa::os {

/// Memory that a process and those it forks afterwards see alike. Throws Error, with `advice`.
class SharedPages {
 public:
  SharedPages(std::size_t size, const std::string& advice);
  ~SharedPages();
  SharedPages(const SharedPages&) = delete;
  SharedPages& operator=(const SharedPages&) = delete;
  void* begin() const { return begin_; }

 private:
  void* begin_;
  const std::size_t size_;
};

/// A value in such memory; what several processes write in it at once is atomic.
template <typename T>
class SharedMemory {
  static_assert(std::is_trivially_destructible_v<T>);

 public:
  explicit SharedMemory(const std::string& advice)
      : pages_(sizeof(T), advice), value_(new (pages_.begin()) T) {}
  T& operator*() const { return *value_; }

 private:
  const SharedPages pages_;
  T* const value_;
};

/// `work` in a process of its own, which has a copy of everything and ends with this one. False: no
/// process is to be had. Nothing that is open (a database) may be used by both.
bool forkWorker(const std::function<void()>& work);

struct EndedWorker {
  bool clean = false;  ///< it went through its work, nobody killed it
};
/// One of those that have ended since, if any; never waits.
std::optional<EndedWorker> takeEnded();

}  // namespace palpa::os

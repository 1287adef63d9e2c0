#pragma once

#include <malloc.h>

#include <algorithm>
#include <cstdint>
#include <cstdlib>
#include <mutex>
#include <new>
#include <vector>

/// How many bytes of operator new live, from moment to moment. Replaces the program's operator new:
/// include it in one source file of a test program.
namespace palpa {

class LiveBytes {
 public:
  static std::int64_t now() {
    const std::lock_guard lock(mutex());
    return live();
  }
  /// Begins to note the peak, and the lows: of every `kStep` allocations the fewest bytes that
  /// lived.
  static void note() {
    const std::lock_guard lock(mutex());
    noted() = 0;
    allocations() = 0;
    low() = high() = live();
  }
  static std::int64_t peak() {
    const std::lock_guard lock(mutex());
    return high();
  }
  static std::vector<std::int64_t> lows() {
    std::vector<std::int64_t> all(kMost);  // before the lock, which every allocation takes
    const std::lock_guard lock(mutex());
    std::copy_n(kept(), noted(), all.begin());
    all.resize(noted());
    return all;
  }

  static void taken(void* p) {
    const std::lock_guard lock(mutex());
    live() += static_cast<std::int64_t>(::malloc_usable_size(p));
    high() = std::max(high(), live());
    if (++allocations() % kStep != 0 || noted() == kMost) return;
    kept()[noted()++] = low();
    low() = live();
  }
  static void given(void* p) {
    if (!p) return;
    const std::lock_guard lock(mutex());
    live() -= static_cast<std::int64_t>(::malloc_usable_size(p));
    low() = std::min(low(), live());
  }

 private:
  static constexpr std::size_t kStep = 500, kMost = 200'000;
  static std::mutex& mutex() {
    static std::mutex one;
    return one;
  }
  static std::int64_t& live() {
    static std::int64_t bytes = 0;
    return bytes;
  }
  static std::int64_t& low() {
    static std::int64_t bytes = 0;
    return bytes;
  }
  static std::int64_t& high() {
    static std::int64_t bytes = 0;
    return bytes;
  }
  static std::size_t& noted() {
    static std::size_t count = 0;
    return count;
  }
  static std::size_t& allocations() {
    static std::size_t count = 0;
    return count;
  }
  static std::int64_t* kept() {
    static std::int64_t all[kMost];
    return all;
  }
};

}  // namespace palpa

// Not inlined: the compiler would otherwise pair our free() with its own idea of new.
[[gnu::noinline]] void* operator new(std::size_t size) {
  void* p = std::malloc(size);
  if (!p) throw std::bad_alloc();
  palpa::LiveBytes::taken(p);
  return p;
}
[[gnu::noinline]] void* operator new(std::size_t size, const std::nothrow_t&) noexcept {
  void* p = std::malloc(size);
  if (p) palpa::LiveBytes::taken(p);
  return p;
}
[[gnu::noinline]] void operator delete(void* p) noexcept {
  palpa::LiveBytes::given(p);
  std::free(p);
}
[[gnu::noinline]] void operator delete(void* p, std::size_t) noexcept {
  palpa::LiveBytes::given(p);
  std::free(p);
}

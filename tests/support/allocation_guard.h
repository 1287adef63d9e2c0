#pragma once

#include <cstdlib>
#include <new>

/// Counts allocations by operator new in the calling thread while a NoAllocation lives. Replaces
/// the program's operator new: include it in one source file of a test program.
namespace palpa {

class NoAllocation {
 public:
  NoAllocation() { counting() = true, count() = 0; }
  ~NoAllocation() { counting() = false; }
  NoAllocation(const NoAllocation&) = delete;
  NoAllocation& operator=(const NoAllocation&) = delete;
  int allocations() const { return count(); }
  static void seen() {
    if (counting()) ++count();
  }

 private:
  static bool& counting() {
    static thread_local bool on = false;
    return on;
  }
  static int& count() {
    static thread_local int n = 0;
    return n;
  }
};

}  // namespace palpa

// Not inlined: the compiler would otherwise pair our free() with its own idea of new.
[[gnu::noinline]] void* operator new(std::size_t size) {
  palpa::NoAllocation::seen();
  if (void* p = std::malloc(size)) return p;
  throw std::bad_alloc();
}
[[gnu::noinline]] void operator delete(void* p) noexcept { std::free(p); }
[[gnu::noinline]] void operator delete(void* p, std::size_t) noexcept { std::free(p); }

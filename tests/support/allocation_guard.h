#pragma once

#include <cstdlib>
#include <new>

#include "tests/support/allocation_count.h"

/// Replaces the program's operator new: include it in one source file of a test program.

// Not inlined: the compiler would otherwise pair our free() with its own idea of new.
[[gnu::noinline]] void* operator new(std::size_t size) {
  palpa::NoAllocation::seen();
  if (void* p = std::malloc(size)) return p;
  throw std::bad_alloc();
}
// Sanitizers have one of their own, which does not go through the above.
[[gnu::noinline]] void* operator new(std::size_t size, const std::nothrow_t&) noexcept {
  palpa::NoAllocation::seen();
  return std::malloc(size);
}
[[gnu::noinline]] void operator delete(void* p) noexcept { std::free(p); }
[[gnu::noinline]] void operator delete(void* p, std::size_t) noexcept { std::free(p); }

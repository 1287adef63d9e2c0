#pragma once

/// Counts allocations by operator new in the calling thread while a NoAllocation lives; one source
/// file of the program has to include allocation_guard.h.
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

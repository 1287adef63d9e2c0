#pragma once

#include <cstdint>
#include <map>
#include <set>
#include <string>
#include <vector>

namespace palpa::test_xr {

/// What a program did: how often it called what, which handles it still holds, what it did against
/// the specification.
class Ledger {
 public:
  void called(const std::string& function) { ++calls_[function]; }
  template <class Handle>
  Handle opened(const std::string& kind) {
    open_[++last_] = kind;
    return reinterpret_cast<Handle>(last_);  // NOLINT(performance-no-int-to-ptr): a number
  }
  template <class Handle>
  bool holds(Handle handle) const {
    return open_.count(reinterpret_cast<std::uint64_t>(handle)) > 0;
  }
  template <class Handle>
  void closed(Handle handle) {
    if (!open_.erase(reinterpret_cast<std::uint64_t>(handle)))
      complain("a handle was given back twice");
  }
  /// Children go with their parents.
  void closeAll(const std::string& kind);
  void complain(const std::string& what) { complaints_.insert(what); }
  void note(const std::string& line) { notes_.push_back(line); }
  int calls(const std::string& function) const;
  void write(const std::string& file)
      const;  ///< lines: "call NAME N", "open KIND", "complaint TEXT", and the notes

 private:
  std::uint64_t last_ = 1000;
  std::map<std::string, int> calls_;
  std::map<std::uint64_t, std::string> open_;
  std::set<std::string> complaints_;
  std::vector<std::string> notes_;
};

}  // namespace palpa::test_xr

#pragma once

#include <mutex>
#include <string>
#include <vector>

namespace palpa::live {

/// What a session has told so far, entry by entry (JSON objects): whoever comes late, or was away,
/// reads on from where he was. Any thread but the haptic one.
class LiveLog {
 public:
  static constexpr std::size_t kMostCurves =
      200'000;  ///< 5 h of curves at 10 entries a second; what happens is told beyond it, too

  void add(std::string entry);
  void addCurve(std::string entry);  ///< left out beyond kMostCurves
  std::size_t size() const;
  /// At most `most` entries from number `from` (0 is the first).
  std::vector<std::string> since(std::size_t from, std::size_t most) const;

 private:
  mutable std::mutex mutex_;
  std::vector<std::string> entries_;
};

}  // namespace palpa::live

#include "apps/live/live_log.h"

#include <algorithm>
#include <utility>

namespace palpa::live {

void LiveLog::add(std::string entry) {
  const std::lock_guard lock(mutex_);
  entries_.push_back(std::move(entry));
}

void LiveLog::addCurve(std::string entry) {
  const std::lock_guard lock(mutex_);
  if (entries_.size() < kMostCurves) entries_.push_back(std::move(entry));
}

std::size_t LiveLog::size() const {
  const std::lock_guard lock(mutex_);
  return entries_.size();
}

std::vector<std::string> LiveLog::since(std::size_t from, std::size_t most) const {
  const std::lock_guard lock(mutex_);
  if (from >= entries_.size()) return {};
  const auto first = entries_.begin() + static_cast<std::ptrdiff_t>(from);
  return {first, first + static_cast<std::ptrdiff_t>(std::min(most, entries_.size() - from))};
}

}  // namespace palpa::live

#include "apps/console/web/own_door.h"

#include <algorithm>
#include <cstdlib>

#include "apps/console/web/guard.h"

namespace palpa::console {
namespace {

/// Every one of a million as likely as any other: what lies beyond the last whole million is drawn
/// again.
std::string sixDigits() {
  constexpr unsigned long kAll = 1'000'000, kSpan = 0x100000000UL;
  for (;;) {
    const unsigned long drawn = std::strtoul(randomKey().substr(0, 8).c_str(), nullptr, 16);
    if (drawn >= kSpan - kSpan % kAll) continue;
    const std::string digits = std::to_string(drawn % kAll);
    return std::string(6 - digits.size(), '0') + digits;
  }
}

}  // namespace

std::string cookieNamed(const std::string& name, const std::string& cookies) {
  const std::string begins = name + '=';
  for (std::size_t at = 0; at < cookies.size();) {
    const std::size_t end = std::min(cookies.find(';', at), cookies.size());
    while (at < end && cookies[at] == ' ') ++at;
    if (cookies.compare(at, begins.size(), begins) == 0 && at + begins.size() <= end)
      return cookies.substr(at + begins.size(), end - at - begins.size());
    at = end + 1;
  }
  return "";
}

void OwnDoor::dropOld(std::map<std::string, Given>* given) {
  std::erase_if(*given, [](const auto& one) { return Clock::now() >= one.second.until; });
}

std::string OwnDoor::pinFor(const std::string& trainee) {
  const std::lock_guard lock(mutex_);
  dropOld(&pins_);
  std::erase_if(pins_, [&](const auto& one) { return one.second.trainee == trainee; });
  std::string pin = sixDigits();
  while (pins_.contains(pin)) pin = sixDigits();
  pins_[pin] = {trainee, Clock::now() + pin_lasts_};
  return pin;
}

std::string OwnDoor::enter(const std::string& remote, const std::string& pin) {
  const std::lock_guard lock(mutex_);
  if (wrong_.tooMany(remote)) return "";
  dropOld(&pins_);
  dropOld(&keys_);
  const auto found = pins_.find(pin);
  if (found == pins_.end()) {
    wrong_.note(remote);
    wrong_anywhere_.note("");
    if (wrong_anywhere_.tooMany("")) pins_.clear();
    return "";
  }
  std::string key = randomKey();
  keys_[key] = {found->second.trainee, Clock::now() + key_lasts_};
  pins_.erase(found);
  return key;
}

void OwnDoor::leave(const std::string& cookies) {
  const std::lock_guard lock(mutex_);
  keys_.erase(cookieNamed("palpa-mine", cookies));
}

std::string OwnDoor::traineeOf(const std::string& cookies) const {
  const std::lock_guard lock(mutex_);
  const auto found = keys_.find(cookieNamed("palpa-mine", cookies));
  return found == keys_.end() || Clock::now() >= found->second.until ? "" : found->second.trainee;
}

}  // namespace palpa::console

#pragma once

#include <string>

#include "apps/room/broker_line.h"

/// What is said of a broker that does not do what it should, and what to do about it: all but the
/// last go on from its name.
namespace palpa::room {

/// MQTT 5: reason codes from 128 on.
inline bool isRefusal(int reason) { return reason >= 128; }

inline constexpr char kNotOurs[] =
    "refused this computer's certificate, which is over or of another room: pair it again";
inline constexpr char kEndsEveryLine[] =
    "ends every line at once: perhaps another console uses the same file of this room. Close one "
    "of the two, or pair this station again";

/// We do not take the broker's certificate; `log`: OpenSSL's words.
bool isAnotherRooms(const std::string& log);
/// Why there is no line: the library's result, and what was logged last.
std::string whyNot(int result, const std::string& log);
/// The broker's own reasons.
std::string whyRefused(int reason);
std::string whyNotTold(int reason);
std::string whyNotHeard(const std::string& topic, int reason);

/// "The room's broker (HOST:PORT) WHY".
std::string ofBroker(const BrokerAccess& access, const std::string& why);
/// What can never be said; `result`: the library's.
std::string tooMuch(const std::string& topic, int result);

}  // namespace palpa::room

#include "apps/room/broker_words.h"

#include <mosquitto.h>

namespace palpa::room {
namespace {

/// What OpenSSL says at either end, in words that help.
std::string whyNoTls(const std::string& log) {
  const auto has = [&log](const char* words) { return log.find(words) != std::string::npos; };
  if (has("alert certificate expired") || has("alert unknown ca") || has("alert bad certificate"))
    return kNotOurs;
  if (isAnotherRooms(log))
    return "is not the one of this room, or its certificate is over: look whether the address is "
           "right, and pair anew";
  return "did not agree on encryption (" + (log.empty() ? "no reason given" : log) + ")";
}

}  // namespace

bool isAnotherRooms(const std::string& log) {
  return log.find("certificate verify failed") != std::string::npos;
}

std::string whyNot(int result, const std::string& log) {
  switch (result) {
    case MOSQ_ERR_TLS:
    case MOSQ_ERR_TLS_HANDSHAKE:
      return log.find("unexpected eof") == std::string::npos ? whyNoTls(log) : "is gone";
    case MOSQ_ERR_EAI:
    case MOSQ_ERR_LOOKUP:
      return "has a name that no computer here answers to";
    case MOSQ_ERR_CONN_REFUSED:
    case MOSQ_ERR_NO_CONN:
    case MOSQ_ERR_ERRNO:
      return "cannot be reached: look whether it runs, and whether the network is there";
    case MOSQ_ERR_CONN_LOST:
    case MOSQ_ERR_KEEPALIVE:
      return log.find("alert") == std::string::npos ? "is gone" : whyNoTls(log);
    default:
      return std::string("does not work (") + mosquitto_strerror(result) + ")";
  }
}

std::string whyRefused(int reason) {
  return std::string("refused this computer: ") + mosquitto_reason_string(reason);
}

std::string whyNotTold(int reason) {
  return std::string("refuses to tell this computer what it needs to hear (") +
         mosquitto_reason_string(reason) + "): pair it again";
}

std::string whyNotHeard(const std::string& topic, int reason) {
  return "refused what was said about " + topic + " (" + mosquitto_reason_string(reason) +
         "): let it read its files again (HUP), or pair this station again";
}

std::string ofBroker(const BrokerAccess& access, const std::string& why) {
  return "The room's broker (" + access.host + ":" + std::to_string(access.port) + ") " + why;
}

std::string tooMuch(const std::string& topic, int result) {
  return "What is to be said about " + topic + " is too much for the room's broker (" +
         mosquitto_strerror(result) + ")";
}

}  // namespace palpa::room

#include "apps/live/wire.h"

#include <algorithm>
#include <cstdint>
#include <map>

#include <nlohmann/json.hpp>

#include "anatomy/base/error.h"
#include "anatomy/base/json_text.h"

namespace palpa::live {
namespace {

constexpr std::size_t kHead = 5;

std::size_t longest(char kind) {
  switch (static_cast<FrameKind>(kind)) {
    case FrameKind::entry:
      return kLongestEntry;
    case FrameKind::picture:
      return kLongestPicture;
    case FrameKind::command:
      return kLongestCommand;
    case FrameKind::known:
      return kLongestCount;
    case FrameKind::watch:
      return 1;
    case FrameKind::stop:
      return 0;
  }
  throw Error("is not a known kind of frame", "local socket of a session",
              "Console and session have different versions: restart both");
}

}  // namespace

std::string stopSocketOf(const std::string& session_socket) { return session_socket + "!"; }

std::string encoded(FrameKind kind, const std::string& body) {
  std::string frame(1, static_cast<char>(kind));
  for (int shift = 0; shift < 32; shift += 8)
    frame.push_back(static_cast<char>(body.size() >> shift & 0xff));
  return frame + body;
}

std::optional<LiveFrame> FrameDecoder::next() {
  if (pending_.size() < kHead) return std::nullopt;
  std::size_t length = 0;
  for (std::size_t i = 0; i < 4; ++i)
    length |= static_cast<std::size_t>(static_cast<std::uint8_t>(pending_[1 + i])) << (8 * i);
  if (length > longest(pending_[0]))
    throw Error("is longer than it may be", "a frame on the local socket of a session",
                "Console and session have different versions: restart both");
  if (pending_.size() < kHead + length) return std::nullopt;
  LiveFrame frame{static_cast<FrameKind>(pending_[0]), pending_.substr(kHead, length)};
  pending_.erase(0, kHead + length);
  return frame;
}

namespace {

using trial::UserCommand;
constexpr std::size_t kLongestReason = 500;
constexpr double kLongestSession_s =
    1e6;  // beyond it nanoseconds and a table's cells would not hold it

const std::map<std::string, UserCommand> kCommands{
    {"start", UserCommand::start},         {"pause", UserCommand::pause},
    {"abort", UserCommand::abort},         {"void", UserCommand::void_trial},
    {"stop", UserCommand::emergency_stop}, {"rearm", UserCommand::rearm},
    {"leave", UserCommand::quit},          {"note", UserCommand::note}};

/// Of UTF-8: bytes that do not go on with a character.
std::size_t characters(const std::string& text) {
  return static_cast<std::size_t>(
      std::count_if(text.begin(), text.end(), [](unsigned char c) { return (c & 0xc0) != 0x80; }));
}

std::string textIn(const nlohmann::json& json, const char* field) {
  if (!json.contains(field)) return "";
  if (!json[field].is_string()) throw UsageError("is not text", field, "Send it as a text");
  std::string text = json[field];
  if (characters(text) > kLongestReason)
    throw UsageError("is longer than 500 characters", field, "Shorten it");
  if (std::any_of(text.begin(), text.end(), [](unsigned char c) { return c < 0x20 || c == 0x7f; }))
    throw UsageError("holds control characters", field, "Write it in one line");
  return text;
}

double momentIn(const nlohmann::json& at) {
  const double seconds = at.is_number() ? at.get<double>() : -1;
  if (!(seconds >= 0 && seconds <= kLongestSession_s))
    throw UsageError("is not a time in the session", "at_s",
                     "Send seconds since the session began, or leave it out");
  return seconds;
}

int trialIn(const nlohmann::json& trial) {
  constexpr int kMostTrials = 1000;
  if (!trial.is_number_integer() || trial < 1 || trial > kMostTrials)
    throw UsageError("is not a trial's number", "trial", "Send 1 to 1000, or leave it out");
  return trial.get<int>();
}

}  // namespace

trial::UserRequest parseSteering(const std::string& text) {
  const nlohmann::json json = parsedOrDiscarded(text);
  if (!json.is_object())
    throw UsageError("is not a JSON object", "command to the session", "Send {\"command\": ...}");
  const std::string name = textIn(json, "command");
  const auto found = kCommands.find(name);
  if (found == kCommands.end())
    throw UsageError("is unknown", "command \"" + name.substr(0, 32) + "\"",
                     "Known: start, pause, abort, void, stop, rearm, leave, note");
  trial::UserRequest request{found->second, textIn(json, "reason")};
  if (request.reason.empty() &&
      (request.command == UserCommand::void_trial || request.command == UserCommand::note))
    throw UsageError("needs a text", "command \"" + name + "\"",
                     request.command == UserCommand::note ? "Write what is to be noted"
                                                          : "Say why the trial should not count");
  if (json.contains("at_s")) request.at_s = momentIn(json["at_s"]);
  if (json.contains("trial")) request.trial = trialIn(json["trial"]);
  return request;
}

}  // namespace palpa::live

#include "apps/room/messages.h"

#include <algorithm>
#include <regex>

#include "anatomy/base/enum_names.h"
#include "anatomy/base/error.h"
#include "anatomy/base/json_file.h"
#include "anatomy/base/text_forms.h"

namespace palpa::room {
namespace {

using nlohmann::json;

constexpr std::size_t kLongestMessage = 32 << 10, kLongestText = 2000, kLongestPem = 16 << 10,
                      kLongestName = 32, kLongestUrl = 300;
constexpr std::string_view kRoot = "palpa/";
constexpr std::string_view kStates[] = {"free",   "starting", "checking", "waiting", "running",
                                        "paused", "ended",    "finished", "gone"};
constexpr double kLongestSession = 1e7;  // s

const EnumNames<Topic>& topicNames() {
  static const EnumNames<Topic> kTopicNames{"about", "state", "events", "heard", "asks", "answers"};
  return kTopicNames;
}

const EnumNames<Ask::What>& askNames() {
  static const EnumNames<Ask::What> kAskNames{"prepare", "pause", "stop", "leave"};
  return kAskNames;
}

bool isHex(std::string_view text, std::size_t digits) {
  return text.size() == digits &&
         text.find_first_not_of("0123456789abcdef") == std::string_view::npos;
}

/// "https://HOST[:PORT]/", or http of this computer alone: what a console fetches pictures from.
bool isStationUrl(const std::string& url) {
  preparePatterns();
  static const std::regex kUrl(R"(https://([A-Za-z0-9.-]+|\[[0-9A-Fa-f:.]+\])(:[0-9]{1,5})?/)"
                               R"(|http://(127\.0\.0\.1|localhost)(:[0-9]{1,5})?/)");
  return url.empty() || (url.size() <= kLongestUrl && std::regex_match(url, kUrl));
}

bool isPlain(std::string_view text, std::size_t longest) {
  return !text.empty() && text.size() <= longest &&
         std::all_of(text.begin(), text.end(), [](char c) {
           return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') ||
                  c == '-' || c == '_';
         });
}

/// One message, whose every field is checked.
class Message {
 public:
  explicit Message(std::string_view text) : file_(read(text)) {}

  std::string text(const char* field, std::size_t longest = kLongestText) const {
    std::string found = file_.text(field);
    if (found.size() > longest) file_.refuse(field, "is too long");
    return found;
  }
  std::string id(const char* field, bool may_be_empty = false) const {
    std::string found = file_.text(field);
    if (!(found.empty() && may_be_empty) && !isPlain(found, 64)) file_.refuse(field, "is no name");
    return found;
  }
  const JsonFile& file() const { return file_; }

 private:
  static JsonFile read(std::string_view text) {
    if (text.size() > kLongestMessage)
      throw UsageError("is too long", "a message of the room", "Look who sends it");
    JsonFile file = JsonFile::ofText(text, "a message of the room",
                                     "Use the same version of Palpa on all computers of the room");
    if (!file.json().is_object()) file.refuse("", "is no object");
    return file;
  }
  JsonFile file_;
};

std::int64_t countIn(const JsonFile& file, const char* field, std::int64_t least) {
  const json found = file.json().value(field, json());
  if (!found.is_number_integer() || found.get<std::int64_t>() < least ||
      (found.is_number_unsigned() && found.get<std::uint64_t>() > INT64_MAX))
    file.refuse(field, "is no count");
  return found;
}

}  // namespace

bool isStationName(std::string_view text) { return isPlain(text, kLongestName); }

std::string topicOf(const std::string& station, Topic topic) {
  return std::string(kRoot) + station + "/" + topicNames().of(topic);
}

std::optional<Addressed> addressedIn(std::string_view topic) {
  if (!topic.starts_with(kRoot)) return std::nullopt;
  topic.remove_prefix(kRoot.size());
  const std::size_t slash = topic.find('/');
  if (slash == std::string_view::npos || !isStationName(topic.substr(0, slash)))
    return std::nullopt;
  const auto found = topicNames().named(topic.substr(slash + 1));
  if (!found) return std::nullopt;
  return Addressed{std::string(topic.substr(0, slash)), *found};
}

json toJson(const StationFacts& f) {
  return {{"url", f.url},
          {"authority", f.authority},
          {"picture_key", f.picture_key},
          {"version", f.version}};
}

StationFacts stationFactsIn(std::string_view text) {
  const Message m(text);
  StationFacts facts{m.text("url"), m.text("authority", kLongestPem), m.text("picture_key"),
                     m.text("version")};
  if (!isStationUrl(facts.url)) m.file().refuse("url", "is no address of a console");
  if (!isHex(facts.picture_key, 32)) m.file().refuse("picture_key", "is no key");
  return facts;
}

json toJson(const StationState& s) {
  return {{"present", s.present},
          {"utc", s.utc},
          {"session", s.session},
          {"state", s.state},
          {"task", s.task},
          {"trainee", s.trainee},
          {"alarm", s.alarm},
          {"trial", s.trial},
          {"trials", s.trials},
          {"elapsed_s", s.elapsed_s},
          {"emergency_stop", s.emergency_stop},
          {"simulated", s.simulated},
          {"blind", s.blind}};
}

StationState stationStateIn(std::string_view text) {
  constexpr int kMostTrials = 1'000'000;
  const Message m(text);
  StationState s;
  s.present = m.file().flag("present");
  s.utc = m.text("utc");
  s.session = m.id("session", true);
  s.state = m.text("state");
  if (std::find(std::begin(kStates), std::end(kStates), s.state) == std::end(kStates))
    m.file().refuse("state", "is not known here");
  s.task = m.text("task");
  s.trainee = m.text("trainee");
  s.alarm = m.text("alarm");
  s.trial = m.file().integer("trial", 0, kMostTrials);
  s.trials = m.file().integer("trials", 0, kMostTrials);
  s.elapsed_s = m.file().number("elapsed_s", 0, kLongestSession);
  s.emergency_stop = m.file().flag("emergency_stop");
  s.simulated = m.file().flag("simulated");
  s.blind = m.file().flag("blind");
  return s;
}

StationState goneWithoutAWord() {
  StationState s;
  s.state = "gone";
  return s;
}

json toJson(const Happening& h) {
  return {{"session", h.session}, {"record", h.record}, {"number", h.number}, {"t_s", h.t_s},
          {"trial", h.trial},     {"event", h.event},   {"text", h.text},     {"tone", h.tone}};
}

Happening happeningIn(std::string_view text) {
  const Message m(text);
  Happening h;
  h.session = m.id("session");
  h.record = m.id("record");
  h.number = countIn(m.file(), "number", 0);
  h.t_s = m.file().number("t_s", 0, kLongestSession);
  h.trial = static_cast<int>(std::min<std::int64_t>(countIn(m.file(), "trial", 0), INT32_MAX));
  h.event = m.text("event", kLongestName);
  h.text = m.text("text");
  h.tone = m.text("tone", kLongestName);
  return h;
}

std::int64_t Heard::of(const std::string& session, const std::string& record) const {
  const auto its = sessions.find(session);
  if (its == sessions.end()) return -1;
  const auto found = its->second.find(record);
  return found == its->second.end() ? -1 : found->second;
}

json toJson(const Heard& h) {
  return {{"beyond", h.beyond}, {"since", h.since}, {"sessions", h.sessions}};
}

Heard heardIn(std::string_view text) {
  const Message m(text);
  Heard heard{m.id("beyond", true), m.id("since", true), {}};
  const json sessions = m.file().json().value("sessions", json());
  if (!sessions.is_object()) m.file().refuse("sessions", "is no list of sessions");
  for (const auto& [session, records] : sessions.items()) {
    if (!isPlain(session, 64) || !records.is_object())
      m.file().refuse("sessions", "holds what is no session");
    const JsonFile each(records, m.file().name(), m.file().remedy());
    for (const auto& [record, number] : records.items()) {
      if (!isPlain(record, 64)) each.refuse(record.substr(0, 64), "is no record");
      heard.sessions[session][record] = countIn(each, record.c_str(), 0);
    }
  }
  return heard;
}

const std::string& nameOf(Ask::What what) { return askNames().of(what); }

json toJson(const Ask& a) {
  return {{"id", a.id}, {"session", a.session}, {"ask", nameOf(a.what)}, {"wish", a.wish}};
}

Ask askIn(std::string_view text) {
  const Message m(text);
  return {m.id("id"), m.id("session", true), askNames().in(m.file(), "ask"),
          m.file().json().value("wish", json())};
}

json toJson(const Answer& a) { return {{"id", a.id}, {"done", a.done}, {"words", a.words}}; }

Answer answerIn(std::string_view text) {
  const Message m(text);
  return {m.id("id"), m.file().flag("done"), m.text("words")};
}

std::string wire(const json& message) {
  return message.dump(-1, ' ', false, json::error_handler_t::replace);
}

}  // namespace palpa::room

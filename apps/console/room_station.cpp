#include "apps/console/room_station.h"

#include <openssl/crypto.h>

#include <algorithm>
#include <utility>

#include "anatomy/base/error.h"
#include "anatomy/base/json_text.h"
#include "anatomy/base/utc.h"
#include "apps/console/blinding.h"
#include "apps/console/routes.h"
#include "apps/console/task_choices.h"
#include "apps/os/real_time.h"
#include "apps/record/session_file.h"

namespace palpa::console {
namespace {

using nlohmann::json;
using room::Answer;
using room::Ask;
using room::Happening;
using runtime::EventKind;
using std::chrono::milliseconds;

constexpr milliseconds kRound{200};
constexpr std::chrono::seconds kBetweenRecords{2};

std::string textIn(const json& entry, const char* field) {
  const json found = entry.value(field, json());
  return found.is_string() ? found.get<std::string>() : "";
}

/// Words that the program wrote itself, of an event that is no trial's end: reasons and notes are
/// somebody's own, and stay here.
std::string wordsOf(const std::string& event, const std::string& text) {
  constexpr std::size_t kLongest = 400;
  if (event == nameOf(EventKind::note)) return "Somebody noted something";
  for (int kind = 0; kind <= static_cast<int>(EventKind::picture); ++kind)
    if (event == nameOf(static_cast<EventKind>(kind))) return text.substr(0, kLongest);
  return "The trial ended: " + event;
}

/// An event of a session's log as the room hears it.
Happening happeningOf(const json& entry, const std::string& session, const std::string& record,
                      std::int64_t number) {
  const std::string event = textIn(entry, "event");
  return {.session = session,
          .record = record,
          .number = number,
          .t_s = std::max(0.0, entry.value("t_s", 0.0)),
          .trial = std::max(0, entry.value("trial", 0)),
          .event = event,
          .text = wordsOf(event, textIn(entry, "text")),
          .tone = textIn(entry, "tone")};
}

bool isEvent(const json& entry) {
  return entry.is_object() && entry.value("kind", json()) == "event";
}

/// What the newest words on a session's screen say of it.
void addStatus(const json& entry, room::StationState* state) {
  state->state = textIn(entry, "state");
  state->trial = entry.value("trial", 0);
  state->trials = entry.value("trials", 0);
  state->elapsed_s = entry.value("elapsed_s", 0.0);
  state->emergency_stop = entry.value("emergency_stop", false);
  state->alarm = state->emergency_stop         ? "Emergency stop"
                 : entry.value("alarm", false) ? textIn(entry, "notice")
                                               : "";
}

/// The same record of which a session tells live, read when it is over.
std::vector<Happening> happeningsIn(const std::filesystem::path& record, const std::string& session,
                                    bool blind, const live::ToneOf& tone) {
  const record::SessionReader reader(record);
  std::vector<Happening> all;
  std::int64_t next = 0;
  for (const runtime::Event& event : reader.events()) {
    std::string told = live::eventEntry(event, tone);
    if (blind && !told.empty()) told = blinded(told);
    if (const json entry = parsedOrDiscarded(told); isEvent(entry))
      all.push_back(happeningOf(entry, session, reader.info().uuid, next++));
  }
  return all;
}

}  // namespace

RoomStation::RoomStation(Console& console, const room::Pairing& pairing, const std::string& url,
                         const std::string& authority)
    : console_(console),
      pairing_(pairing),
      picture_key_(randomKey()),
      line_(pairing, {url, authority, picture_key_, console.place.version},
            [this](const Ask& ask) { return handle(ask); }) {
  thread_ = os::startThread([this] { run(); });
}

RoomStation::~RoomStation() {
  ending_.store(true);
  thread_.join();
}

bool RoomStation::isPictureKey(const std::string& key) const {
  return key.size() == picture_key_.size() &&
         CRYPTO_memcmp(key.data(), picture_key_.data(), key.size()) == 0;
}

void RoomStation::run() {
  os::giveWay();
  while (!ending_.load()) {
    try {
      beginAgain();
      follow();
      tellOldest();
    } catch (const std::exception&) {  // a full disk, say: the next time
    }
    line_.look();
    runtime::rest(kRound);
  }
}

void RoomStation::follow() {
  const std::string id = console_.sessions.running();
  if (id != on_) {
    on_ = id;
    link_ = id.empty() ? nullptr : console_.sessions.link(id);
    state_from_ = events_from_ = 0;
    record_.clear();
    lost_ = false;
    state_ = {};
    if (link_) {
      const json one = console_.sessions.one(id);
      state_.session = id;
      state_.state = "starting";
      state_.task = textIn(one, "title");
      state_.trainee = textIn(one, "trainee");
      state_.simulated = one.value("simulated", json()) == true;
      state_.blind = one.value("blind", json()) == true;
    }
  }
  if (link_) {
    followState();
    followEvents();
  }
  state_.present = true;
  state_.utc = runtime::utcNow();
  line_.show(state_);
}

void RoomStation::followState() {
  const SessionLink::News news = link_->wait(state_from_, milliseconds(0));
  state_from_ = news.from + news.entries.size();
  for (auto text = news.entries.rbegin(); text != news.entries.rend(); ++text) {
    const json entry = parsedOrDiscarded(*text);
    if (!entry.is_object() || entry.value("kind", json()) != "status") continue;
    return addStatus(entry, &state_);
  }
}

/// Up to the first that cannot be told yet.
void RoomStation::followEvents() {
  if (lost_ || !line_.wants(on_).value_or(false)) return;
  const SessionLink::News news = link_->wait(events_from_, milliseconds(0));
  events_from_ = news.from;
  for (const std::string& text : news.entries) {
    if (!tell(parsedOrDiscarded(text))) return;
    ++events_from_;
  }
}

bool RoomStation::tell(const json& entry) {
  if (!entry.is_object()) return true;
  const json kind = entry.value("kind", json());
  if (kind == "earlier") lost_ = true;
  if (kind == "hello") {
    record_ = textIn(entry, "uuid");
    next_ = 0;
  }
  if (lost_ || record_.empty() || !isEvent(entry)) return true;
  if (!line_.tell(happeningOf(entry, on_, record_, next_))) return false;
  ++next_;
  return true;
}

void RoomStation::readOf(const std::string& id) {
  recorded_.clear();
  recorded_from_ = 0;
  const bool blind = console_.sessions.isBlind(id);
  for (const auto& record : console_.sessions.records(id))
    for (Happening& one : happeningsIn(record, id, blind, console_.tone))
      recorded_.push_back(std::move(one));
  over_ = id;
}

/// The oldest session that is over and not told; one a call, so that a running one is not kept
/// waiting. True: there was one to look at.
bool RoomStation::readNext() {
  constexpr std::chrono::hours kClocksDiffer{1};
  const std::string id = console_.sessions.firstUntold(&done_);
  if (id.empty()) return false;
  done_.insert(id);  // whatever comes of it
  const auto began = utcSecondsOf(console_.sessions.startOf(id));
  const bool before = began < utcSecondsOf(pairing_.made_utc) - kClocksDiffer;
  if (before || !line_.wants(id).value_or(true))
    console_.sessions.markTold(id);
  else
    readOf(id);
  return true;
}

void RoomStation::tellOldest() {
  if (over_.empty()) {
    const auto now = runtime::ServingClock::now();
    if (now < next_look_ || !line_.wants("").has_value()) return;
    if (!readNext()) next_look_ = now + kBetweenRecords;
    return;
  }
  while (recorded_from_ < recorded_.size() && line_.tell(recorded_[recorded_from_]))
    ++recorded_from_;
  const bool heard = std::all_of(recorded_.begin(), recorded_.end(), [this](const Happening& one) {
    return line_.heardOf(one.session, one.record) >= one.number;
  });
  const bool wanted = line_.wants(over_).value_or(true) && console_.sessions.has(over_);
  if (!heard && wanted) return;
  const std::string id = std::exchange(over_, "");
  if (heard) console_.sessions.markTold(id);
}

/// The watcher has less than he had: what is not told whole is told from its beginning.
void RoomStation::beginAgain() {
  if (line_.beginnings() == beginnings_) return;
  beginnings_ = line_.beginnings();
  events_from_ = recorded_from_ = 0;
  record_.clear();
}

/// Nothing here begins force: a session that was prepared waits for a key or a button here.
Answer RoomStation::handle(const Ask& ask) {
  if (ask.what == Ask::What::prepare) {
    SessionWish wish = readWish(ask.wish);
    wish.film = false;  // who trains agrees at the station
    if (wish.performer != "person" &&
        !onBench(console_.place, stationKindOf(taskChoice(wish.task).engine)))
      return {ask.id, false, "a simulated operator performs on the virtual bench only"};
    beginSession(console_, wish);
    return {ask.id, true, ""};
  }
  const auto link = console_.sessions.linkForStop(ask.session);
  if (!link) return {ask.id, false, "that session is not running there (any more)"};
  if (ask.what == Ask::What::stop) {
    const bool stopped = link->stop() == SessionLink::Stopped::yes;
    return {ask.id, stopped,
            stopped ? "" : "the session was told to stop and has not confirmed it"};
  }
  const json command{{"command", nameOf(ask.what)}};
  return link->send(command.dump()) ? Answer{ask.id, true, ""}
                                    : Answer{ask.id, false, "the session does not listen"};
}

}  // namespace palpa::console
